within OverrunHitch.Examples;
model Figure7 "Figure 7: C = 100 N.s/m"
  extends StepBrake(combination(C=100, k_t=548000, eps=0));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>Lightly damped.</p></html>"));
end Figure7;
