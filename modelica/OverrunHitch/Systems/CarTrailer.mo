within OverrunHitch.Systems;
model CarTrailer "Car and trailer with an overrun brake (Sharp 1982)"
  parameter Units.Mass M_c = 1000 "Mass of the car";
  parameter Units.Mass M_t = 500 "Mass of the trailer";
  parameter Units.MomentOfInertia I_c = 5 "Inertia of the car's lumped wheels";
  parameter Units.MomentOfInertia I_t = 2.5 "Inertia of the trailer's lumped wheels";
  parameter Units.Radius R_c = 0.35 "Wheel radius of the car";
  parameter Units.Radius R_t = 0.35 "Wheel radius of the trailer";
  parameter Units.SlipStiffness C_kc = 400000 "Tyre force per unit slip, car";
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
  parameter Units.Area CdA_c = 0 "Drag area of the car (drag coefficient times frontal area); the paper's has none";
  parameter Units.Area CdA_t = 0 "Drag area of the trailer (drag coefficient times frontal area); the paper's has none";
  parameter Units.RollingResistance C_rr = 0 "Rolling resistance over load; the paper's has none";
  parameter Units.Share reverse_braking = 1 "Share of the trailer's brake torque that acts on wheels turning backward: 0 for a reversing lock-out; the paper's has none";
  parameter Units.Velocity V_0(min=-1000, max=1000) = 40 "Speed of both vehicles at the start";
  parameter Units.Length compression_start(min=-1000, max=1000) = 0 "Drawbar compression at the start";
  Interfaces.TorqueInput brake_torque(min=0) "Torque that the car's brakes can hold, on its lumped wheels: friction, against the rolling" annotation(Placement(transformation(extent={{20,80},{60,120}}, rotation=-90)));
  Interfaces.GradeInput grade "Road grade, rise over horizontal run, positive uphill" annotation(Placement(transformation(extent={{-140,60},{-100,100}})));
  output Units.Velocity v_car = car.body.v "Speed of the car, positive forward";
  output Units.Velocity v_trailer = trailer.body.v "Speed of the trailer, positive forward";
  output Units.Acceleration a_car = car.body.a "Acceleration of the car, positive forward";
  output Units.Acceleration a_trailer = trailer.body.a "Acceleration of the trailer, positive forward";
  output Units.Length compression = drawbar.compression "Drawbar compression x_t - x_c, positive when pushed in";
  output Units.Force F_hitch = car.hitch.f "Hitch force on the car, positive forward: a pushing trailer gives a positive value";
  output Units.Slip slip_car = car.tyre.slip "Longitudinal slip of the car's wheels, positive when braking";
  output Units.Slip slip_trailer = trailer.tyre.slip "Longitudinal slip of the trailer's wheels, positive when braking";
  output Units.Torque trailer_brake_torque = trailer.wheel.tau "Brake torque on the trailer's lumped wheels, positive when it slows wheels that roll forward";
  Components.BrakedVehicle car(M=M_c, I=I_c, R=R_c, C_k=C_kc, V_0=V_0, mu=mu, mu_slide=mu_slide, sigma=sigma, CdA=CdA_c, C_rr=C_rr, final reverse_braking=1, final x_0=0) "Car" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  Components.BrakedVehicle trailer(M=M_t, I=I_t, R=R_t, C_k=C_kt, V_0=V_0, mu=mu, mu_slide=mu_slide, sigma=sigma,
    CdA=CdA_t, C_rr=C_rr, reverse_braking=reverse_braking, x_0=compression_start) "Trailer" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.Drawbar drawbar(k=k, k_t=k_t, C=C, eps=eps, F_pull_max=F_pull_max, rebound=rebound, F_f=F_f, F_0=F_0,
    x_2=x_2, k_2=k_2, x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.Road road "Road" annotation(Placement(transformation(extent={{-80,70},{-60,90}})));
  Components.BrakeLinkage linkage(r=r, eps=drawbar.s_1, tau_b=tau_b) "Linkage from drawbar to trailer brakes" annotation(Placement(transformation(extent={{-20,-70},{-60,-50}})));
equation
  connect(grade, road.grade) annotation(Line(points={{-120,80},{-80,80}}, color={0,0,127}));
  connect(road.g_x, trailer.g_x) annotation(Line(points={{-60,84},{-50,84},{-50,60},{-84,60},{-84,12},{-80,12}}, color={0,0,127}));
  connect(road.g_x, car.g_x) annotation(Line(points={{-60,84},{34,84},{34,12},{40,12}}, color={0,0,127}));
  connect(road.g_z, trailer.g_z) annotation(Line(points={{-60,76},{-54,76},{-54,56},{-88,56},{-88,-12},{-80,-12}}, color={0,0,127}));
  connect(road.g_z, car.g_z) annotation(Line(points={{-60,76},{30,76},{30,-12},{40,-12}}, color={0,0,127}));
  connect(drawbar.front, car.hitch) annotation(Line(points={{20,0},{40,0}}, color={0,127,0}));
  connect(drawbar.rear, trailer.hitch) annotation(Line(points={{-20,0},{-30,0},{-30,30},{-90,30},{-90,0},{-80,0}}, color={0,127,0}));
  connect(drawbar.compression, linkage.compression) annotation(Line(points={{0,-20},{0,-60},{-20,-60}}, color={0,0,127}));
  connect(linkage.brake_torque, trailer.brake_torque) annotation(Line(points={{-60,-60},{-95,-60},{-95,40},{-60,40},{-60,20}}, color={0,0,127}));
  connect(brake_torque, car.brake_torque) annotation(Line(points={{40,100},{60,100},{60,20}}, color={0,0,127}));
  annotation(
    __fmu_build(referenceExamples={"OverrunHitch.Examples.Figure8", "OverrunHitch.Examples.Figure10"}),
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{0,40},{95,-20}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Rectangle(extent={{-95,30},{-35,-20}}, lineColor={0,60,120}, fillColor={225,235,245}, fillPattern=FillPattern.Solid),
      Line(points={{-35,-5},{0,-5}}, color={0,60,120}, thickness=1),
      Ellipse(extent={{35,-10},{65,-40}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-80,-10},{-50,-40}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,-50},{100,-85}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>Sharp's car and trailer: equations 1 to 8 of the paper, with the drawbar of section 6. Defaults are those of figure 8
(case ii, C = 500 N.s/m, no clearance), a combination that does not shunt by itself.</p>
<h2>Signs</h2>
<p>Positions, speeds and accelerations are positive forward, so braking gives negative accelerations.
<code>compression</code> is <code>x_t - x_c</code>, positive when the drawbar is pushed in. <code>F_hitch</code> is the
force on the car, positive forward: a pushing trailer gives a positive value; it is minus the paper's F_h, which is
positive in tension. <code>grade</code> is positive uphill. Slips and brake torques are positive when they brake a
vehicle that rolls forward. <code>brake_torque</code> is what the car's brakes can hold: they
act against the rolling in both directions, and hold a wheel that has stopped. <code>trailer_brake_torque</code> is what acts
on the trailer's wheels. The paper's road is level,
<code>grade = 0</code>.</p>
<h2>Parameters</h2>
<p>Masses, inertias, radii and tyre stiffnesses are the datum of the paper's section 7; <code>k</code> and <code>r</code>
those of its case ii (section 8.1); <code>k_t = 100 k</code> that of figures 6a and 7 to 11. <code>V_0</code> and
<code>compression_start</code> count at the start, the others may be changed during a run.
<code>mu</code> is about 1 on dry asphalt, 0.3 on packed snow; its default is beyond any tyre. With
<code>F_pull_max = 0</code> the damper never makes a compressed drawbar pull, nor one at its stop push; the default is
beyond any damper's force. Devices as sold have a threshold <code>F_0</code> (2 to 4 % of the trailer's weight), a damper
that is stronger in <code>rebound</code>, a <code>travel</code> of 0.085 to 0.1 m with a buffer behind it, and springs whose
stiffness grows (<code>x_2</code>, <code>k_2</code>, <code>x_3</code>, <code>k_3</code>); by default all these are out of
reach, as in the paper.</p>
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
end CarTrailer;
