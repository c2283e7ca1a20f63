within OverrunHitch.Components;
model TowBall "Tow ball that moves at a given speed, whatever the force on it"
  Interfaces.VelocityInput v "Speed of the ball, positive forward" annotation(Placement(transformation(extent={{120,-20},{80,20}})));
  Interfaces.Flange drawbar "Where the drawbar is attached" annotation(Placement(transformation(extent={{-110,-10},{-90,10}})));
  Units.Position s(start=0, fixed=true) "Position, positive forward";
  Units.Force F "Force on what moves the ball, positive forward";
  Units.Impulse impulse(start=0, fixed=true) "Impulse given to what moves the ball";
  Units.Energy work(start=0, fixed=true) "Work done on what moves the ball";
equation
  der(s) = v;
  drawbar.s = s;
  F = drawbar.f "The flow into a flange is the force on the part behind it";
  der(impulse) = F;
  der(work) = F*v;
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-40,40},{40,-40}}, lineColor={60,60,60}, fillColor={160,160,160}, fillPattern=FillPattern.Solid),
      Line(points={{-100,0},{-40,0}}, color={0,127,0}),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>The hitch of somebody else's car. Only its speed is given: a position held over a step of co-simulation would be a
false deflection of the drawbar of speed times step. Impulse and work are integrated, so that what a step has
transmitted is known exactly.</p>
</html>"));
end TowBall;
