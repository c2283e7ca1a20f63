within OverrunHitch.Examples;
model Figure6a "Figure 6a: C = 20 N.s/m, stiff in tension"
  extends StepBrake(combination(C=20, k_t=548000, eps=0));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Documentation(info="<html><p>The shunting grows by itself; the stiff drawbar in tension throws the car about.</p></html>"));
end Figure6a;
