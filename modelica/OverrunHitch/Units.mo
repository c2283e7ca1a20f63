within OverrunHitch;
package Units "Physical quantities with their units and admissible ranges"
  type Mass = Real(final quantity="Mass", final unit="kg", min=1, max=1e9) "Mass";
  type MomentOfInertia = Real(final quantity="MomentOfInertia", final unit="kg.m2", min=1e-3, max=1e12) "Polar moment of inertia";
  type Density = Real(final quantity="Density", final unit="kg/m3") "Density";
  type Area = Real(final quantity="Area", final unit="m2", min=0, max=1e9) "Area";
  type Radius = Real(final quantity="Length", final unit="m", min=0.01, max=1000) "Radius";
  type Position = Real(final quantity="Length", final unit="m", nominal=1) "Position along the road";
  type Length = Real(final quantity="Length", final unit="m") "Length";
  type Velocity = Real(final quantity="Velocity", final unit="m/s", displayUnit="km/h", nominal=1) "Velocity";
  type Acceleration = Real(final quantity="Acceleration", final unit="m/s2") "Acceleration";
  constant Acceleration g_n = 9.80665 "Standard acceleration of free fall";
  constant Density rho_air = 1.225 "Density of air at sea level: ISO 2533 (ICAO standard atmosphere)";
  type Angle = Real(final quantity="Angle", final unit="rad", displayUnit="deg") "Angle";
  type Time = Real(final quantity="Time", final unit="s") "Time";
  type Slowness = Real(final quantity="Slowness", final unit="s/m") "Inverse of a velocity";
  type Deflection = Real(final quantity="Length", final unit="m", nominal=0.01) "Deflection of a tyre";
  type AngularVelocity = Real(final quantity="AngularVelocity", final unit="rad/s", nominal=3) "Angular velocity";
  type Force = Real(final quantity="Force", final unit="N") "Force";
  type Torque = Real(final quantity="Torque", final unit="N.m") "Torque";
  type Impulse = Real(final quantity="Impulse", final unit="N.s", nominal=100) "Impulse";
  type AngularImpulse = Real(final quantity="AngularImpulse", final unit="N.m.s", nominal=100) "Angular impulse";
  type Energy = Real(final quantity="Energy", final unit="J", nominal=1000) "Energy";
  type Stiffness = Real(final quantity="TranslationalSpringConstant", final unit="N/m", min=0, max=1e9) "Stiffness";
  type Damping = Real(final quantity="TranslationalDampingConstant", final unit="N.s/m", min=0, max=1e9) "Damper coefficient";
  type SlipStiffness = Real(final quantity="Force", final unit="N", min=1, max=1e9) "Tyre force per unit slip";
  type TorquePerLength = Real(final quantity="TorquePerLength", final unit="N.m/m", min=0, max=1e9) "Torque per unit length";
  type Friction = Real(final quantity="CoefficientOfFriction", final unit="1", min=0.01, max=1e12) "Coefficient of friction";
  type RollingResistance = Real(final quantity="RollingResistanceCoefficient", final unit="1", min=0, max=1e9) "Rolling resistance over load";
  type Grade = Real(final quantity="Grade", final unit="1") "Rise of the road over its horizontal run";
  type Share = Real(final quantity="Share", final unit="1", min=0, max=1) "Share";
  type Slip = Real(final quantity="Slip", final unit="1") "Longitudinal slip";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={248,248,248}, fillPattern=FillPattern.Solid, radius=10),
      Text(extent={{-80,60},{80,-60}}, textColor={0,60,120}, textString="SI")}),
    Documentation(info="<html>
<p>SI units throughout. The minima of masses, inertias, radii and tyre stiffnesses stand for &quot;greater than zero&quot;:
they keep a slip of the pen (a zero, a mass in tonnes) from passing as a model. The maxima are far beyond any vehicle:
from there on double precision would lose what forces follow from, a slip or a compression, and results would be wrong
without a word.</p>
<p>A simulator's absolute tolerance follows the nominal values: 1 m, 1 m/s, and 3 rad/s because a wheel of a third of a
metre then weighs an error of slip as it weighs one of speed.</p>
</html>"));
end Units;
