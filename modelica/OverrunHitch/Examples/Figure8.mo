within OverrunHitch.Examples;
model Figure8 "Figure 8: C = 500 N.s/m"
  extends StepBrake(combination(C=500, k_t=548000, eps=0));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>Well damped: the drawbar stays in compression.</p></html>"));
end Figure8;
