within OverrunHitch.Components;
model HitchForce "Hitch force of somebody else's trailer"
  Interfaces.ForceInput F "Force on the car, positive forward" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.Flange car "Where the force acts" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
equation
  car.f = -F "What acts on the car comes out of this flange";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Line(points={{-80,0},{80,0}}, color={0,127,0}, thickness=1),
      Polygon(points={{80,0},{40,20},{40,-20},{80,0}}, lineColor={0,127,0}, fillColor={0,127,0}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html><p>A given force on a flange.</p></html>"));
end HitchForce;
