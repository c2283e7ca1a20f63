within OverrunHitch.Validation;
model DrawbarDamper "Damper that is pushed in and pulled out: a coefficient for each direction"
  constant Units.Damping C = 400 "Damper coefficient";
  constant Real rebound(final unit="1") = 3 "Damper coefficient while the drawbar springs back, over C";
  Components.DrawbarDamper damper(C=C, rebound=rebound) "Damper" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Velocity v "Rate of compression, in closed form";
  output Units.Force value = damper.F "Force of the damper";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  v = 0.21*sin(3*time);
  damper.compression = 0;
  damper.v_rel = v;
  expected = C*noEvent(max(v, 0)) + rebound*C*noEvent(min(v, 0));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The rate of compression is moved by a sine.</p>
</html>"));
end DrawbarDamper;
