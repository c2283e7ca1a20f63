within OverrunHitch;
package Validation "Each component, alone, against the closed form of what it must do"
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>A class or two for each component, named after it, and one for the whole combination. It moves the component by a motion in closed form and has three outputs:
<code>value</code>, what the component makes of it, <code>expected</code>, its closed form, and <code>error</code>, the
difference, which is that of the integrator alone. What is given to the component is a constant, so that
<code>expected</code> does not follow when a parameter of the component is changed in an FMU: a check that cannot fail
would be none.</p>
</html>"));
end Validation;
