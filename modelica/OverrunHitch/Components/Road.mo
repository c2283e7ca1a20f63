within OverrunHitch.Components;
model Road "Road with a grade"
  Interfaces.GradeInput grade "Rise over horizontal run, positive uphill" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.AccelerationOutput g_x "Gravity along the road, positive forward" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
equation
  g_x = -Units.g_n*grade/sqrt(1 + grade^2) "Sine of the slope angle from its tangent";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-90,-50},{90,-50},{90,20},{-90,-50}}, lineColor={60,60,60}, fillColor={200,200,200}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>Gravity along a road that rises by <code>grade</code> metres for each metre of horizontal run: a weight of
<code>M</code> pulls back by <code>M g_n sin(atan(grade))</code>. Vehicle and trailer are on the same grade; the load on
the wheels plays no part in the tyre law. Not in the paper, whose road is level (<code>grade = 0</code>).</p>
</html>"));
end Road;
