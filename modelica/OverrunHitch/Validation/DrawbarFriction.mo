within OverrunHitch.Validation;
model DrawbarFriction "Guide that is pushed in and pulled out: Dahl's friction, and its hysteresis"
  constant Units.Force F_f = 80 "Friction force";
  constant Units.Length x_f = 0.002 "Travel over which friction reverses";
  constant Units.Time T_f = 0.02 "Damping of a guide that sticks, over its stiffness";
  constant Units.Length a = 0.01 "Amplitude";
  constant Units.AngularVelocity omega = 3 "Angular frequency";
  Components.DrawbarFriction friction(F_f=F_f, x_f=x_f, T_f=T_f) "Guide" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length x "Compression, in closed form";
  Units.Velocity v "Its rate";
  Real z(final unit="1") "Wind-up, in closed form";
  Units.Velocity w "Rate at which it winds up";
  output Units.Force value = friction.F "Force of the guide";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  x = a*(1 - cos(omega*time));
  v = a*omega*sin(omega*time);
  friction.compression = x;
  friction.v_rel = v;
  z = noEvent(if v >= 0 then 1 - exp(-x/x_f) else (2 - exp(-2*a/x_f))*exp((x - 2*a)/x_f) - 1);
  w = v - noEvent(abs(v))*z;
  expected = F_f*(z + T_f/x_f*w/(1 + (2*T_f/x_f*v)^2));
  annotation(
    experiment(StartTime=0, StopTime=2, Tolerance=1e-8, Interval=0.005),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The guide is pushed in and pulled out again, once. Under a motion that does not reverse Dahl's friction is an exponential
of the travel.</p>
</html>"));
end DrawbarFriction;
