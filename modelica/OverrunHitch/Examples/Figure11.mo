within OverrunHitch.Examples;
model Figure11 "Figure 11: C = 2500 N.s/m with a clearance of 0.1 m"
  extends StepBrake(combination(C=2500, k_t=548000, eps=0.1));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>Heavily damped, with clearance: the delay before the trailer's brakes act is longest.</p></html>"));
end Figure11;
