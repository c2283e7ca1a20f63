within OverrunHitch.Systems;
model Bench "Drawbar and brake linkage on a test bench: held in front, moved behind"
  parameter Units.Stiffness k = 5480 "Drawbar stiffness in compression";
  parameter Units.Stiffness k_t = 548000 "Drawbar stiffness in tension";
  parameter Units.Damping C = 500 "Drawbar damper coefficient";
  parameter Units.TorquePerLength r = 16303 "Trailer brake torque per unit of drawbar compression (2.975 m times k)";
  parameter Units.Length eps(min=0, max=10000) = 0 "Drawbar clearance (backlash)";
  parameter Units.Force F_pull_max(min=0, max=1e12) = 1e9 "Largest pull of the damper in a drawbar that is pushed in: 0 for none; the paper's damper has no limit";
  parameter Real rebound(final unit="1", min=0, max=1e9) = 1 "Damper coefficient while the drawbar springs back, over C";
  parameter Units.Force F_f(min=0, max=1e6) = 0 "Dry friction of the drawbar's guide; the paper's has none";
  parameter Units.Time tau_b(min=0, max=1000) = 0 "Lag of the trailer's brake torque behind the drawbar compression; the paper's has none";
  parameter Units.Force F_0(min=0, max=1e12) = 0 "Threshold: push up to which the drawbar gives by k_t alone and the trailer is not braked";
  parameter Units.Length x_2(min=0, max=10000) = 1000 "Drawbar compression beyond the clearance from which its stiffness is k_2";
  parameter Units.Stiffness k_2 = 5480 "Drawbar stiffness from x_2 on";
  parameter Units.Length x_3(min=0, max=10000) = 1000 "Drawbar compression beyond the clearance from which its stiffness is k_3";
  parameter Units.Stiffness k_3 = 5480 "Drawbar stiffness from x_3 on";
  parameter Units.Length travel(min=0, max=10000) = 1000 "Drawbar compression at which it meets the buffer";
  parameter Units.Stiffness k_buffer = 548000 "Drawbar stiffness from there on";
  parameter Units.Length compression_start(min=-1000, max=1000) = 0 "Drawbar compression at the start";
  Interfaces.VelocityInput v_rel "Rate of compression, positive while pushed in" annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  output Units.Force F_hitch = front.F "Hitch force, positive forward: a drawbar that is pushed in gives a positive value";
  output Units.Torque trailer_brake_torque = linkage.brake_torque "Torque that the trailer's brakes can hold, on its lumped wheels";
  output Units.Length compression = drawbar.compression "Drawbar compression, positive when pushed in";
  Components.TowBall front "Held" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  Components.TowBall rear(s(start=compression_start)) "Moved" annotation(Placement(transformation(extent={{-40,-20},{-80,20}})));
  Components.Drawbar drawbar(k=k, k_t=k_t, C=C, eps=eps, F_pull_max=F_pull_max, rebound=rebound, F_f=F_f, F_0=F_0,
    x_2=x_2, k_2=k_2, x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.BrakeLinkage linkage(r=r, eps=drawbar.s_1, tau_b=tau_b) "Linkage from drawbar to brakes" annotation(Placement(transformation(extent={{-20,-70},{-60,-50}})));
equation
  front.v = 0;
  connect(v_rel, rear.v) annotation(Line(points={{-120,0},{-80,0}}, color={0,0,127}));
  connect(drawbar.front, front.drawbar) annotation(Line(points={{20,0},{40,0}}, color={0,127,0}));
  connect(drawbar.rear, rear.drawbar) annotation(Line(points={{-20,0},{-40,0}}, color={0,127,0}));
  connect(drawbar.compression, linkage.compression) annotation(Line(points={{0,-20},{0,-60},{-20,-60}}, color={0,0,127}));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{60,60},{90,-60}}, lineColor={60,60,60}, fillColor={160,160,160}, fillPattern=FillPattern.Solid),
      Line(points={{-30,10},{-15,30},{0,-10},{15,30},{30,-10},{45,10},{60,10}}, color={0,127,0}, thickness=1),
      Rectangle(extent={{-60,40},{-30,-20}}, lineColor={0,60,120}, fillColor={225,235,245}, fillPattern=FillPattern.Solid),
      Line(points={{-90,-40},{-10,-40},{-25,-30},{-10,-40},{-25,-50}}, color={160,0,0}, thickness=1),
      Text(extent={{-100,-60},{100,-95}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>The drawbar and the brake linkage of <code>CarTrailer</code> between two balls: the front one is held, the rear one moves
at <code>v_rel</code>. What is measured on a bench, or between a car and its trailer, can so be laid over what the model makes of
the same motion.</p>
<p>The rate is given, not the compression: the damper, the friction of the guide and the lag of the linkage follow the rate,
and a compression held over a step of co-simulation would have none. In Co-Simulation <code>v_rel</code> goes on within a step
by the derivative that the importer sets.</p>
<h2>Signs</h2>
<p><code>compression</code> is positive when the drawbar is pushed in, <code>v_rel</code> while it is. <code>F_hitch</code>
is positive when the drawbar pushes what is in front of it.</p>
<h2>Start</h2>
<p>At the start the guide's friction is unwound and the brakes have followed: as after a rest in which the guide was shaken
loose. A trace that begins in motion is off for the travel over which friction reverses (0.1 mm) and some <code>tau_b</code>.</p>
</html>"));
end Bench;
