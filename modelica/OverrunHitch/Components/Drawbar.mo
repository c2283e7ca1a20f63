within OverrunHitch.Components;
model Drawbar "Sliding drawbar with damper, clearance and its own stiffness in tension"
  extends Interfaces.PartialDrawbar;
  Interfaces.Flange front "Joined to the car" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
  Interfaces.Flange rear "Joined to the trailer" annotation(Placement(transformation(extent={{-110,-10},{-90,10}})));
equation
  compression = rear.s - front.s;
  v_rel = der(compression);
  front.f = F_h;
  rear.f = -F_h;
  annotation(
    Icon(graphics={
      Line(points={{-90,30},{-90,-30}}, color={0,127,0}),
      Line(points={{90,30},{90,-30}}, color={0,127,0})}),
    Documentation(info="<html>
<p>The laws of <code>PartialDrawbar</code> between two flanges.</p>
<p>The compression is preferred as a state to the position of one of the vehicles: positions grow without limit, and a
relative tolerance on them says little about their difference.</p>
</html>"));
end Drawbar;
