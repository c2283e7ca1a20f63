within OverrunHitch.Components;
model Road "Road with a grade"
  Interfaces.GradeInput grade "Rise over horizontal run, positive uphill" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.AccelerationOutput g_x "Gravity along the road, positive forward" annotation(Placement(transformation(extent={{90,30},{110,50}})));
  Interfaces.AccelerationOutput g_z "Gravity onto the road" annotation(Placement(transformation(extent={{90,-50},{110,-30}})));
equation
  g_x = -grade*g_z "Sine of the slope angle from its tangent";
  g_z = Units.g_n/sqrt(1 + grade^2) "Cosine of the slope angle from its tangent";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-90,-50},{90,-50},{90,20},{-90,-50}}, lineColor={60,60,60}, fillColor={200,200,200}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>Gravity along a road that rises by <code>grade</code> metres for each metre of horizontal run: a weight of
<code>M</code> pulls back by <code>M g_n sin(atan(grade))</code>. Car and trailer are on the same grade.
Its part onto the road loads the wheels, each vehicle's by its own weight. Not in the paper, whose road is level (<code>grade = 0</code>).</p>
</html>"));
end Road;
