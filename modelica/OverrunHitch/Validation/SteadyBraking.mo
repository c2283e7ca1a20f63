within OverrunHitch.Validation;
model SteadyBraking "Steady braking of car and trailer: the paper's equation 15"
  constant Units.Mass M_c = 1000 "Mass of the car";
  constant Units.Mass M_t = 800 "Mass of the trailer";
  constant Units.MomentOfInertia I_c = 10 "Inertia of the car's wheels";
  constant Units.MomentOfInertia I_t = 8 "Inertia of the trailer's wheels";
  constant Units.Radius R_c = 0.3 "Wheel radius of the car";
  constant Units.Radius R_t = 0.25 "Wheel radius of the trailer";
  constant Units.Stiffness k = 20000 "Drawbar stiffness in compression";
  constant Units.TorquePerLength r = 5000 "Trailer brake torque per unit of compression beyond the clearance";
  constant Units.Length eps = 0.1 "Clearance";
  constant Units.Velocity V_0 = 40 "Speed at the start";
  constant Units.Torque T_b = 1000 "Brake torque of the car";
  constant Real share(final unit="1") = k/(k + r/R_t) "Share of the drawbar in what slows the trailer";
  constant Units.Acceleration A = -T_b/R_c/(M_c + I_c/R_c^2 + share*(M_t + I_t/R_t^2)) "Acceleration";
  constant Units.Length D = eps - A*(M_t + I_t/R_t^2)/(k + r/R_t) "Compression";
  Systems.CarTrailer combination(M_c=M_c, M_t=M_t, I_c=I_c, I_t=I_t, R_c=R_c, R_t=R_t, final C_kc=1e9, final C_kt=1e9, k=k, r=r, eps=eps, final V_0=V_0, compression_start=D) "Combination" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  output Units.Velocity value = combination.v_trailer "Speed of the trailer";
  output Units.Velocity expected "Its closed form";
  output Units.Velocity error = value - expected "Error";
equation
  combination.brake_torque = T_b;
  combination.grade = 0;
  expected = V_0 + A*time;
  annotation(
    experiment(StartTime=0, StopTime=12, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>Car and trailer start with the compression of steady braking and keep it. Equation 15 lets the wheels turn as if without slip, and
is off by slip times the wheels' share of the inertia; so the tyres are stiff here, with slips of some 1e-6.</p>
</html>"));
end SteadyBraking;
