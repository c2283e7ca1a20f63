within OverrunHitch.Validation;
model WheelAtRest "Wheel rocked against its brake: Dahl's friction"
  model Source "Torque on a hub"
    Interfaces.TorqueInput tau "Torque on the wheel, positive rolling forward";
    Interfaces.Hub hub "Joined to the wheel";
  equation
    hub.tau = -tau;
  end Source;
  constant Units.MomentOfInertia I = 200 "Moment of inertia";
  constant Units.Angle phi = 0.01 "Angle over which the brake takes hold";
  constant Units.Time T = 0.05 "Damping of the brake that holds, over its stiffness";
  constant Units.Share reverse_braking = 0.4 "Share of the brake torque that acts backward";
  constant Units.Torque T_b = 50 "Brake torque";
  constant Units.AngularVelocity W = 0.05 "Largest angular velocity";
  Components.Wheel wheel(I=I, phi_brake=phi, T_brake=T, reverse_braking=reverse_braking, omega(start=0), z(start=0)) "Wheel" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Units.AngularVelocity omega "Angular velocity, in closed form";
  Real turned(final unit="1") "Angle turned over phi, in closed form";
  Real z(final unit="1") "Wind-up of the friction, in closed form";
  Real y(final unit="1") "Share of the friction that acts, in closed form";
  Source source "Turns the wheel" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  output Units.Torque value = wheel.tau "Brake torque";
  output Units.Torque expected "Its closed form";
  output Units.Torque error = value - expected "Error";
equation
  omega = W*sin(3.141592653589793*time);
  turned = W/(3.141592653589793*phi)*(1 - cos(3.141592653589793*time));
  z = noEvent(if time < 1 then 1 - exp(-turned) else (2 - exp(-2*W/(3.141592653589793*phi)))*exp(turned - 2*W/(3.141592653589793*phi)) - 1);
  y = z + T/phi*(omega - noEvent(abs(omega))*z)/(1 + (2*T/phi*omega)^2);
  wheel.brake_torque = T_b;
  wheel.rolling_torque = 0;
  source.tau - I*W*3.141592653589793*cos(3.141592653589793*time) - expected = 0;
  connect(source.hub, wheel.hub) annotation(Line(points={{60,0},{60,-40},{-60,-40},{-60,-20}}, color={95,95,95}));
  expected = T_b*y*noEvent(if y > 0 then 1 else reverse_braking);
  annotation(
    experiment(StartTime=0, StopTime=2, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The wheel, at rest first, is turned forward and back by the torque that gives it an angular velocity of a sine, if the brake is
as expected. While it turns one way, the wind-up approaches 1, or -1, exponentially over the angle <code>phi</code>.</p>
</html>"));
end WheelAtRest;
