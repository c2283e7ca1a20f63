within OverrunHitch.Validation;
model Hitch "Hitch in reverse: spring, damper, and brakes that follow with their lag and their share"
  constant Units.Stiffness k = 5000 "Stiffness in compression";
  constant Units.Damping C = 400 "Damper coefficient";
  constant Units.TorquePerLength r = 16000 "Brake torque per unit of drawbar compression beyond the clearance";
  constant Units.Length eps = 0.01 "Clearance";
  constant Units.Time tau_b = 0.05 "Lag of the torque";
  constant Units.Share reverse_braking = 0.4 "Share of the torque backward";
  constant Units.Length x_0 = 0.05 "Compression about which it moves";
  constant Units.Length a = 0.03 "Amplitude: it stays beyond the clearance";
  constant Units.AngularVelocity omega = 8 "Angular frequency";
  constant Units.Radius R = 0.35 "Radius of the wheels, to make a force of the torque";
  Systems.Hitch hitch(k=k, C=C, r=r, eps=eps, tau_b=tau_b, reverse_braking=reverse_braking, compression_start=x_0) "Hitch" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length lagging "What the sine has become after the lag, in closed form";
  output Units.Force value = hitch.F_hitch + hitch.trailer_brake_torque/R "Hitch force, and brake torque as a force";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  hitch.v_trailer = -2;
  hitch.v_car = -2 - a*omega*cos(omega*time);
  hitch.a_car = 0;
  hitch.a_trailer = 0;
  hitch.compression_in = 0;
  lagging = a/(1 + (omega*tau_b)^2)*(sin(omega*time) - omega*tau_b*(cos(omega*time) - exp(-time/tau_b)));
  expected = k*(x_0 + a*sin(omega*time) - eps) + C*a*omega*cos(omega*time) + reverse_braking*r/R*(x_0 - eps + lagging);
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p><code>Bench</code>, between a car and a trailer that roll backward: the linkage's share of the torque is left, and the force is that of
the difference of the speeds.</p>
</html>"));
end Hitch;
