within OverrunHitch.Validation;
model Road "Road that bends upward under a block with friction"
  constant Units.Mass M = 700 "Mass";
  constant Units.Velocity v_0 = 60 "Speed at the start";
  constant Units.Friction mu = 0.3 "Friction between block and road";
  constant Real w(final unit="rad/s") = 0.1 "Rate at which the slope angle grows";
  Components.Body body(M=M, v(start=v_0)) "Block" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.Road road "Road" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.HitchForce friction "Friction" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  output Units.Velocity value = body.v "Speed";
  output Units.Velocity expected "Its closed form";
  output Units.Velocity error = value - expected "Error";
equation
  road.grade = tan(w*time);
  body.g_x = road.g_x;
  friction.F = -mu*M*road.g_z;
  connect(friction.car, body.hitch) annotation(Line(points={{80,0},{90,0},{90,40},{-90,40},{-90,0},{-80,0}}, color={0,127,0}));
  expected = v_0 - Units.g_n/w*(1 - cos(w*time) + mu*sin(w*time));
  annotation(
    experiment(StartTime=0, StopTime=6, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The slope angle grows in proportion to time, <code>grade = tan(w t)</code>. Gravity along the road is then a sine of time,
gravity onto the road, which by friction slows the block as well, a cosine, and the speed their integral.</p>
</html>"));
end Road;
