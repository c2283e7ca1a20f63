within OverrunHitch.Components;
model DrawbarSpring "Force of a drawbar's springs over its compression: linear in pieces, continuous"
  extends Interfaces.PartialDrawbarForce;
  parameter Units.Stiffness k = 5480 "Stiffness in compression";
  parameter Units.Stiffness k_t = 548000 "Stiffness in tension";
  parameter Units.Length eps(min=0, max=10000) = 0 "Clearance (backlash)";
  parameter Units.Force F_0(min=0, max=1e12) = 0 "Threshold: push up to which the spring, clamped, does not give";
  parameter Units.Length x_2(min=0, max=10000) = 1000 "Compression beyond the clearance from which the stiffness is k_2";
  parameter Units.Stiffness k_2 = 5480 "Stiffness from x_2 on";
  parameter Units.Length x_3(min=0, max=10000) = 1000 "Compression beyond the clearance from which the stiffness is k_3";
  parameter Units.Stiffness k_3 = 5480 "Stiffness from x_3 on";
  parameter Units.Length travel(min=0, max=10000) = 1000 "Compression at which the drawbar meets its buffer";
  parameter Units.Stiffness k_buffer = 548000 "Stiffness from there on";
  final parameter Units.Length s_1 = eps + noEvent(if F_0 > 0 then F_0/k_t else 0) "Compression at which the spring begins to give";
protected
  parameter Units.Length s_4 = noEvent(max(s_1, travel)) "Compression at which the buffer begins to give";
  parameter Units.Length s_2 = noEvent(min(max(s_1, eps + x_2), s_4)) "Compression from which the stiffness is k_2";
  parameter Units.Length s_3 = noEvent(min(max(s_2, eps + x_3), s_4)) "Compression from which the stiffness is k_3";
  parameter Units.Force F_2 = F_0 + k*(s_2 - s_1) "Force at s_2";
  parameter Units.Force F_3 = F_2 + k_2*(s_3 - s_2) "Force at s_3";
  parameter Units.Force F_4 = F_3 + k_3*(s_4 - s_3) "Force at s_4";
equation
  F = if compression < 0 then k_t*compression
    elseif compression <= eps then 0
    elseif compression <= s_1 then k_t*(compression - eps)
    elseif compression <= s_2 then F_0 + k*(compression - s_1)
    elseif compression <= s_3 then F_2 + k_2*(compression - s_2)
    elseif compression <= s_4 then F_3 + k_3*(compression - s_3)
    else F_4 + k_buffer*(compression - s_4);
  annotation(
    Icon(graphics={
      Line(points={{-80,-70},{-40,-10},{-10,-10},{30,20},{60,50},{75,80}}, color={0,127,0}, thickness=1)}),
    Documentation(info="<html>
<p>The paper's section 6: beyond the clearance <code>eps</code> the spring <code>k</code> resists compression, within the
clearance there is no force, in tension the drawbar has the stiffness <code>k_t</code>.</p>
<p>As sold, such devices have more, all of it out of reach by default:</p>
<ul>
<li>Threshold <code>F_0</code>: the spring is clamped with it. Up to that push only the frame gives, by <code>k_t</code> from
<code>eps</code> on; from <code>s_1 = eps + F_0/k_t</code> on the spring does. (A force that jumps to <code>F_0</code> would hold
the drawbar on the jump, where a simulation chatters.)</li>
<li>Further stiffnesses <code>k_2</code> from <code>eps + x_2</code> on and <code>k_3</code> from <code>eps + x_3</code> on, in this
order.</li>
<li>End of travel: from <code>travel</code> on, whatever stands above, the stiffness is <code>k_buffer</code>.</li>
</ul>
<p>Each kink is an event. Rejected: the same force as a sum of what each change of stiffness adds, which is shorter but takes
the difference of large numbers (<code>k_t</code> times a compression) where the spring alone acts; <code>Validation.DrawbarSpring</code>
has it as the closed form.</p>
</html>"));
end DrawbarSpring;
