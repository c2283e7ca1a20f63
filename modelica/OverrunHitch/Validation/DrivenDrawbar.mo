within OverrunHitch.Validation;
model DrivenDrawbar "Driven drawbar that is told of another gap: the work that it does, and its impulse"
  constant Units.Stiffness k_t = 3000 "Stiffness in tension";
  constant Units.Damping C = 400 "Damper coefficient";
  constant Units.Time T = 0.5 "Time over which the compression follows the gap";
  constant Units.Length x_0 = -0.3 "Compression at the start";
  constant Units.Length c = -0.5 "Gap, which does not move";
  constant Units.Velocity V = 0.6 "Largest difference of the speeds";
  constant Units.Velocity U = 2 "Speed of the rear";
  constant Real w(final unit="rad/s") = 3 "Angular frequency";
  Components.DrivenDrawbar drawbar(k_t=k_t, C=C, T_gap=T, compression(start=x_0)) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length b "Amplitude that is left of the forced motion";
  Units.Length a "What is left of the start";
  Real E(final unit="1") "How it decays";
  Real E_s(final unit="s") "Integral of the decay, times the sine";
  output Units.Energy value = drawbar.work + U*drawbar.impulse "Work on the front, for an observer at rest: U is the speed that both have in common";
  output Units.Energy expected "Its closed form";
  output Units.Energy error = value - expected "Error";
equation
  drawbar.v_front = U + V*sin(w*time);
  drawbar.v_rear = U;
  drawbar.gap = c;
  b = V*T/(1 + (w*T)^2);
  a = x_0 - c - w*T*b;
  E = exp(-time/T);
  E_s = (w - E*(w*cos(w*time) + sin(w*time)/T))/(w^2 + 1/T^2);
  expected = C*V^2*(sin(2*w*time)/(4*w) - time/2) - U*C*V*(1 - cos(w*time))/w
    + k_t*U*(c*time - b*((1 - cos(w*time))/w - T*sin(w*time)) + a*T*(1 - E))
    + k_t*V*(c*(1 - cos(w*time))/w - b*(time/2 - sin(2*w*time)/(4*w) - T*sin(w*time)^2/2) + a*E_s);
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The front moves to and fro beside a rear of constant speed; the compression <code>x</code> goes from its start to a gap that stands still
by <code>der(x) = v_rel + (c - x)/T</code>, and with it the force of the spring, while the damper sees <code>v_rel</code> alone. The
closed form is <code>x = c - b (sin(w t) - w T cos(w t)) + a exp(-t/T)</code>.</p>
</html>"));
end DrivenDrawbar;
