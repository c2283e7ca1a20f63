within OverrunHitch.Validation;
model TyreAtRest "Body let go on a slope, its wheel held: tyre as a spring"
  constant Units.Mass M = 1000 "Mass";
  constant Units.SlipStiffness C_k = 4000 "Tyre force per unit of small slip";
  constant Units.Length sigma = 0.4 "Relaxation length";
  constant Real zeta(final unit="1") = 0.3 "Damping ratio";
  constant Units.Acceleration g_x = 0.5 "Gravity along the road";
  constant Real w_0(final unit="rad/s") = sqrt(C_k/(sigma*M)) "Angular frequency without damping";
  constant Real w(final unit="rad/s") = w_0*sqrt(1 - zeta^2) "Angular frequency";
  Components.Tyre tyre(C_k=C_k, M=M, sigma=sigma, zeta=zeta, final v_low=1e6, final mu=1e9) "Tyre" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.Body body(M=M, v(start=0)) "Body" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.Wheel wheel(final I=1e12, omega(start=0), z(start=0)) "Held" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  output Units.Position value = body.x "Position";
  output Units.Position expected "Its closed form";
  output Units.Position error = value - expected "Error";
equation
  wheel.brake_torque = 0;
  tyre.g_z = Units.g_n;
  body.g_x = g_x;
  connect(body.axle, tyre.axle) annotation(Line(points={{0,-20},{0,-40},{-30,-40},{-30,30},{-60,30},{-60,20}}, color={0,127,0}));
  connect(tyre.rolling_torque, wheel.rolling_torque) annotation(Line(points={{-40,0},{-30,0},{-30,-40},{90,-40},{90,0},{80,0}}, color={0,0,127}));
  connect(wheel.hub, tyre.hub) annotation(Line(points={{60,-20},{60,-30},{-60,-30},{-60,0}}, color={95,95,95}));
  expected = g_x/w_0^2*(1 - exp(-zeta*w_0*time)*(cos(w*time) + zeta*w_0/w*sin(w*time)));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-9, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The tyre that stands is a spring <code>C_k/sigma</code> with a damper, on which the body settles. At speed slip takes over
from the deflection, as the square of the speed over <code>v_low</code>; the closed form is the limit for small speeds, so
<code>v_low</code> is far away here, and friction too.</p>
</html>"));
end TyreAtRest;
