within OverrunHitch.Validation;
model Tyre "Tyre from free rolling to sliding and back: magic formula"
  constant Units.SlipStiffness C_k = 90000 "Tyre force per unit of small slip";
  constant Units.Radius R = 0.3 "Radius";
  constant Units.Mass M = 600 "Mass that loads the tyre";
  constant Units.Friction mu = 0.8 "Friction";
  constant Units.Share mu_slide = 0.7 "Friction of a locked wheel, over mu";
  constant Real X(final unit="1") = C_k/(1.685*mu*M*Units.g_n) "Argument of the magic formula of a locked wheel";
  constant Real E(final unit="1") = (X - tan((3.141592653589793 - asin(mu_slide))/1.685))/(X - atan(X)) "Curvature with which it brakes with mu_slide";
  constant Units.AngularVelocity W = 20 "Angular velocity";
  Components.Tyre tyre(C_k=C_k, R=R, M=M, mu=mu, mu_slide=mu_slide) "Tyre" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.TowBall axle "Moves the axle" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Slip s "Slip, in closed form";
  Real x(final unit="1") "Argument of the magic formula, in closed form";
  Components.Wheel wheel(final I=1e12, omega(start=W)) "Turns steadily: a flywheel" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  output Units.Force value = tyre.F "Tyre force";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  s = 0.45*(1 - cos(2*time));
  x = X*s;
  axle.v = R*W/(1 - s);
  wheel.brake_torque = 0;
  tyre.g_z = Units.g_n;
  connect(axle.drawbar, tyre.axle) annotation(Line(points={{-20,0},{-30,0},{-30,30},{-60,30},{-60,20}}, color={0,127,0}));
  connect(tyre.rolling_torque, wheel.rolling_torque) annotation(Line(points={{-40,0},{-30,0},{-30,-40},{90,-40},{90,0},{80,0}}, color={0,0,127}));
  connect(wheel.hub, tyre.hub) annotation(Line(points={{60,-20},{60,-30},{-60,-30},{-60,0}}, color={95,95,95}));
  expected = mu*M*Units.g_n*sin(1.685*atan(x - E*(x - atan(x))));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The wheel turns steadily, the axle speeds up from free rolling to ten times that and slows down again, so that the slip
is a given function of time. The force is H. B. Pacejka's magic formula of it, with the shape of a
205/60R15 (<em>Tyre and Vehicle Dynamics</em>, 2nd ed. 2006, table A3.1) and the curvature that a locked wheel asks for.</p>
</html>"));
end Tyre;
