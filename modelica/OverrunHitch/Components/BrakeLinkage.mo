within OverrunHitch.Components;
model BrakeLinkage "Linkage that applies the trailer's brakes as the drawbar is pushed in"
  parameter Units.TorquePerLength r = 2.975*5480 "Brake torque per unit of drawbar compression beyond the clearance";
  parameter Units.Length eps(min=0, max=10000) = 0 "Compression at which it begins to act: clearance (backlash), and what a threshold takes";
  Interfaces.LengthInput compression "Drawbar compression" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Interfaces.TorqueOutput brake_torque "Torque that the trailer's brakes can hold, on its lumped wheels" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
equation
  brake_torque = if compression > eps then r*(compression - eps) else 0 "Paper's equation 6, with the clearance of section 6";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-90,60},{90,-60}}, lineColor={60,60,60}, fillColor={245,245,245}, fillPattern=FillPattern.Solid),
      Line(points={{-70,-40},{0,-40},{70,40}}, color={160,0,0}, thickness=1),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>Torque proportional to the compression beyond <code>eps</code> (the paper's equation 6); none below and none in tension.
In a drawbar with a threshold the linkage begins to act where the spring begins to give (<code>Drawbar.s_1</code>). It acts without delay. Whether it
acts in reverse too is told by the wheel's <code>reverse_braking</code>.</p>
</html>"));
end BrakeLinkage;
