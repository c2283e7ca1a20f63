within OverrunHitch.Components;
model Tyre "Tyre whose force follows from longitudinal slip, limited by friction; it holds at standstill"
  parameter Units.SlipStiffness C_k = 400000 "Retarding force per unit of small slip";
  parameter Units.Radius R = 0.35 "Rolling radius";
  parameter Units.Mass M = 1000 "Mass that loads the tyre";
  parameter Units.Friction mu = 1e9 "Friction between tyre and road: largest force over load";
  parameter Units.Share mu_slide(min=0.5, max=0.95) = 0.75 "Friction of a wheel that slides without turning, over mu";
  parameter Units.RollingResistance C_rr = 0 "Rolling resistance over load";
  parameter Units.Length sigma(min=0, max=10000) = 0 "Relaxation length, over which the force follows the slip; 0: at once";
  parameter Units.Velocity v_low = 0.5 "Below this speed the tyre's deflection counts instead of its slip";
  parameter Real zeta(final unit="1") = 0.5 "Damping ratio of the mass on the tyre that stands";
  constant Units.Length l_0 = 0.3 "C_k over the stiffness of the tyre at rest, where sigma does not tell it";
  constant Units.Length l_least = 1e-6 "A relaxation length below counts as this: what lags by nanometres is stiff beyond double precision at rest";
  constant Real C_x(final unit="1") = 1.685 "Shape factor of the magic formula: p_Cx1 of Pacejka's 205/60R15";
  constant Real E_x1(final unit="1") = 0.344 "Curvature factor of a wheel that locks before the peak, and at rest: p_Ex1 of Pacejka's 205/60R15";
  constant Real X_peak(final unit="1") = 1.5329258834444335 "Argument at the peak with it: C_x*atan(X - E_x1*(X - atan(X))) = pi/2";
  Interfaces.Flange axle "Joined to the body" annotation(Placement(transformation(extent={{-10,90},{10,110}})));
  Interfaces.Hub hub "Joined to the wheel" annotation(Placement(transformation(extent={{-10,-10},{10,10}})));
  Interfaces.AccelerationInput g_z "Gravity onto the road" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.TorqueOutput rolling_torque "Largest torque of the rolling resistance" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
  Units.Velocity v "Speed of the axle, positive forward";
  Units.Velocity v_abs "Its magnitude";
  Units.Velocity v_slip "Slip speed, positive when braking a tyre that rolls forward";
  Real y(final unit="1") "Speed as a share of v_low, 1 at most";
  Real w(final unit="1") "Weight of the deflection: 0 from v_low on, 1 at rest";
  Units.Velocity v_slide "What lets the deflection fade while it slides";
  Units.Velocity v_fade "What lets it fade: rolling or sliding";
  Units.Deflection u(start=0, fixed=true) "Deflection of the tyre, positive when braking a tyre that rolls forward";
  Units.Slip slip_roll "Slip of the rolling tyre, positive when braking";
  Units.Slip slip_rest "Deflection of the standing one, as a slip";
  Units.Slip slip "Longitudinal slip, positive when braking: of both what counts";
  Units.Force F_max "Largest force";
  Real X(final unit="1") "Argument of the magic formula, rolling";
  Real X_rest(final unit="1") "The same at rest, not beyond the peak";
  Units.Force F_roll "Force of the rolling tyre";
  Units.Force F "Tyre force, positive retarding";
protected
  parameter Units.Length l = noEvent(if sigma > 0 then max(sigma, l_least) else l_0) "C_k over the stiffness of the tyre at rest";
  parameter Units.Velocity v_least = 0.01*v_low "Below this speed no slip is told: it has no weight";
  parameter Real lag(final unit="1") = noEvent(if sigma > 0 then 1 else 0) "Share of the slip that follows with a lag";
  parameter Real X_lock(final unit="1") = C_k/(C_x*mu*M*Units.g_n) "Argument of the magic formula of a locked wheel";
  parameter Real B_lock(final unit="1") = tan((3.141592653589793 - asin(mu_slide))/C_x) "What the curvature is to make of it";
  parameter Real E_x(final unit="1") = noEvent(if X_lock > X_peak then (X_lock - B_lock)/(X_lock - atan(X_lock)) else E_x1) "Curvature factor";
  parameter Units.Slip s_slide = X_peak*C_x*mu_slide*mu*M*Units.g_n/C_k "Deflection with which a tyre slides, as a slip";
  parameter Units.Slowness d = 2*zeta*sqrt(M/(C_k*l)) "Slip per slip speed that gives the damping zeta";
equation
  v = der(axle.s);
  v_abs = noEvent(abs(v));
  v_slip = v - R*hub.omega;
  y = noEvent(if v_abs < v_low then v_abs/v_low else 1);
  w = noEvent(if v_abs < v_low then 1 - y^3*(4 - 3*y) else 0);
  F_max = mu*M*g_z;
  v_slide = noEvent(abs(v_slip)/s_slide);
  v_fade = noEvent(if v_abs < v_low then max(v_abs*y*(2 - y) + w*v_slide, max(1 - w, lag)*v_slide) else max(v_abs, v_slide));
  der(u) = v_slip - v_fade*u/l;
  slip_roll = noEvent(if v_abs < v_least then 1/v_least else 1/v_abs)*(v_slip - lag*der(u)) "Without lag the paper's equations 7 and 8";
  slip_rest = noEvent(if v_abs < v_low then u/l + d*der(u) else 0);
  slip = noEvent(if v_abs < v_low then (1 - w)*slip_roll + w*slip_rest else slip_roll);
  X = C_k*slip_roll/(C_x*F_max);
  X_rest = noEvent(if v_abs < v_low then max(-X_peak, min(X_peak, C_k*slip_rest/(C_x*mu_slide*F_max))) else 0);
  F_roll = F_max*sin(C_x*atan(X - E_x*(X - atan(X)))) "C_k*slip_roll, where it is small against F_max";
  F = noEvent(if v_abs < v_low then (1 - w)*F_roll + w*mu_slide*F_max*sin(C_x*atan(X_rest - E_x1*(X_rest - atan(X_rest)))) else F_roll);
  rolling_torque = C_rr*M*g_z*R;
  axle.f = F;
  hub.tau = -R*F;
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-80,80},{80,-80}}, lineColor={60,60,60}, fillColor={60,60,60}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-50,50},{50,-50}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-100,-80},{100,-80}}, color={60,60,60}, thickness=1),
      Text(extent={{-100,140},{100,105}}, textColor={0,0,255}, textString="%name"),
      Text(extent={{-48,15},{48,-15}}, textColor={60,60,60}, textString="C_k=%C_k")}),
    Documentation(info="<html>
<p>From <code>v_low</code> on, in both directions, the force depends on the longitudinal slip
<code>(v - R omega)/|v|</code>. While it is small against the friction limit it is proportional to the slip (the paper's
equations 7 and 8, good for slips up to about 0.1). Friction limits it to <code>mu</code> times the load; beyond that peak it
falls as H. B. Pacejka's magic formula tells, whose slope at zero slip is <code>C_k</code>, to <code>mu_slide</code> of the peak
where the wheel is locked (slip 1): that determines the curvature <code>E_x</code>, on a level road. With the default
<code>mu</code> the limit is out of reach and the force that of the paper.</p>
<p>With a relaxation length <code>sigma</code> the force follows the slip over that distance, as that of a tyre does whose
deflection has to build up; the paper has none (<code>sigma = 0</code>). Sliding limits the deflection: with a slip beyond
<code>s_slide</code> it stays that of sliding, and the force follows the slip over a distance that is shorter in proportion.</p>
<p>At rest there is no slip to speak of: a tyre that stands is a spring of the stiffness <code>C_k/l</code>, which holds a
vehicle on a slope without creeping. Its deflection <code>u</code> is that of a tyre with the relaxation length
<code>l</code> (<code>sigma</code>, or 0.3 m if that is 0); it fades over that distance when the tyre rolls, not when it stands, and sliding limits it to where its
force is that of sliding, <code>mu_slide</code> of the peak: more does not hold a wheel that has stopped. From <code>v_low</code> down it takes over; above, it takes no part. The damping of the tyre that stands
is artificial, as in Pacejka's own model for low speeds, and disappears at <code>v_low</code> too.</p>
<p>Rejected: one magic formula of a weighted slip; a locked wheel then passes the peak as the vehicle comes to rest. And a
deflection that grows with the slip without limit: that of a locked wheel would be as long as <code>sigma</code>, and throw the
vehicle back when it has stopped.</p>
<p>Rejected too: a slip over a speed that is kept from zero. It is regular as well, but it creeps on a slope.</p>
<p>The tyre pulls the body back with <code>F</code> and spins the wheel forward with <code>R F</code>. Its rolling resistance,
<code>C_rr</code> times the load, is a torque against the turning of the wheel: friction, which <code>Wheel</code> applies as it
applies that of the brake.</p>
<p>Sources: H. B. Pacejka, <em>Tyre and Vehicle Dynamics</em>, 2nd ed. 2006: magic formula section 4.3, standstill section
8.6, <code>C_x</code> and <code>E_x</code> table A3.1 (205/60R15 at 4 kN, its <code>mu</code> 1.21).</p>
</html>"));
end Tyre;
