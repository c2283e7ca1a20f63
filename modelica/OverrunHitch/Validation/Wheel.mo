within OverrunHitch.Validation;
model Wheel "Wheel that turns backward, slowed by rolling resistance and the share of the brake that is not locked out"
  constant Units.MomentOfInertia I = 3 "Moment of inertia";
  constant Units.Share reverse_braking = 0.4 "Share of the brake torque that acts backward";
  constant Units.AngularVelocity omega_0 = -60 "Angular velocity at the start";
  constant Units.Torque T_b = 50 "Mean brake torque";
  constant Units.Torque T_r = 10 "Rolling resistance";
  Components.Wheel wheel(I=I, reverse_braking=reverse_braking, omega(start=omega_0), z(start=-1)) "Wheel" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  output Units.AngularVelocity value = wheel.omega "Angular velocity";
  output Units.AngularVelocity expected "Its closed form";
  output Units.AngularVelocity error = value - expected "Error";
equation
  wheel.brake_torque = T_b*(1 - cos(3*time));
  wheel.rolling_torque = T_r;
  expected = omega_0 + (reverse_braking*T_b*(time - sin(3*time)/3) + T_r*time)/I;
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The brake torque comes and goes with time, the rolling resistance is constant. The angular velocity is their integral.</p>
</html>"));
end Wheel;
