within OverrunHitch.Interfaces;
partial model PartialDrawbar "Laws of a sliding drawbar, whatever tells how it moves"
  parameter Units.Stiffness k = 5480 "Stiffness in compression";
  parameter Units.Stiffness k_t = 548000 "Stiffness in tension";
  parameter Units.Damping C = 500 "Damper coefficient";
  parameter Units.Length eps(min=0, max=10000) = 0 "Clearance (backlash)";
  parameter Units.Force F_pull_max(min=0, max=1e12) = 1e9 "Largest force of the damper against the contact: 0 for a spring that never pulls";
  parameter Real rebound(final unit="1", min=0, max=1e9) = 1 "Damper coefficient while the drawbar springs back, over C";
  parameter Units.Force F_f(min=0, max=1e6) = 0 "Dry friction of the guide";
  parameter Units.Force F_0(min=0, max=1e12) = 0 "Threshold: push up to which the spring, clamped, does not give";
  parameter Units.Length x_2(min=0, max=10000) = 1000 "Compression beyond the clearance from which the stiffness is k_2";
  parameter Units.Stiffness k_2 = 5480 "Stiffness from x_2 on";
  parameter Units.Length x_3(min=0, max=10000) = 1000 "Compression beyond the clearance from which the stiffness is k_3";
  parameter Units.Stiffness k_3 = 5480 "Stiffness from x_3 on";
  parameter Units.Length travel(min=0, max=10000) = 1000 "Compression at which the drawbar meets its buffer";
  parameter Units.Stiffness k_buffer = 548000 "Stiffness from there on";
  final parameter Units.Length s_1 = spring.s_1 "Compression at which the spring begins to give";
  LengthOutput compression(stateSelect=StateSelect.prefer, nominal=0.1) "Drawbar compression" annotation(Placement(transformation(extent={{-10,-110},{10,-90}}, rotation=-90)));
  Units.Velocity v_rel "Rate of compression";
  Units.Force F_spring "Force of springs and buffer, positive in compression";
  Units.Force F_damper "Force of the damper, positive while pushed in";
  Units.Force F_friction "Friction of the guide, positive while pushed in";
  Units.Force F_h "Hitch force, positive in tension";
protected
  Components.DrawbarSpring spring(k=k, k_t=k_t, eps=eps, F_0=F_0, x_2=x_2, k_2=k_2, x_3=x_3, k_3=k_3, travel=travel, k_buffer=k_buffer) "Springs and buffer" annotation(Placement(transformation(extent={{-40,20},{0,60}})));
  Components.DrawbarDamper damper(C=C, rebound=rebound) "Damper" annotation(Placement(transformation(extent={{-40,-60},{0,-20}})));
  Components.DrawbarFriction friction(F_f=F_f, final x_f=1e-4, final T_f=0.02) "Guide" annotation(Placement(transformation(extent={{30,-80},{70,-40}})));
  Components.PullLimit limit(F_pull_max=F_pull_max, eps=eps) "Pull limit" annotation(Placement(transformation(extent={{30,-20},{70,20}})));
equation
  spring.compression = compression;
  spring.v_rel = v_rel;
  F_spring = spring.F;
  damper.compression = compression;
  damper.v_rel = v_rel;
  F_damper = damper.F;
  friction.compression = compression;
  friction.v_rel = v_rel;
  F_friction = friction.F;
  limit.compression = compression;
  limit.v_rel = v_rel;
  limit.F_free = F_damper + F_spring;
  F_h = -(limit.F + F_friction) "Paper's equation 5, in its three regimes of section 6, and friction, which no contact limits";
  annotation(
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
      Line(points={{-90,30},{-50,30},{-40,50},{-20,10},{0,50},{20,10},{40,50},{50,30},{90,30}}, color={0,127,0}),
      Line(points={{-90,-30},{-20,-30}}, color={0,127,0}),
      Rectangle(extent={{-20,-10},{30,-50}}, lineColor={0,127,0}, fillColor={220,240,220}, fillPattern=FillPattern.Solid),
      Line(points={{30,-30},{90,-30}}, color={0,127,0}),
      Text(extent={{-100,100},{100,65}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>Spring and damper act side by side, and the pull limit on their sum; the friction of the guide acts whatever they do. Each is
a law of its own: <code>DrawbarSpring</code>, <code>DrawbarDamper</code>, <code>PullLimit</code>, <code>DrawbarFriction</code>. What is
missing is how <code>compression</code> and <code>v_rel</code> follow from the motion.</p>
</html>"));
end PartialDrawbar;
