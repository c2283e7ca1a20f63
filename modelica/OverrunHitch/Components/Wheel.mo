within OverrunHitch.Components;
model Wheel "Spin of a braked wheel"
  parameter Units.MomentOfInertia I = 5 "Polar moment of inertia (all wheels of the vehicle lumped)";
  Interfaces.Hub hub "Joined to the tyre" annotation(Placement(transformation(extent={{-10,-110},{10,-90}})));
  Interfaces.TorqueInput brake_torque "Brake torque, positive when it slows a wheel that rolls forward" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Units.AngularVelocity omega(start=114, fixed=true) "Angular velocity, positive rolling forward";
equation
  hub.omega = omega;
  I*der(omega) = hub.tau - brake_torque "Paper's equations 3 and 4";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-70,70},{70,-70}}, lineColor={60,60,60}, fillColor={90,90,90}, fillPattern=FillPattern.Solid),
      Ellipse(extent={{-40,40},{40,-40}}, lineColor={60,60,60}, fillColor={230,230,230}, fillPattern=FillPattern.Solid),
      Text(extent={{-100,110},{100,75}}, textColor={0,0,255}, textString="%name"),
      Text(extent={{-40,15},{40,-15}}, textColor={60,60,60}, textString="I=%I")}),
    Documentation(info="<html>
<p>Euler's equation of the wheel's spin (the paper's equations 3 and 4). The brake torque is a signal that always acts
against forward rolling: it is the paper's linear brake, not a friction brake, and would drive a stopped wheel
backwards.</p>
</html>"));
end Wheel;
