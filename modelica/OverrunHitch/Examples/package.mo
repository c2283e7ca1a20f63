within OverrunHitch;
package Examples "The simulated figures of the paper: a step of the car's brake torque at 40 m/s"
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Polygon(points={{-40,60},{60,0},{-40,-60},{-40,60}}, lineColor={60,60,60}, fillColor={120,160,120}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>One class for each simulated figure: case ii of the paper's section 7, braked by 1000 N.m on the car's wheels from
t = 0.</p>
</html>"));
end Examples;
