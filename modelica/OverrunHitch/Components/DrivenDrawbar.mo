within OverrunHitch.Components;
model DrivenDrawbar "Drawbar whose two ends move at given speeds, whatever the force on them"
  extends Interfaces.PartialDrawbar(compression(start=0, fixed=true));
  parameter Units.Time T_gap(min=0, max=1000) = 0 "Time over which the compression follows the gap; 0: it does not";
  Interfaces.VelocityInput v_front "Speed of the front end, positive forward" annotation(Placement(transformation(extent={{120,-20},{80,20}})));
  Interfaces.VelocityInput v_rear "Speed of the rear end, positive forward" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.LengthInput gap "Compression as whoever moves the ends knows it" annotation(Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90, origin={0,100})));
  Units.Velocity v_gap "What leads the compression to the gap";
  Units.Force F "Force on what moves the front, positive forward; on what moves the rear its negative";
  Units.Impulse impulse(start=0, fixed=true) "Impulse given to what moves the front";
  Units.Energy work(start=0, fixed=true) "Work done on what moves the ends";
protected
  parameter Units.Time T_least = noEvent(max(T_gap, 1e-3)) "A shorter time counts as this one";
equation
  v_rel = v_rear - v_front;
  v_gap = noEvent(if T_gap > 0 then (gap - compression)/T_least else 0);
  der(compression) = v_rel + v_gap;
  F = -F_h;
  der(impulse) = F;
  der(work) = -F*v_rel;
  annotation(
    Icon(graphics={
      Line(points={{-90,30},{-90,-30}}, color={0,0,127}),
      Line(points={{90,30},{90,-30}}, color={0,0,127})}),
    Documentation(info="<html>
<p>The laws of <code>PartialDrawbar</code> between two bodies that somebody else moves. Only their speeds are given: positions held
over a step of co-simulation would be a false deflection of speed times step, and grow without limit. Impulse and work are
integrated, so that what a step has transmitted is known exactly.</p>
<p>An integral drifts: where the gap between the bodies is known, the compression follows it, slowly, with <code>T_gap</code>. The
damper sees nothing of that: <code>v_rel</code> is the difference of the speeds.</p>
</html>"));
end DrivenDrawbar;
