within OverrunHitch.Validation;
model BrakeLag "Linkage whose drawbar is pushed in steadily: torque that follows with a lag"
  constant Units.TorquePerLength r = 16000 "Brake torque per unit of drawbar compression beyond the clearance";
  constant Units.Length eps = 0.01 "Clearance";
  constant Units.Time tau_b = 0.05 "Lag of the torque";
  constant Units.Velocity v = 0.2 "Rate of compression";
  Components.BrakeLinkage linkage(r=r, eps=eps, tau_b=tau_b) "Linkage" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length x "Compression, in closed form";
  output Units.Torque value = linkage.brake_torque "Brake torque";
  output Units.Torque expected "Its closed form";
  output Units.Torque error = value - expected "Error";
equation
  x = 0.02 + v*time;
  linkage.compression = x;
  expected = r*(x - eps) - r*v*tau_b*(1 - exp(-time/tau_b));
  annotation(
    experiment(StartTime=0, StopTime=0.5, Tolerance=1e-8, Interval=0.001),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>At the start the brakes have followed; then the torque falls behind the compression until it lags by <code>tau_b</code>.</p>
</html>"));
end BrakeLag;
