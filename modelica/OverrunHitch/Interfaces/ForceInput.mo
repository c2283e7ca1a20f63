within OverrunHitch.Interfaces;
connector ForceInput = input Units.Force "Force as an input signal" annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={0,0,127}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>A force, in N, that the part receives.</p></html>"));
