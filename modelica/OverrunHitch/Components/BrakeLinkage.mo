within OverrunHitch.Components;
model BrakeLinkage "Linkage that applies the trailer's brakes as the drawbar is pushed in"
  parameter Units.TorquePerLength r = 2.975*5480 "Brake torque per unit of drawbar compression beyond the clearance";
  parameter Units.Length eps(min=0, max=10000) = 0 "Compression at which it begins to act: clearance (backlash), and what a threshold takes";
  parameter Units.Time tau_b(min=0, max=1000) = 0 "Lag of the torque behind the compression; 0: none";
  Interfaces.LengthInput compression "Drawbar compression" annotation(Placement(transformation(extent={{-120,-20},{-80,20}})));
  Units.Velocity v_rel "Its rate";
  Interfaces.TorqueOutput brake_torque "Torque that the trailer's brakes can hold, on its lumped wheels" annotation(Placement(transformation(extent={{90,-10},{110,10}})));
  Units.Torque T "Torque that the compression asks for";
  Units.Torque T_missing(start=0, fixed=true, nominal=100) "What the brakes lag behind it: rises with it, decays with tau_b";
protected
  parameter Real lag(final unit="1") = noEvent(if tau_b > 0 then 1 else 0) "0: the torque is what is asked for";
  parameter Units.Time decay = noEvent(if tau_b > 0 then max(tau_b, 1e-6) else 1) "Time constant; a microsecond at least: less is too stiff for double precision";
equation
  v_rel = der(compression);
  T = if compression > eps then r*(compression - eps) else 0 "Paper's equation 6, with the clearance of section 6";
  der(T_missing) = lag*((if compression > eps then r*v_rel else 0) - T_missing/decay);
  brake_torque = T - lag*T_missing "tau_b*der(brake_torque) = T - brake_torque";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Rectangle(extent={{-90,60},{90,-60}}, lineColor={60,60,60}, fillColor={245,245,245}, fillPattern=FillPattern.Solid),
      Line(points={{-70,-40},{0,-40},{70,40}}, color={160,0,0}, thickness=1),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>Torque proportional to the compression beyond <code>eps</code> (the paper's equation 6); none below and none in tension.
In a drawbar with a threshold the linkage begins to act where the spring begins to give (<code>Drawbar.s_1</code>). Whether it
acts in reverse too is told by the wheel's <code>reverse_braking</code>.</p>
<p>Linkage and brakes follow with a lag of the first order, <code>tau_b</code>, as they apply and as they release; the paper's
follow at once. The state is what is missing, not the torque: so it is exactly 0 in a run without lag, and a lag that is
set during a run begins without a jump. At the start the brakes have followed.</p>
</html>"));
end BrakeLinkage;
