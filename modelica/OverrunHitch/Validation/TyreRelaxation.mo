within OverrunHitch.Validation;
model TyreRelaxation "Tyre that begins to slip: its force follows over the relaxation length"
  constant Units.SlipStiffness C_k = 90000 "Tyre force per unit of slip";
  constant Units.Length sigma = 0.5 "Relaxation length";
  constant Units.Velocity v = 10 "Speed of the axle";
  constant Units.Velocity v_slip = 0.1 "Slip speed";
  constant Units.Radius R = 0.3 "Radius";
  Components.Tyre tyre(C_k=C_k, R=R, sigma=sigma, final M=600, final mu=1e9) "Tyre" annotation(Placement(transformation(extent={{-80,-20},{-40,20}})));
  Components.TowBall axle "Moves the axle" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.Wheel wheel(final I=1e12, omega(start=(v - v_slip)/R)) "Turns steadily: a flywheel" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  output Units.Force value = tyre.F "Tyre force";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  axle.v = v;
  wheel.brake_torque = 0;
  tyre.g_z = Units.g_n;
  connect(axle.drawbar, tyre.axle) annotation(Line(points={{-20,0},{-30,0},{-30,30},{-60,30},{-60,20}}, color={0,127,0}));
  connect(tyre.rolling_torque, wheel.rolling_torque) annotation(Line(points={{-40,0},{-30,0},{-30,-40},{90,-40},{90,0},{80,0}}, color={0,0,127}));
  connect(wheel.hub, tyre.hub) annotation(Line(points={{60,-20},{60,-30},{-60,-30},{-60,0}}, color={95,95,95}));
  expected = C_k*v_slip/v*(1 - exp(-v*time/sigma));
  annotation(
    experiment(StartTime=0, StopTime=0.3, Tolerance=1e-8, Interval=0.002),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>Speed and slip speed are constant from the start on, when the tyre has no deflection yet. It builds up with the time
constant <code>sigma/v</code>, and the force with it.</p>
</html>"));
end TyreRelaxation;
