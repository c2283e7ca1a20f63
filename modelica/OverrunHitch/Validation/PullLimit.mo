within OverrunHitch.Validation;
model PullLimit "Force that pulls and pushes while a drawbar moves: clipped where its contact cannot take it"
  constant Units.Force F_pull_max = 100 "Largest force of the damper against the contact";
  constant Units.Length eps = 0.03 "Clearance";
  constant Units.Force beyond = 1e9 "No limit";
  Components.PullLimit limit(F_pull_max=F_pull_max, eps=eps) "Limit" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length x "Compression, in closed form";
  Units.Force F "Force without limit, in closed form";
  output Units.Force value = limit.F "Force within the limit";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  x = 0.04 - 0.06*cos(3*time);
  F = 300*sin(7*time);
  limit.compression = x;
  limit.v_rel = 0;
  limit.F_free = F;
  expected = noEvent(max(if x >= 0 then -F_pull_max else -beyond, min(if x <= eps then F_pull_max else beyond, F)));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>Compression and force are moved by a cosine and a sine of other frequency, so that they meet in every combination of signs.</p>
</html>"));
end PullLimit;
