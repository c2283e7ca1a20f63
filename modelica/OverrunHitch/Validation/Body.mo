within OverrunHitch.Validation;
model Body "Body on a slope in air: uphill to a stop and down to its terminal speed"
  constant Units.Mass M = 800 "Mass";
  constant Units.Area CdA = 1.5 "Drag area";
  constant Units.Acceleration g_x = 0.9 "Gravity along the road";
  constant Units.Velocity v_T = sqrt(2*M*g_x/(1.225*CdA)) "Terminal speed";
  constant Units.Time t_0 = 15 "When it turns back";
  Components.Body body(M=M, CdA=CdA, v(start=-v_T*tan(t_0*g_x/v_T))) "Body" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  output Units.Velocity value = body.v "Speed";
  output Units.Velocity expected "Its closed form";
  output Units.Velocity error = value - expected "Error";
equation
  body.g_x = g_x;
  expected = v_T*noEvent(if time < t_0 then tan((time - t_0)*g_x/v_T) else tanh((time - t_0)*g_x/v_T));
  annotation(
    experiment(StartTime=0, StopTime=60, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>Backward up a slope and forward down again. The drag, with the square of the speed, adds to the weight on the way up and
is against it on the way down: <code>M der(v) = M g_x + c v^2</code>, solved by a tangent, and then
<code>M der(v) = M g_x - c v^2</code>, solved by a hyperbolic tangent.</p>
</html>"));
end Body;
