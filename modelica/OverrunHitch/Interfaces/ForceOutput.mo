within OverrunHitch.Interfaces;
connector ForceOutput = output Units.Force "Force as an output signal" annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>A force, in N, that the part computes.</p></html>"));
