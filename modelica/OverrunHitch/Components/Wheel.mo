within OverrunHitch.Components;
model Wheel "Spin of a braked wheel"
  parameter Units.MomentOfInertia I = 5 "Polar moment of inertia (all wheels of the vehicle lumped)";
  parameter Units.Angle phi_brake = 0.01 "Angle over which a brake that held takes hold of the other direction";
  parameter Units.Time T_brake = 0.05 "Damping of a brake that holds, over its stiffness";
  parameter Units.Share reverse_braking = 1 "Share of the brake torque that acts on a wheel that turns backward";
  Interfaces.Hub hub "Joined to the tyre" annotation(Placement(transformation(extent={{-10,-110},{10,-90}})));
  Interfaces.TorqueInput brake_torque "Torque that the brake can hold, at least 0" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.TorqueInput rolling_torque "Torque that the rolling resistance can hold" annotation(Placement(transformation(extent={{120,-20},{80,20}})));
  Units.AngularVelocity omega(start=114, fixed=true) "Angular velocity, positive rolling forward";
  Real z(start=1, fixed=true, final unit="1", nominal=1) "Wind-up of the friction: 1 when the wheel rolls forward, -1 backward";
  Real y(final unit="1") "Share of the friction that acts, positive against rolling forward";
  Units.Torque tau "Brake torque on the wheel, positive when it slows a wheel that rolls forward";
  Units.Torque tau_r "Rolling resistance, positive when it slows a wheel that rolls forward";
equation
  hub.omega = omega;
  phi_brake*der(z) = omega - noEvent(abs(omega))*z "Dahl's friction";
  y = z + T_brake*der(z)/(1 + (2*T_brake/phi_brake*omega)^2) "Never more than 1";
  tau = brake_torque*noEvent(if y > 0 then y else reverse_braking*y);
  tau_r = rolling_torque*y;
  I*der(omega) = hub.tau - tau - tau_r "Paper's equations 3 and 4, and rolling resistance";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-70,70},{70,-70}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-40,40},{40,-40}}, lineColor={60,60,60}, fillColor={230,230,230}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,110},{100,75}}, textColor={0,0,255}, textString="%name"),
      Text(extent={{-40,15},{40,-15}}, textColor={60,60,60}, textString="I=%I")}),
    Documentation(info="<html>
<p>Euler's equation of the wheel's spin (the paper's equations 3 and 4). The brake is friction: while the wheel rolls, its
torque is <code>brake_torque</code> against the rolling, as in the paper. A wheel that has stopped is held, up to that torque,
as by a stiff spring that winds up: <code>z</code> follows P. R. Dahl's law, under which friction reverses over the angle
<code>phi_brake</code>. So it never drives a stopped wheel. <code>z</code> is exactly 1 (or -1) in a run that starts rolling
forward (or backward), until the wheel stops.</p>
<p>Rolling resistance, which the paper leaves out, is friction too: it resists the turning and holds what little it can at rest.
Of the brake torque only the share <code>reverse_braking</code> acts backward: 1 for a plain brake, 0 for one with a
reversing lock-out, which lets go as soon as the wheel pulls backward.</p>
<p>Source: P. R. Dahl, <em>A solid friction model</em>, Aerospace Corporation TOR-0158(3107-18)-1, 1968. The damping is
that of C. Canudas de Wit and others, <em>A new model for control of systems with friction</em>, IEEE Transactions on
Automatic Control 40:3 (1995) 419-425; it settles a wheel that slides without turning.</p>
</html>"));
end Wheel;
