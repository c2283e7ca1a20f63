within OverrunHitch.Validation;
model DrawbarSpring "Springs that are compressed and stretched: their force is the sum of what each change of stiffness adds"
  constant Units.Stiffness k = 5000 "Stiffness in compression";
  constant Units.Stiffness k_t = 80000 "Stiffness in tension";
  constant Units.Length eps = 0.01 "Clearance";
  constant Units.Force F_0 = 200 "Threshold";
  constant Units.Length x_2 = 0.03 "Compression beyond the clearance from which the stiffness is k_2";
  constant Units.Stiffness k_2 = 9000 "Stiffness from x_2 on";
  constant Units.Length x_3 = 0.06 "Compression beyond the clearance from which the stiffness is k_3";
  constant Units.Stiffness k_3 = 15000 "Stiffness from x_3 on";
  constant Units.Length travel = 0.09 "Compression at which the drawbar meets its buffer";
  constant Units.Stiffness k_buffer = 60000 "Stiffness from there on";
  Components.DrawbarSpring spring(k=k, k_t=k_t, eps=eps, F_0=F_0, x_2=x_2, k_2=k_2, x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer) "Springs" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Units.Length x "Compression, in closed form";
  output Units.Force value = spring.F "Force of springs and buffer";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  x = 0.05 - 0.07*cos(3*time);
  spring.compression = x;
  spring.v_rel = 0;
  expected = k_t*noEvent(min(x, 0)) + k_t*noEvent(max(x - eps, 0)) + (k - k_t)*noEvent(max(x - eps - F_0/k_t, 0)) + (k_2 - k)*noEvent(max(x - eps - x_2, 0))
    + (k_3 - k_2)*noEvent(max(x - eps - x_3, 0)) + (k_buffer - k_3)*noEvent(max(x - travel, 0));
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>The compression is moved by a cosine from tension through the clearance and all stiffnesses into the buffer and back.</p>
</html>"));
end DrawbarSpring;
