within OverrunHitch;
package Interfaces "Connectors"
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Rectangle(extent={{-40,40},{40,-40}}, lineColor={0,127,0}, fillColor={0,127,0}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>What parts are joined by: a translational flange, a wheel hub, and signals.</p></html>"));
end Interfaces;
