within OverrunHitch.Validation;
model BrakeLinkage "Linkage whose drawbar is pushed in and pulled out: torque beyond the clearance alone"
  constant Units.TorquePerLength r = 16000 "Brake torque per unit of drawbar compression beyond the clearance";
  constant Units.Length eps = 0.01 "Clearance";
  Components.BrakeLinkage linkage(r=r, eps=eps) "Linkage" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length x "Compression, in closed form";
  output Units.Torque value = linkage.brake_torque "Brake torque";
  output Units.Torque expected "Its closed form";
  output Units.Torque error = value - expected "Error";
equation
  x = 0.04 - 0.06*cos(3*time);
  linkage.compression = x;
  expected = r*noEvent(max(x - eps, 0));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The compression is moved by a cosine from tension through the clearance and back.</p>
</html>"));
end BrakeLinkage;
