within OverrunHitch.Interfaces;
connector AccelerationOutput = output Units.Acceleration "Acceleration as an output signal" annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,127}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>An acceleration, in m/s2, that the part gives.</p></html>"));
