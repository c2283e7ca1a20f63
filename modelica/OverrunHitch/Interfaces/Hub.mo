within OverrunHitch.Interfaces;
connector Hub "Hub of a wheel"
  Units.AngularVelocity omega "Angular velocity, positive rolling forward";
  flow Units.Torque tau "Torque on the part behind the hub, positive rolling forward";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={95,95,95}, fillColor={160,160,160}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>Carries the angular velocity instead of the angle: no force in the model depends on the angle of a wheel, so an angle
would only be a state that nobody reads.</p>
</html>"));
end Hub;
