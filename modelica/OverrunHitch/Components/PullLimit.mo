within OverrunHitch.Components;
model PullLimit "Limit of what a drawbar may pull while it is pushed in, and push while it is not"
  extends Interfaces.PartialDrawbarForce;
  parameter Units.Force F_pull_max(min=0, max=1e12) = 1e9 "Largest force of the damper against the contact: 0 for a spring that never pulls";
  parameter Units.Length eps(min=0, max=10000) = 0 "Clearance (backlash)";
  Interfaces.ForceInput F_free "Force of springs and damper, without limit" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
equation
  F = if compression >= 0 and F_free < -F_pull_max then -F_pull_max
    elseif compression <= eps and F_free > F_pull_max then F_pull_max
    else F_free "Pull limited unless the stop is reached, push unless the spring is";
  annotation(
    Icon(graphics={
      Line(points={{-80,-40},{-20,-40},{0,0},{60,70}}, color={0,127,0}, thickness=1)}),
    Documentation(info="<html>
<p>An always acting damper pulls while the drawbar springs back fast from compression; the paper's does. The limit
<code>F_pull_max</code> is for drawbars whose damper sits in the contact: the hitch force does not pull beyond it unless the
drawbar is at its stop in tension, and does not push beyond it unless the spring is compressed. With 0 the contact in
compression only pushes, the stop only pulls, and within the clearance there is no force; the force then jumps where a
moving contact closes. The default is beyond any damper, so the paper's always acts.</p>
</html>"));
end PullLimit;
