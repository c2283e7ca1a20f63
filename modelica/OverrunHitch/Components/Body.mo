within OverrunHitch.Components;
model Body "Rigid body that moves along the road"
  parameter Units.Mass M = 1000 "Mass";
  Interfaces.Flange hitch "Where the drawbar is attached" annotation(Placement(transformation(extent={{-110,-10},{-90,10}})));
  Interfaces.Flange axle "Where the axle is attached" annotation(Placement(transformation(extent={{-10,-110},{10,-90}})));
  Interfaces.AccelerationInput g_x "Gravity along the road, positive forward" annotation(Placement(transformation(extent={{-120,40},{-80,80}})));
  Units.Position x(start=0, fixed=true) "Position, positive forward";
  Units.Velocity v(start=40, fixed=true) "Speed, positive forward";
  Units.Acceleration a "Acceleration, positive forward";
equation
  v = der(x);
  a = der(v);
  hitch.s = x;
  axle.s = x;
  M*a = hitch.f + axle.f + M*g_x "Paper's equations 1 and 2, and the weight on a slope";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-90,40},{90,-40}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,90},{100,50}}, textColor={0,0,255}, textString="%name"),
      Text(extent={{-80,20},{80,-20}}, textColor={60,60,60}, textString="M=%M")}),
    Documentation(info="<html>
<p>Newton's second law along the road (the paper's equations 1 and 2, whose road is level). Both flanges sit at the body's position; the
distance between hitch and axle is rigid and plays no part.</p>
</html>"));
end Body;
