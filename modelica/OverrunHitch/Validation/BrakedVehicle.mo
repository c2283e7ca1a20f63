within OverrunHitch.Validation;
model BrakedVehicle "Vehicle that brakes on a slope: constant slip and deceleration"
  constant Units.Mass M = 900 "Mass";
  constant Units.MomentOfInertia I = 6 "Moment of inertia of the wheels";
  constant Units.Radius R = 0.3 "Wheel radius";
  constant Units.SlipStiffness C_k = 20000 "Tyre force per unit slip";
  constant Units.Velocity V_0 = 40 "Speed at the start";
  constant Units.RollingResistance C_rr = 0.05 "Rolling resistance over load";
  constant Units.Torque T_b = 1000 "Brake torque";
  constant Units.Acceleration g_x = 0.4 "Gravity along the road";
  constant Units.Torque T = T_b + C_rr*M*Units.g_n*R "Torque against the rolling";
  constant Real b(final unit="1") = M*R^2/I + 1 + M*g_x/C_k "Sum of the slips that solve the quadratic equation";
  constant Units.Slip s = 0.5*(b - sqrt(b^2 - 4*M*(T*R/I + g_x)/C_k)) "Slip";
  constant Units.Acceleration a = g_x - C_k*s/M "Acceleration";
  Components.BrakedVehicle vehicle(M=M, I=I, R=R, C_k=C_k, final V_0=V_0, C_rr=C_rr, wheel(omega(start=(1 - s)*V_0/R))) "Vehicle" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  output Units.AngularVelocity value = vehicle.wheel.omega "Angular velocity of the wheels";
  output Units.AngularVelocity expected "Its closed form";
  output Units.AngularVelocity error = value - expected "Error";
equation
  vehicle.brake_torque = T_b;
  vehicle.g_x = g_x;
  vehicle.g_z = Units.g_n;
  expected = (1 - s)*(V_0 + a*time)/R;
  annotation(
    experiment(StartTime=0, StopTime=8, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>With the paper's tyre a vehicle that is slowed by constant torques can keep its slip <code>s</code>, and then slows down uniformly:
<code>M a = M g_x - C_k s</code> and <code>I (1 - s) a/R = R C_k s - T</code>, a quadratic equation for <code>s</code>. It starts
with that slip.</p>
</html>"));
end BrakedVehicle;
