within OverrunHitch.Interfaces;
connector Flange "Translational flange along the road"
  Units.Position s "Position of the flange, positive forward";
  flow Units.Force f "Force on the part behind the flange, positive forward";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,127,0}, fillColor={0,127,0}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>The same structure as Modelica.Mechanics.Translational.Interfaces.Flange_a and Flange_b (position <code>s</code>, flow
force <code>f</code>), so that this library's parts connect to those.</p>
</html>"));
end Flange;
