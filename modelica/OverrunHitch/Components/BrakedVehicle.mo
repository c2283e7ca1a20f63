within OverrunHitch.Components;
model BrakedVehicle "Rigid body on one lumped braked wheel with a slip tyre"
  parameter Units.Mass M = 1000 "Mass";
  parameter Units.MomentOfInertia I = 5 "Polar moment of inertia of the lumped wheels";
  parameter Units.Radius R = 0.35 "Wheel radius";
  parameter Units.SlipStiffness C_k = 400000 "Tyre force per unit slip";
  parameter Units.Velocity V_0(min=-1000, max=1000) = 40 "Speed at the start";
  parameter Units.Friction mu = 1e9 "Friction between tyres and road";
  parameter Units.Share mu_slide(min=0.5, max=0.95) = 0.75 "Friction of wheels that slide, over mu";
  parameter Units.Length sigma(min=0, max=10000) = 0 "Relaxation length of the tyres";
  parameter Units.Area CdA = 0 "Drag area";
  parameter Units.RollingResistance C_rr = 0 "Rolling resistance over load";
  parameter Units.Share reverse_braking = 1 "Share of the brake torque that acts backward";
  parameter Units.Position x_0 = 0 "Position at the start";
  Interfaces.Flange hitch "Where the drawbar is attached" annotation(Placement(transformation(extent={{-110,-10},{-90,10}})));
  Interfaces.TorqueInput brake_torque "Torque that the brakes can hold, on the lumped wheels" annotation(Placement(transformation(extent={{-20,80},{20,120}}, rotation=-90)));
  Interfaces.AccelerationInput g_x "Gravity along the road, positive forward" annotation(Placement(transformation(extent={{-120,40},{-80,80}})));
  Interfaces.AccelerationInput g_z "Gravity onto the road" annotation(Placement(transformation(extent={{-120,-80},{-80,-40}})));
  Body body(M=M, CdA=CdA, x(start=x_0), v(start=V_0)) "Body" annotation(Placement(transformation(extent={{-20,20},{20,60}})));
  Tyre tyre(C_k=C_k, R=R, M=M, mu=mu, mu_slide=mu_slide, C_rr=C_rr, sigma=sigma, final v_low=0.5, final zeta=0.5) "Tyre" annotation(Placement(transformation(extent={{-20,-40},{20,0}})));
  Wheel wheel(I=I, omega(start=V_0/R), z(start=noEvent(if V_0 > 0 then 1 elseif V_0 < 0 then -1 else 0)), final reverse_braking=reverse_braking,
    final phi_brake=0.01, final T_brake=0.05) "Wheel, rolling without slip at the start" annotation(Placement(transformation(extent={{40,-40},{80,0}})));
equation
  connect(g_x, body.g_x) annotation(Line(points={{-100,60},{-60,60},{-60,52},{-20,52}}, color={0,0,127}));
  connect(g_z, tyre.g_z) annotation(Line(points={{-100,-60},{-60,-60},{-60,-20},{-20,-20}}, color={0,0,127}));
  connect(hitch, body.hitch) annotation(Line(points={{-100,0},{-60,0},{-60,40},{-20,40}}, color={0,127,0}));
  connect(body.axle, tyre.axle) annotation(Line(points={{0,20},{0,0}}, color={0,127,0}));
  connect(tyre.hub, wheel.hub) annotation(Line(points={{0,-20},{0,-60},{60,-60},{60,-40}}, color={95,95,95}));
  connect(tyre.rolling_torque, wheel.rolling_torque) annotation(Line(points={{20,-20},{28,-20},{28,-52},{90,-52},{90,-20},{80,-20}}, color={0,0,127}));
  connect(brake_torque, wheel.brake_torque) annotation(Line(points={{0,100},{30,100},{30,-20},{40,-20}}, color={0,0,127}));
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-90,50},{90,-30}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-30,-10},{30,-70}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,-75},{100,-105}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>A car or a trailer: body, tyre and wheel. At the start it rolls without slip at <code>V_0</code>, in either direction, or stands.
Its weight loads its wheels: the pitch of the vehicle and the load on the hitch are left out.</p>
</html>"));
end BrakedVehicle;
