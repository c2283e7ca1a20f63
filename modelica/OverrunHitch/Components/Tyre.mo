within OverrunHitch.Components;
model Tyre "Tyre whose force is proportional to longitudinal slip"
  parameter Units.SlipStiffness C_k = 400000 "Retarding force per unit slip";
  parameter Units.Radius R = 0.35 "Rolling radius";
  Interfaces.Flange axle "Joined to the body" annotation(Placement(transformation(extent={{-10,90},{10,110}})));
  Interfaces.Hub hub "Joined to the wheel" annotation(Placement(transformation(extent={{-10,-10},{10,10}})));
  Units.Velocity v "Speed of the axle, positive forward";
  Units.Slip slip "Longitudinal slip, positive when braking";
  Units.Force F "Tyre force, positive retarding";
equation
  v = der(axle.s);
  slip = (v - R*hub.omega)/v;
  F = C_k*slip "Paper's equations 7 and 8";
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
<p>Force proportional to the longitudinal slip <code>(v - R omega)/v</code> (the paper's equations 7 and 8): good for
slips up to about 0.1. The law divides by the speed, so it holds for forward driving only; the lag between slip and force
is left out.</p>
<p>The tyre pulls the body back with <code>F</code> and spins the wheel forward with <code>R F</code>.</p>
</html>"));
end Tyre;
