within OverrunHitch.Examples;
partial model StepBrake "Car and trailer, braked by a step of torque on the car's wheels"
  parameter Units.Torque tau_c(min=0) = 1000 "Brake torque on the car's lumped wheels, from the start on";
  Systems.CarTrailer combination "Car and trailer" annotation(Placement(transformation(extent={{-40,-40},{40,40}})));
equation
  combination.brake_torque = tau_c;
  combination.grade = 0;
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Polygon(points={{-40,60},{60,0},{-40,-60},{-40,60}}, lineColor={60,60,60}, fillColor={120,160,120}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The manoeuvre that the paper's figures 6 to 11 share.</p></html>"));
end StepBrake;
