within OverrunHitch.Validation;
model TowBall "Ball that shakes a drawbar: the work that it receives"
  constant Units.Stiffness k_t = 3000 "Stiffness of the drawbar in tension";
  constant Units.Damping C = 400 "Damper coefficient";
  constant Units.Velocity V = 0.6 "Largest speed";
  constant Units.Velocity U = 2 "Speed of the observer";
  constant Real w(final unit="rad/s") = 3 "Angular frequency";
  Components.Drawbar drawbar(k_t=k_t, C=C) "Drawbar" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.TowBall ball "Moves" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.TowBall wall "Stands" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  Units.Position s "Position of the ball, in closed form";
  output Units.Energy value = ball.work - U*ball.impulse "Work for an observer who moves with speed U";
  output Units.Energy expected "Its closed form";
  output Units.Energy error = value - expected "Error";
equation
  s = V/w*(1 - cos(w*time));
  ball.v = V*sin(w*time);
  wall.v = 0;
  connect(ball.drawbar, drawbar.front) annotation(Line(points={{-20,0},{-40,0}}, color={0,127,0}));
  connect(wall.drawbar, drawbar.rear) annotation(Line(points={{40,0},{40,40},{-90,40},{-90,0},{-80,0}}, color={0,127,0}));
  expected = -k_t*s^2/2 - C*V^2*(time/2 - sin(2*w*time)/(4*w)) + U*(k_t*V/w*(time - sin(w*time)/w) + C*s);
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The ball draws the front of a drawbar to and fro, whose rear is held and which is never pushed in: a spring and a damper
act on it, and take work. An observer who moves along sees <code>U</code> times the impulse less of it, so that impulse and work are
checked by one number.</p>
</html>"));
end TowBall;
