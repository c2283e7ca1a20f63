within OverrunHitch.Components;
model DrawbarDamper "Force of a drawbar's damper, with a coefficient for each direction"
  extends Interfaces.PartialDrawbarForce;
  parameter Units.Damping C = 500 "Damper coefficient";
  parameter Real rebound(final unit="1", min=0, max=1e9) = 1 "Damper coefficient while the drawbar springs back, over C";
protected
  parameter Units.Slowness sense = noEvent(if abs(rebound - 1) > 0 then 0.01 else 0) "0: a damper with one coefficient; else so small that less than 1e-10 m/s, which is rounding, has no direction";
  parameter Units.Damping C_rebound(max=1e18) = rebound*C "Damper coefficient while the drawbar springs back";
equation
  F = if sense*v_rel < 0 then C_rebound*v_rel else C*v_rel "No event where both are the same";
  annotation(
    Icon(graphics={
      Line(points={{-80,-30},{0,0},{80,70}}, color={0,127,0}, thickness=1)}),
    Documentation(info="<html>
<p>The paper's damper is <code>C</code> times the rate of compression, in compression, clearance and tension.
<code>rebound</code> is the coefficient while the compression decreases, over <code>C</code>: the force is continuous; where the
coefficients differ, a change of direction is an event. Without, the error was 40 times as large or more at the same
tolerance.</p>
</html>"));
end DrawbarDamper;
