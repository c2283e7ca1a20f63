within OverrunHitch.Interfaces;
partial model PartialDrawbarForce "One of the laws that make up a drawbar: a force that follows from its motion"
  LengthInput compression "Drawbar compression" annotation(Placement(transformation(extent={{-120,30},{-80,70}})));
  VelocityInput v_rel "Its rate" annotation(Placement(transformation(extent={{-120,-70},{-80,-30}})));
  ForceOutput F "Force, positive where it resists compression" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-90,90},{90,-90}}, lineColor={0,127,0}, fillColor={248,255,248}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,140},{100,105}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>What spring, damper and pull limit have in common. <code>Drawbar</code> adds their forces and joins them to its flanges; the
laws themselves know nothing of vehicles.</p>
</html>"));
end PartialDrawbarForce;
