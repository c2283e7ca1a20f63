within OverrunHitch.Components;
model DrawbarFriction "Dry friction in the guide of a drawbar"
  extends Interfaces.PartialDrawbarForce;
  parameter Units.Force F_f(min=0, max=1e6) = 0 "Friction force";
  parameter Units.Length x_f = 1e-4 "Travel over which friction reverses";
  parameter Units.Time T_f = 0.02 "Damping of a guide that sticks, over its stiffness";
  Real z(start=0, fixed=true, final unit="1", nominal=1) "Wind-up of the friction: 1 while the drawbar is pushed in, -1 while it springs back";
  Units.Velocity w "Rate at which it winds up, as a speed";
equation
  w = noEvent(if F_f > 0 then v_rel - abs(v_rel)*z else 0);
  x_f*der(z) = w "Dahl's friction";
  F = noEvent(if F_f > 0 then F_f*(z + T_f/x_f*w/(1 + (2*T_f/x_f*v_rel)^2)) else 0) "Never more than F_f";
  annotation(
    Icon(graphics={
      Line(points={{-70,-50},{40,-50},{60,50},{-50,50},{-70,-50}}, color={0,127,0}, thickness=1)}),
    Documentation(info="<html>
<p>Friction resists the motion with <code>F_f</code> whatever its speed; it gives the force over the travel the hysteresis that
devices have. A guide at rest is held, up to that force, as by a stiff spring that winds up: <code>z</code> follows
P. R. Dahl's law, as in <code>Wheel</code>, under which friction reverses over a travel of some <code>x_f</code>. A cycle of
amplitude <code>a</code> costs <code>4 F_f (a - x_f)</code>, but for what is beyond the first order.</p>
<p>At the start friction is unwound. Without friction (<code>F_f = 0</code>) <code>z</code> stays 0.</p>
<p>Sources: those of <code>Wheel</code>.</p>
</html>"));
end DrawbarFriction;
