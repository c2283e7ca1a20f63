within OverrunHitch.Examples;
model Figure9 "Figure 9: C = 100 N.s/m with a clearance of 0.1 m"
  extends StepBrake(combination(C=100, k_t=548000, eps=0.1));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>As figure 7, with clearance: the trailer's brakes act later and the oscillation is slower.</p></html>"));
end Figure9;
