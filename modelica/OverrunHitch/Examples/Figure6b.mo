within OverrunHitch.Examples;
model Figure6b "Figure 6b: C = 20 N.s/m, as stiff in tension as in compression"
  extends StepBrake(combination(C=20, k_t=5480, eps=0));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>The shunting grows by itself, near the frequency of the linear theory; most of the motion is the trailer's.</p></html>"));
end Figure6b;
