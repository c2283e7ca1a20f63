within OverrunHitch.Systems;
model Hitch "Overrun hitch between a car and a trailer of somebody else (Sharp 1982)"
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
  parameter Units.Share reverse_braking = 1 "Share of the brake torque that is asked for backward: 0 for a reversing lock-out; the paper's has none";
  parameter Units.Length compression_start(min=-1000, max=1000) = 0 "Drawbar compression at the start";
  parameter Units.Time T_gap(min=0, max=1000) = 0 "Time over which the compression follows compression_in; 0: not connected";
  parameter Units.Mass M_front(min=0) = 0 "What the hitch force accelerates in front, for prediction: mass of the car and I_c/R_c^2 of its wheels; 0: not known (Co-Simulation)";
  parameter Units.Mass M_rear(min=0) = 0 "What it accelerates behind, likewise; 0: not known (Co-Simulation)";
  parameter Real extrapolation(final unit="1", min=0, max=1) = 1 "1: inside a step speeds go on as they changed over the last one, 0: they are held (Co-Simulation)";
  parameter Real applied_force(final unit="1", min=1, max=3) = 3 "What the bodies get, for the accounts: 1 F_hitch and trailer_brake_torque, 2 their means, 3 those to hold (Co-Simulation)";
  Interfaces.VelocityInput v_car(start=40) "Speed of the tow ball along the drawbar, positive forward" annotation(Placement(transformation(extent={{140,-20},{100,20}})));
  Interfaces.AccelerationInput a_car "Its acceleration, if the other side knows it: v_car goes on with it inside a step (Co-Simulation); 0: not known" annotation(Placement(transformation(extent={{140,-80},{100,-40}})));
  Interfaces.VelocityInput v_trailer(start=40) "Speed of the trailer along the drawbar, positive forward" annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.AccelerationInput a_trailer "Its acceleration, if the other side knows it; 0: not known" annotation(Placement(transformation(extent={{-140,-80},{-100,-40}})));
  Interfaces.LengthInput compression_in "Drawbar compression as the other side knows it, see T_gap" annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=-90, origin={0,120})));
  output Units.Force F_hitch = drawbar.F "Hitch force on the car, positive forward: a pushing trailer gives a positive value; on the trailer its negative";
  output Units.Force F_hitch_mean = F_hitch "F_hitch as a mean over the last step, for bodies that then make the same step; sums up to the impulse (Model Exchange: F_hitch)";
  output Units.Force F_hitch_hold = F_hitch "F_hitch to be held over the next step: predicted mean, and the impulse that is still owed (Model Exchange: F_hitch)";
  output Units.Torque trailer_brake_torque(min=0) "Torque that the trailer's brakes can hold, on its lumped wheels: friction, against the rolling";
  output Units.Torque trailer_brake_torque_mean(min=0) = trailer_brake_torque "The same as a mean over the last step (Model Exchange: trailer_brake_torque)";
  output Units.Torque trailer_brake_torque_hold(min=0) = trailer_brake_torque "The same to be held over the next step (Model Exchange: trailer_brake_torque)";
  output Units.Energy coupling_energy = 0 "Energy that the coupling has made by the force until the start of the last step: what the bodies have received less what the hitch has given (Model Exchange: 0)";
  output Units.Length compression = drawbar.compression "Drawbar compression x_t - x_c, positive when pushed in";
  output Units.Velocity v_rel = drawbar.v_rel "Rate of compression";
  Units.AngularImpulse brake_impulse(start=0, fixed=true) "Angular impulse of the brake torque";
  Components.DrivenDrawbar drawbar(k=k, k_t=k_t, C=C, eps=eps, F_pull_max=F_pull_max, rebound=rebound, F_f=F_f, F_0=F_0, x_2=x_2, k_2=k_2,
    x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer, compression(start=compression_start), T_gap=T_gap) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.BrakeLinkage linkage(r=r, eps=drawbar.s_1, tau_b=tau_b) "Linkage from drawbar to trailer brakes" annotation(Placement(transformation(extent={{-20,-70},{-60,-50}})));
protected
  constant Units.Velocity v_back = 0.01 "Speed backward from which a lock-out has let go";
  Real backward(final unit="1") "0 forward, 1 from v_back backward on";
equation
  connect(v_car, drawbar.v_front) annotation(Line(points={{120,0},{20,0}}, color={0,0,127}));
  connect(v_trailer, drawbar.v_rear) annotation(Line(points={{-120,0},{-20,0}}, color={0,0,127}));
  connect(compression_in, drawbar.gap) annotation(Line(points={{0,120},{0,20}}, color={0,0,127}));
  connect(drawbar.compression, linkage.compression) annotation(Line(points={{0,-20},{0,-60},{-20,-60}}, color={0,0,127}));
  backward = noEvent(min(1, max(0, -v_trailer/v_back)));
  trailer_brake_torque = linkage.brake_torque*(1 - (1 - reverse_braking)*backward);
  der(brake_impulse) = trailer_brake_torque;
  annotation(
    __fmu_build(
      coupling(across="v_car, -v_trailer", acrossDerivative="a_car, a_trailer", inertia="M_front, M_rear", extrapolate="extrapolation",
        through="F_hitch, trailer_brake_torque", impulse="drawbar.impulse, brake_impulse", work="drawbar.work",
        mean="F_hitch_mean, trailer_brake_torque_mean", hold="F_hitch_hold, trailer_brake_torque_hold", applied="applied_force",
        energy="coupling_energy"),
      terminal(name="hitch", signal(v="v_car"), outflow(F="F_hitch_hold")),
      terminal(name="trailer", signal(v="v_trailer", brake_torque="trailer_brake_torque_hold"), inflow(F="F_hitch_hold"))),
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Line(points={{-90,0},{-50,0},{-40,20},{-20,-20},{0,20},{20,-20},{30,0},{70,0}}, color={0,127,0}, thickness=1),
      Ellipse(extent={{70,15},{100,-15}}, lineColor={60,60,60}, fillColor={160,160,160}, fillPattern=FillPattern.Solid),
      Line(points={{0,-25},{0,-50},{-60,-50},{-45,-40},{-60,-50},{-45,-60}}, color={160,0,0}, thickness=1),
      Text(extent={{-100,-65},{100,-95}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>The drawbar and the brake linkage of <code>CarTrailer</code> between two bodies of which somebody else's simulator has
everything else: masses, wheels, tyres. It gives their speeds along the drawbar and gets the hitch force and the torque of the
trailer's brakes. Defaults are those of figure 8.</p>
<h2>Signs</h2>
<p>Speeds are positive forward. <code>compression</code> is positive when the drawbar is pushed in. <code>F_hitch</code> is the
force on the car, positive forward: a pushing trailer gives a positive value; on the trailer acts its negative.
<code>trailer_brake_torque</code> is what the brakes can hold, never negative: it acts against the rolling in both directions, and
holds a wheel that has stopped.</p>
<h2>Coupling</h2>
<p>In Co-Simulation values are exchanged at the ends of steps only. Force and torque are offered in three ways, as by
<code>Trailer</code>: those to hold (<code>F_hitch_hold</code>, <code>trailer_brake_torque_hold</code>) for bodies that make their step
at the same time, means for bodies that make it afterwards, and those at the end of the step. <code>applied_force</code> tells which
are used. Where <code>M_front</code> and <code>M_rear</code> are known the unit reckons with what the force to hold does to the
speeds meanwhile: at a stiff stop steps may be twice as long.</p>
<p>The compression is the integral of the difference of the speeds. With <code>T_gap</code> it follows, over that time,
<code>compression_in</code>; several seconds take every drift away. The damper sees nothing of that.</p>
<p>In Model Exchange, and before the first step, the three forces are equal and <code>coupling_energy</code> is 0. Their
partial derivatives are in any case those of <code>F_hitch</code>, and 0.</p>
<h2>Limits</h2>
<p>One force along the drawbar and no other component: sideways and upright the ball is the other simulator's joint. A reversing
lock-out follows the speed of the trailer, not its wheels: it lets go between 0 and 0.01 m/s backward.
<code>coupling_energy</code> counts the force, not the torque, as the speed of the wheels is not known here.</p>
<h2>Source</h2>
<p>R. S. Sharp, <em>Longitudinal Oscillations of Vehicle/Trailer Combinations Induced by Overrun Braking</em>, Vehicle
System Dynamics 11:1 (1982) 43-61, <a href=\"https://doi.org/10.1080/00423118208968687\">doi
10.1080/00423118208968687</a>.</p>
</html>"));
end Hitch;
