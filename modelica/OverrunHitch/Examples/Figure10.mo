within OverrunHitch.Examples;
model Figure10 "Figure 10: C = 500 N.s/m with a clearance of 0.1 m"
  extends StepBrake(combination(C=500, k_t=548000, eps=0.1));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>As figure 8, with clearance.</p></html>"));
end Figure10;
