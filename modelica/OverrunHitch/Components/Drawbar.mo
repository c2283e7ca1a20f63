within OverrunHitch.Components;
model Drawbar "Sliding drawbar with damper, clearance and its own stiffness in tension"
  parameter Units.Stiffness k = 5480 "Stiffness in compression";
  parameter Units.Stiffness k_t = 548000 "Stiffness in tension";
  parameter Units.Damping C = 500 "Damper coefficient";
  parameter Units.Length eps(min=0) = 0 "Clearance (backlash)";
  parameter Units.Force F_pull_max(min=0) = 1e9 "Largest force of the damper against the contact: 0 for a spring that never pulls";
  parameter Real rebound(final unit="1", min=0) = 1 "Damper coefficient while the drawbar springs back, over C";
  parameter Units.Force F_0(min=0) = 0 "Threshold: push up to which the spring, clamped, does not give";
  parameter Units.Length x_2(min=0) = 1000 "Compression beyond the clearance from which the stiffness is k_2";
  parameter Units.Stiffness k_2 = 5480 "Stiffness from x_2 on";
  parameter Units.Length x_3(min=0) = 1000 "Compression beyond the clearance from which the stiffness is k_3";
  parameter Units.Stiffness k_3 = 5480 "Stiffness from x_3 on";
  parameter Units.Length travel(min=0) = 1000 "Compression at which the drawbar meets its buffer";
  parameter Units.Stiffness k_buffer = 548000 "Stiffness from there on";
  final parameter Units.Length s_1 = eps + noEvent(if F_0 > 0 then F_0/k_t else 0) "Compression at which the spring begins to give";
  Interfaces.Flange front "Joined to the car" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
  Interfaces.Flange rear "Joined to the trailer" annotation(Placement(transformation(extent={{-110,-10},{-90,10}})));
  Interfaces.LengthOutput compression(stateSelect=StateSelect.prefer, nominal=0.1) "Drawbar compression = rear.s - front.s" annotation(Placement(transformation(extent={{-10,-110},{10,-90}}, rotation=-90)));
  Units.Velocity v_rel "Rate of compression";
  Units.Force F_spring "Force of springs and buffer, positive in compression";
  Units.Force F_damper "Force of the damper, positive while pushed in";
  Units.Force F_free "Hitch force of springs and damper, without limit, positive in tension";
  Units.Force F_h "Hitch force, positive in tension";
protected
  parameter Units.Length s_4 = noEvent(max(s_1, travel)) "Compression at which the buffer begins to give";
  parameter Units.Length s_2 = noEvent(min(max(s_1, eps + x_2), s_4)) "Compression from which the stiffness is k_2";
  parameter Units.Length s_3 = noEvent(min(max(s_2, eps + x_3), s_4)) "Compression from which the stiffness is k_3";
  parameter Units.Force F_2 = F_0 + k*(s_2 - s_1) "Force at s_2";
  parameter Units.Force F_3 = F_2 + k_2*(s_3 - s_2) "Force at s_3";
  parameter Units.Force F_4 = F_3 + k_3*(s_4 - s_3) "Force at s_4";
  parameter Units.Slowness sense = noEvent(if abs(rebound - 1) > 0 then 0.01 else 0) "0: a damper with one coefficient; else so small that less than 1e-10 m/s, which is rounding, has no direction";
  parameter Units.Damping C_rebound = rebound*C "Damper coefficient while the drawbar springs back";
equation
  compression = rear.s - front.s;
  v_rel = der(compression);
  F_spring = if compression > s_1 then (if compression > s_2 then (if compression > s_3 then (if compression > s_4
    then F_4 + k_buffer*(compression - s_4) else F_3 + k_3*(compression - s_3)) else F_2 + k_2*(compression - s_2))
    else F_0 + k*(compression - s_1)) elseif compression > eps then k_t*(compression - eps) elseif compression < 0 then k_t*compression else 0;
  F_damper = if sense*v_rel < 0 then C_rebound*v_rel else C*v_rel "No event where both are the same";
  F_free = -F_damper - F_spring "Paper's equation 5, in its three regimes of section 6";
  F_h = if compression >= 0 and F_free > F_pull_max then F_pull_max elseif compression <= eps and F_free < -F_pull_max then -F_pull_max else F_free "Pull limited unless the stop is reached, push unless the spring is";
  front.f = F_h;
  rear.f = -F_h;
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Line(points={{-90,30},{-50,30},{-40,50},{-20,10},{0,50},{20,10},{40,50},{50,30},{90,30}}, color={0,127,0}),
      Line(points={{-90,-30},{-20,-30}}, color={0,127,0}),
      Rectangle(extent={{-20,-10},{30,-50}}, lineColor={0,127,0}, fillColor={220,240,220}, fillPattern=FillPattern.Solid),
      Line(points={{30,-30},{90,-30}}, color={0,127,0}),
      Line(points={{-90,30},{-90,-30}}, color={0,127,0}),
      Line(points={{90,30},{90,-30}}, color={0,127,0}),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>The three regimes of the paper's section 6: beyond the clearance <code>eps</code> the spring <code>k</code> resists
compression, within the clearance there is no spring force, in tension the drawbar has the stiffness <code>k_t</code>.
The damper acts in all three.</p>
<p>As sold, such devices have more, all of it out of reach by default. The force is one function of the compression,
continuous and linear in pieces; each kink is an event.</p>
<ul>
<li>Threshold <code>F_0</code>: the spring is clamped with it. Up to that push only the frame gives, by <code>k_t</code> from
<code>eps</code> on; from <code>s_1 = eps + F_0/k_t</code> on the spring does. (A force that jumps to <code>F_0</code> would hold
the drawbar on the jump, where a simulation chatters.)</li>
<li>Further stiffnesses <code>k_2</code> from <code>eps + x_2</code> on and <code>k_3</code> from <code>eps + x_3</code> on, in this
order.</li>
<li>End of travel: from <code>travel</code> on, whatever stands above, the stiffness is <code>k_buffer</code>.</li>
<li><code>rebound</code>: the damper's coefficient while the compression decreases, over <code>C</code>. The damper's force
is continuous; where the coefficients differ, a change of direction is an event: without, the error was 40 times as large
or more at the same tolerance.</li>
</ul>
<p>The compression is preferred as a state to the position of one of the vehicles: positions grow without limit, and a
relative tolerance on them says little about their difference.</p>
<p>An always acting damper pulls while the drawbar springs back fast from compression; the paper's does. The limit
<code>F_pull_max</code> is for drawbars whose damper sits in the contact: the hitch force does not pull beyond it unless the
drawbar is at its stop in tension, and does not push beyond it unless the spring is compressed. With 0 the contact in
compression only pushes, the stop only pulls, and within the clearance there is no force; the force then jumps where a
moving contact closes. The default is beyond any damper, so the paper's always acts.</p>
</html>"));
end Drawbar;
