within OverrunHitch.Systems;
model Car "Car in front of somebody else's trailer (Sharp 1982)"
  parameter Units.Mass M_c = 1000 "Mass of the car";
  parameter Units.MomentOfInertia I_c = 5 "Inertia of the car's lumped wheels";
  parameter Units.Radius R_c = 0.35 "Wheel radius of the car";
  parameter Units.SlipStiffness C_kc = 400000 "Tyre force per unit slip, car";
  parameter Units.Friction mu = 1e9 "Friction between tyres and road; the paper's has no limit";
  parameter Units.Share mu_slide(min=0.5, max=0.95) = 0.75 "Friction of wheels that slide, over mu";
  parameter Units.Length sigma(min=0, max=10000) = 0 "Relaxation length of the tyres; the paper\'s have none";
  parameter Units.Area CdA_c = 0 "Drag area of the car (drag coefficient times frontal area); the paper's has none";
  parameter Units.RollingResistance C_rr = 0 "Rolling resistance over load; the paper's has none";
  parameter Units.Velocity V_0(min=-1000, max=1000) = 40 "Speed at the start";
  Interfaces.TorqueInput brake_torque(min=0) "Torque that the car's brakes can hold, on its lumped wheels: friction, against the rolling" annotation(Placement(transformation(extent={{-20,80},{20,120}}, rotation=-90)));
  Interfaces.ForceInput F_hitch "Hitch force on the car, positive forward: a pushing trailer gives a positive value" annotation(Placement(transformation(extent={{-140,-20},{-100,20}})));
  Interfaces.GradeInput grade "Road grade, rise over horizontal run, positive uphill" annotation(Placement(transformation(extent={{-140,60},{-100,100}})));
  output Units.Velocity v_car = car.body.v "Speed of the car, positive forward";
  output Units.Acceleration a_car = car.body.a "Acceleration of the car, positive forward";
  output Units.Slip slip_car = car.tyre.slip "Longitudinal slip of the car's wheels, positive when braking";
  Components.HitchForce force "Hitch force" annotation(Placement(transformation(extent={{-60,-20},{-20,20}})));
  Components.BrakedVehicle car(M=M_c, I=I_c, R=R_c, C_k=C_kc, V_0=V_0, mu=mu, mu_slide=mu_slide, sigma=sigma, CdA=CdA_c, C_rr=C_rr, final reverse_braking=1, final x_0=0) "Car" annotation(Placement(transformation(extent={{20,-20},{60,20}})));
  Components.Road road "Road" annotation(Placement(transformation(extent={{-80,70},{-60,90}})));
equation
  connect(F_hitch, force.F) annotation(Line(points={{-120,0},{-60,0}}, color={0,0,127}));
  connect(force.car, car.hitch) annotation(Line(points={{-20,0},{20,0}}, color={0,127,0}));
  connect(brake_torque, car.brake_torque) annotation(Line(points={{0,100},{0,40},{40,40},{40,20}}, color={0,0,127}));
  connect(grade, road.grade) annotation(Line(points={{-120,80},{-80,80}}, color={0,0,127}));
  connect(road.g_x, car.g_x) annotation(Line(points={{-60,84},{-10,84},{-10,12},{20,12}}, color={0,0,127}));
  connect(road.g_z, car.g_z) annotation(Line(points={{-60,76},{-14,76},{-14,-12},{20,-12}}, color={0,0,127}));
  annotation(
    __fmu_build(terminal(name="hitch", signal(v="v_car"), inflow(F="F_hitch"))),
    experiment(StartTime=0, StopTime=6, Tolerance=1e-6, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-70,30},{70,-20}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-20,-10},{20,-50}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,-60},{100,-95}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>The car of <code>CarTrailer</code>, pushed or pulled by a hitch force that a trailer's own model gives: the mirror of
<code>Trailer</code>, so that a pair can be tried at once.</p>
<h2>Signs</h2>
<p>Speed, acceleration and hitch force are positive forward, the slip and the brake torque when they brake a car that
rolls forward, <code>grade</code> uphill. <code>brake_torque</code> is what the brakes can hold: it acts against the rolling in
both directions, and holds a wheel that has stopped.</p>
<h2>Limits</h2>
<p>By default no drag and no rolling resistance. From 0.5 m/s on the tyre force follows the slip without lag. With
the default <code>mu</code> nothing limits it: hard braking and slips beyond about 0.1 need a true one.</p>
<h2>Source</h2>
<p>R. S. Sharp, <em>Longitudinal Oscillations of Vehicle/Trailer Combinations Induced by Overrun Braking</em>, Vehicle
System Dynamics 11:1 (1982) 43-61, <a href=\"https://doi.org/10.1080/00423118208968687\">doi
10.1080/00423118208968687</a>.</p>
</html>"));
end Car;
