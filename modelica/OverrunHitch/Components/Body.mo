within OverrunHitch.Components;
model Body "Rigid body that moves along the road"
  parameter Units.Mass M = 1000 "Mass";
  parameter Units.Area CdA = 0 "Drag area: drag coefficient times frontal area";
  Interfaces.Flange hitch "Where the drawbar is attached" annotation(Placement(transformation(extent={{-110,-10},{-90,10}})));
  Interfaces.Flange axle "Where the axle is attached" annotation(Placement(transformation(extent={{-10,-110},{10,-90}})));
  Interfaces.AccelerationInput g_x "Gravity along the road, positive forward" annotation(Placement(transformation(extent={{-120,40},{-80,80}})));
  Units.Position x(start=0, fixed=true) "Position, positive forward";
  Units.Velocity v(start=40, fixed=true) "Speed, positive forward";
  Units.Acceleration a "Acceleration, positive forward";
  Units.Force F_drag "Aerodynamic drag, positive retarding";
equation
  v = der(x);
  a = der(v);
  hitch.s = x;
  axle.s = x;
  F_drag = 0.5*Units.rho_air*CdA*noEvent(abs(v))*v "In still air";
  M*a = hitch.f + axle.f + M*g_x - F_drag "Paper's equations 1 and 2, the weight on a slope, and drag";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-90,40},{90,-40}}, lineColor={0,60,120}, fillColor={200,220,240}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,90},{100,50}}, textColor={0,0,255}, textString="%name"),
      Text(extent={{-80,20},{80,-20}}, textColor={60,60,60}, textString="M=%M")}),
    Documentation(info="<html>
<p>Newton's second law along the road (the paper's equations 1 and 2, whose road is level). Both flanges sit at the body's position; the
distance between hitch and axle is rigid and plays no part.</p>
<p>The air, which the paper leaves out (<code>CdA = 0</code>), is still and has the standard density at sea level, 1.225 kg/m3.
The drag is against the motion in both directions.</p>
</html>"));
end Body;
