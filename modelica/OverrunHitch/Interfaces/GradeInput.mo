within OverrunHitch.Interfaces;
connector GradeInput = input Units.Grade "Road grade as an input signal" annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={0,0,127}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>A road grade, rise over horizontal run, that the part receives.</p></html>"));
