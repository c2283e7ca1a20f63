within OverrunHitch.Interfaces;
connector LengthInput = input Units.Length "Length as an input signal" annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={0,0,127}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>A length, in m, that the part receives.</p></html>"));
