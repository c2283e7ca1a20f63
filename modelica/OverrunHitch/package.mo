within ;
package OverrunHitch "Car and trailer with an overrun brake, after R. S. Sharp (1982)"
  annotation(
    version="0.2.0",
    __fmu_build(author="The OverrunHitch authors", copyright="Copyright (c) 2026 The OverrunHitch authors", license="MIT"),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Rectangle(extent={{10,30},{90,-20}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Rectangle(extent={{-85,20},{-30,-20}}, lineColor={0,60,120}, fillColor={225,235,245}, fillPattern=FillPattern.Solid),
      Line(points={{-30,-10},{10,-10}}, color={0,60,120}, thickness=1),
      Ellipse(extent={{40,-15},{64,-39}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-70,-15},{-46,-39}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>The longitudinal dynamics of a car that tows a trailer with an overrun brake: the trailer pushes the drawbar in, and
the drawbar's compression applies the trailer's brakes. The combination can shunt by itself.</p>
<p>Source: R. S. Sharp, <em>Longitudinal Oscillations of Vehicle/Trailer Combinations Induced by Overrun Braking</em>,
Vehicle System Dynamics 11:1 (1982) 43-61, <a href=\"https://doi.org/10.1080/00423118208968687\">doi
10.1080/00423118208968687</a>. Equation numbers in this library are those of the paper; parameters bear its symbols.</p>
<p>Positions, speeds, accelerations and forces are positive forward. The hitch force <code>F_h</code> is positive in
tension, the tyre forces <code>F</code> are positive when they retard, the drawbar compression is
<code>x_t - x_c</code>.</p>
<p>The library needs no other. Its flanges have the structure of those of Modelica.Mechanics.Translational, so that its
parts connect to that library's.</p>
<p>Start with <a href=\"modelica://OverrunHitch.Examples.Figure8\">Examples.Figure8</a>.</p>
</html>"));
end OverrunHitch;
