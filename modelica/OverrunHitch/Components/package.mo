within OverrunHitch;
package Components "Parts: one physical law each, and the vehicle made of them"
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Ellipse(extent={{-50,50},{50,-50}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-20,20},{20,-20}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Each part states one law of the paper and its sign convention; <code>BrakedVehicle</code> puts body, tyre and wheel
together.</p>
</html>"));
end Components;
