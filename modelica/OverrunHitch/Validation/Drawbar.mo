within OverrunHitch.Validation;
model Drawbar "Drawbar that is pushed in and pulled out: its force is the sum of its parts"
  constant Units.Stiffness k = 5000 "Stiffness in compression";
  constant Units.Stiffness k_t = 80000 "Stiffness in tension";
  constant Units.Damping C = 400 "Damper coefficient";
  constant Units.Length eps = 0.01 "Clearance";
  constant Real rebound(final unit="1") = 3 "Damper coefficient while the drawbar springs back, over C";
  constant Units.Force F_0 = 200 "Threshold";
  constant Units.Length x_2 = 0.03 "Compression beyond the clearance from which the stiffness is k_2";
  constant Units.Stiffness k_2 = 9000 "Stiffness from x_2 on";
  constant Units.Length x_3 = 0.06 "Compression beyond the clearance from which the stiffness is k_3";
  constant Units.Stiffness k_3 = 15000 "Stiffness from x_3 on";
  constant Units.Length travel = 0.09 "Compression at which the drawbar meets its buffer";
  constant Units.Stiffness k_buffer = 60000 "Stiffness from there on";
  Components.Drawbar drawbar(k=k, k_t=k_t, C=C, eps=eps, rebound=rebound, F_0=F_0, x_2=x_2, k_2=k_2, x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer) "Drawbar" annotation(Placement(transformation(extent={{-20,-20},{20,20}})));
  Components.TowBall car "Stands" annotation(Placement(transformation(extent={{40,-20},{80,20}})));
  Components.TowBall trailer(s(start=-0.02)) "Moves" annotation(Placement(transformation(extent={{-40,-20},{-80,20}})));
  Units.Length x "Compression, in closed form";
  Units.Velocity v "Its rate, in closed form";
  Units.Force F_spring "Springs and buffer, in closed form";
  output Units.Force value = drawbar.F_h "Hitch force, positive in tension";
  output Units.Force expected "Its closed form";
  output Units.Force error = value - expected "Error";
equation
  x = 0.05 - 0.07*cos(3*time);
  v = 0.21*sin(3*time);
  F_spring = k_t*noEvent(min(x, 0)) + k_t*noEvent(max(x - eps, 0)) + (k - k_t)*noEvent(max(x - eps - F_0/k_t, 0)) + (k_2 - k)*noEvent(max(x - eps - x_2, 0))
    + (k_3 - k_2)*noEvent(max(x - eps - x_3, 0)) + (k_buffer - k_3)*noEvent(max(x - travel, 0));
  car.v = 0;
  trailer.v = v;
  connect(drawbar.front, car.drawbar) annotation(Line(points={{20,0},{40,0}}, color={0,127,0}));
  connect(drawbar.rear, trailer.drawbar) annotation(Line(points={{-20,0},{-40,0}}, color={0,127,0}));
  expected = -C*noEvent(max(v, 0)) - rebound*C*noEvent(min(v, 0)) - F_spring;
  annotation(
    experiment(StartTime=0, StopTime=5, Tolerance=1e-8, Interval=0.01),
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Ellipse(extent={{-100,100},{100,-100}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
      Line(points={{-60,0},{-20,-50},{60,60}}, color={0,120,0}, thickness=2)}),
    Documentation(info="<html>
<p>Front held, rear moved by a cosine from tension through the clearance and all stiffnesses into the buffer and back: what
each change of stiffness adds, and the damper of each direction, added up.</p>
</html>"));
end Drawbar;
