within OverrunHitch.Validation;
model HitchForce "Body under a hitch force that alternates"
  constant Units.Mass M = 900 "Mass";
  constant Units.Velocity v_0 = 1 "Speed at the start";
  constant Units.Force F_0 = 2000 "Largest force";
  constant Real w(final unit="rad/s") = 3 "Angular frequency";
  Components.Body body(M=M, v(start=v_0)) "Body" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.HitchForce force "Hitch force" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  output Units.Velocity value = body.v "Speed";
  output Units.Velocity expected "Its closed form";
  output Units.Velocity error = value - expected "Error";
equation
  force.F = F_0*sin(w*time);
  body.g_x = 0;
  connect(force.car, body.hitch) annotation(Line(points={{20,0},{-40,0}}, color={0,127,0}));
  expected = v_0 + F_0/(M*w)*(1 - cos(w*time));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>A force positive forward speeds the body up: the speed is the integral of a sine.</p>
</html>"));
end HitchForce;
