within OverrunHitch.Validation;
model Drawbar "Drawbar that is pushed in and pulled out: its force is the sum of its parts"
  constant Units.Stiffness k = 5000 "Stiffness in compression";
  constant Units.Stiffness k_t = 80000 "Stiffness in tension";
  constant Units.Damping C = 400 "Damper coefficient";
  constant Units.Length eps = 0.01 "Clearance";
  Components.Drawbar drawbar(k=k, k_t=k_t, C=C, eps=eps) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.TowBall car "Stands" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  Components.TowBall trailer(s(start=-0.02)) "Moves" annotation(Placement(transformation(extent={{-40,-20},{-80,20}})));
  Units.Length x "Compression, in closed form";
  Units.Velocity v "Its rate, in closed form";
  output Units.Force value = drawbar.F_h "Hitch force, positive in tension";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  x = 0.04 - 0.06*cos(3*time);
  v = 0.18*sin(3*time);
  car.v = 0;
  trailer.v = v;
  connect(drawbar.front, car.drawbar) annotation(Line(points={{20,0},{40,0}}, color={0,127,0}));
  connect(drawbar.rear, trailer.drawbar) annotation(Line(points={{-20,0},{-40,0}}, color={0,127,0}));
  expected = -C*v - k*noEvent(max(x - eps, 0)) - k_t*noEvent(min(x, 0));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>Front held, rear moved by a cosine from tension through the clearance into compression and back: springs of both
directions and damper, added up.</p>
</html>"));
end Drawbar;
