within OverrunHitch;
package Systems "Complete systems, made to be exported"
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Rectangle(extent={{10,30},{80,-20}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Rectangle(extent={{-80,20},{-30,-20}}, lineColor={0,60,120}, fillColor={225,235,245}, fillPattern=FillPattern.Solid),
      Line(points={{-30,0},{10,0}}, color={0,60,120}, thickness=1)}),
    Documentation(info="<html>
<p>Systems with short names without dots at the top, parameters under the paper's symbols: what an FMU shows.</p>
</html>"));
end Systems;
