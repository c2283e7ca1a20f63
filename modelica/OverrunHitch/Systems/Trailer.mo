within OverrunHitch.Systems;
model Trailer "Trailer with an overrun brake behind somebody else's car (Sharp 1982)"
  parameter Units.Mass M_t = 500 "Mass of the trailer";
  parameter Units.MomentOfInertia I_t = 2.5 "Inertia of the trailer's lumped wheels";
  parameter Units.Radius R_t = 0.35 "Wheel radius of the trailer";
  parameter Units.SlipStiffness C_kt = 200000 "Tyre force per unit slip, trailer";
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
  parameter Units.Friction mu = 1e9 "Friction between tyres and road; the paper's has no limit";
  parameter Units.Share mu_slide(min=0.5, max=0.95) = 0.75 "Friction of wheels that slide, over mu";
  parameter Units.Length sigma(min=0, max=10000) = 0 "Relaxation length of the tyres; the paper\'s have none";
  parameter Units.Area CdA_t = 0 "Drag area of the trailer (drag coefficient times frontal area); the paper's has none";
  parameter Units.RollingResistance C_rr = 0 "Rolling resistance over load; the paper's has none";
  parameter Units.Share reverse_braking = 1 "Share of the trailer's brake torque that acts on wheels turning backward: 0 for a reversing lock-out; the paper's has none";
  parameter Units.Velocity V_0(min=-1000, max=1000) = 40 "Speed of the trailer at the start; v_car is expected to be the same";
  parameter Units.Length compression_start(min=-1000, max=1000) = 0 "Drawbar compression at the start";
  parameter Real extrapolation(final unit="1", min=0, max=1) = 1 "1: inside a step v_car goes on as it changed over the last one, 0: it is held (Co-Simulation)";
  parameter Real applied_force(final unit="1", min=1, max=3) = 3 "What the other side applies, for the account of impulse and energy: 1 F_hitch, 2 F_hitch_mean, 3 F_hitch_hold (Co-Simulation)";
  Interfaces.VelocityInput v_car(start=40) "Speed of the tow ball along the road, positive forward" annotation(Placement(transformation(extent={{140,-20},{100,20}})));
  Interfaces.AccelerationInput a_car "Acceleration of the tow ball, if the other side knows it: v_car goes on with it inside a step (Co-Simulation); 0: not known" annotation(Placement(transformation(extent={{140,-80},{100,-40}})));
  Interfaces.GradeInput grade "Road grade, rise over horizontal run, positive uphill" annotation(Placement(transformation(extent={{-140,60},{-100,100}})));
  output Units.Force F_hitch = ball.F "Hitch force on the car, positive forward: a pushing trailer gives a positive value";
  output Units.Force F_hitch_mean = F_hitch "F_hitch as a mean over the last step, for a car that then makes the same step; sums up to the impulse (Model Exchange: F_hitch)";
  output Units.Force F_hitch_hold = F_hitch "F_hitch to be held over the next step: predicted mean, and the impulse that is still owed (Model Exchange: F_hitch)";
  output Units.Energy coupling_energy = 0 "Energy that the coupling has made until the start of the last step: what the car has received less what the trailer has given (Model Exchange: 0)";
  output Units.Length compression = drawbar.compression "Drawbar compression x_t - x_c, positive when pushed in";
  output Units.Velocity v_rel = drawbar.v_rel "Rate of compression";
  output Units.Velocity v_trailer = trailer.body.v "Speed of the trailer, positive forward";
  output Units.Acceleration a_trailer = trailer.body.a "Acceleration of the trailer, positive forward";
  output Units.Slip slip_trailer = trailer.tyre.slip "Longitudinal slip of the trailer's wheels, positive when braking";
  output Units.Torque trailer_brake_torque = trailer.wheel.tau "Brake torque on the trailer's lumped wheels, positive when it slows wheels that roll forward";
  Components.TowBall ball "Tow ball" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  Components.BrakedVehicle trailer(M=M_t, I=I_t, R=R_t, C_k=C_kt, V_0=V_0, mu=mu, mu_slide=mu_slide, sigma=sigma,
    CdA=CdA_t, C_rr=C_rr, reverse_braking=reverse_braking, x_0=compression_start) "Trailer" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.Drawbar drawbar(k=k, k_t=k_t, C=C, eps=eps, F_pull_max=F_pull_max, rebound=rebound, F_f=F_f, F_0=F_0,
    x_2=x_2, k_2=k_2, x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.Road road "Road" annotation(Placement(transformation(extent={{-80,70},{-60,90}})));
  Components.BrakeLinkage linkage(r=r, eps=drawbar.s_1, tau_b=tau_b) "Linkage from drawbar to trailer brakes" annotation(Placement(transformation(extent={{-20,-70},{-60,-50}})));
equation
  connect(v_car, ball.v) annotation(Line(points={{120,0},{80,0}}, color={0,0,127}));
  connect(grade, road.grade) annotation(Line(points={{-120,80},{-80,80}}, color={0,0,127}));
  connect(road.g_x, trailer.g_x) annotation(Line(points={{-60,84},{-50,84},{-50,60},{-84,60},{-84,12},{-80,12}}, color={0,0,127}));
  connect(road.g_z, trailer.g_z) annotation(Line(points={{-60,76},{-54,76},{-54,56},{-88,56},{-88,-12},{-80,-12}}, color={0,0,127}));
  connect(drawbar.front, ball.drawbar) annotation(Line(points={{20,0},{40,0}}, color={0,127,0}));
  connect(drawbar.rear, trailer.hitch) annotation(Line(points={{-20,0},{-30,0},{-30,30},{-90,30},{-90,0},{-80,0}}, color={0,127,0}));
  connect(drawbar.compression, linkage.compression) annotation(Line(points={{0,-20},{0,-60},{-20,-60}}, color={0,0,127}));
  connect(linkage.brake_torque, trailer.brake_torque) annotation(Line(points={{-60,-60},{-95,-60},{-95,40},{-60,40},{-60,20}}, color={0,0,127}));
  annotation(
    __fmu_build(
      coupling(across="v_car", acrossDerivative="a_car", extrapolate="extrapolation", through="F_hitch",
        impulse="ball.impulse", work="ball.work", mean="F_hitch_mean", hold="F_hitch_hold", applied="applied_force",
        energy="coupling_energy"),
      terminal(name="hitch", signal(v="v_car"), outflow(F="F_hitch_hold"))),
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-80,30},{20,-20}}, lineColor={0,60,120}, fillColor={225,235,245}, fillPattern=FillPattern.Solid),
      Line(points={{20,-5},{80,-5}}, color={0,60,120}, thickness=1),
      Ellipse(extent={{72,3},{88,-13}}, lineColor={60,60,60}, fillColor={160,160,160}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-50,-10},{-10,-50}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,-60},{100,-95}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>The trailer, its drawbar and its brake linkage of <code>CarTrailer</code>, towed by a ball whose speed
<code>v_car</code> the car's own model gives. Defaults are those of figure 8.</p>
<h2>Signs</h2>
<p>Speeds and accelerations are positive forward. <code>compression</code> is positive when the drawbar is pushed in.
<code>F_hitch</code> is the force on the car, positive forward: a pushing trailer gives a positive value.
<code>grade</code> is positive uphill.</p>
<h2>Coupling</h2>
<p>In Co-Simulation values are exchanged at the ends of steps only. Inside a step <code>v_car</code> goes on with the
derivative that the importer sets (FMI 2) or <code>a_car</code>, where one is given, otherwise as it changed between
the last two exchanges, unless <code>extrapolation</code> is 0. When the true speed is known the states are corrected for the
difference.</p>
<p>Three forces are offered, for three ways to step. <code>F_hitch_hold</code> is for a car that makes its step at the
same time and holds the force over it: the mean force that is expected over that step, and what was not applied so far.
<code>F_hitch_mean</code> is for a car that makes its step afterwards. <code>F_hitch</code> is the force at the end of
the step. <code>applied_force</code> tells which one is used; <code>F_hitch_hold</code> and
<code>coupling_energy</code> depend on it.</p>
<p>In Model Exchange, and before the first step, the three forces are equal and <code>coupling_energy</code> is 0. Their
partial derivatives are in any case those of <code>F_hitch</code>, and 0.</p>
<h2>Limits</h2>
<p>By default no drag, no rolling resistance, no reversing lock-out (<code>CdA</code>, <code>C_rr</code>, <code>reverse_braking</code>),
no lag of the trailer's brakes and no dry friction (<code>tau_b</code>, <code>F_f</code>): a lag of 20 ms makes figure 8's
combination shunt by itself. From 0.5 m/s on the tyre force follows the slip without lag. With
the default <code>mu</code> nothing limits it: hard braking and slips beyond about 0.1 need a true one.</p>
<h2>Source</h2>
<p>R. S. Sharp, <em>Longitudinal Oscillations of Vehicle/Trailer Combinations Induced by Overrun Braking</em>, Vehicle
System Dynamics 11:1 (1982) 43-61, <a href=\"https://doi.org/10.1080/00423118208968687\">doi
10.1080/00423118208968687</a>.</p>
</html>"));
end Trailer;
