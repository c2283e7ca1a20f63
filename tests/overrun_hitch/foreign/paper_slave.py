"""The paper's equations 1 to 8 and its drawbar, written by hand as a unit of pythonfmu (FMI 2.0, co-simulation).

It shares nothing with the package: 13 parameters, V_0 and compression_start, nine outputs, Runge and Kutta's method.
SI units, which it does not declare.
"""

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

PARAMETERS = {
    "M_c": 1000.0, "M_t": 500.0, "I_c": 5.0, "I_t": 2.5, "R_c": 0.35, "R_t": 0.35, "C_kc": 400e3, "C_kt": 200e3,
    "k": 5480.0, "k_t": 548e3, "C": 500.0, "r": 16303.0, "eps": 0.0, "V_0": 40.0, "compression_start": 0.0,
}  # fmt: skip
OUTPUTS = (
    "v_car", "v_trailer", "a_car", "a_trailer", "compression", "F_hitch", "slip_car", "slip_trailer",
    "trailer_brake_torque",
)  # fmt: skip
STEP = 0.0005  # s: a fifth of the wheels' time constant
STIFFER, SIGN = 1.0, 1.0


class PaperSlave(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.brake_torque = 0.0
        self.register_variable(Real("brake_torque", causality=Fmi2Causality.input))
        for name, value in PARAMETERS.items():
            setattr(self, name, value)
            kind = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.tunable}
            self.register_variable(Real(name, **kind))
        for name in OUTPUTS:
            setattr(self, name, 0.0)
            self.register_variable(Real(name, causality=Fmi2Causality.output))

    def exit_initialization_mode(self):
        V = self.V_0
        self.state = [self.compression_start, V, V, V / self.R_c, V / self.R_t]
        self._show()

    def do_step(self, current_time, step_size):
        steps = max(1, round(step_size / STEP))
        h = step_size / steps
        for _ in range(steps):
            y = self.state
            a = self._rates(y)
            b = self._rates([u + 0.5 * h * v for u, v in zip(y, a, strict=True)])
            c = self._rates([u + 0.5 * h * v for u, v in zip(y, b, strict=True)])
            d = self._rates([u + h * v for u, v in zip(y, c, strict=True)])
            slopes = zip(y, a, b, c, d, strict=True)
            self.state = [u + h / 6.0 * (p + 2.0 * q + 2.0 * s + t) for u, p, q, s, t in slopes]
        self._show()
        return True

    def _forces(self, y):
        x, v_c, v_t, w_c, w_t = y
        pushed = max(x - self.eps, 0.0)
        push = STIFFER * (self.k * pushed + self.k_t * min(x, 0.0)) + self.C * (v_t - v_c)
        return push, self.r * pushed, (v_c - self.R_c * w_c) / v_c, (v_t - self.R_t * w_t) / v_t

    def _rates(self, y):
        push, torque, slip_c, slip_t = self._forces(y)
        tyre_c, tyre_t = self.C_kc * slip_c, self.C_kt * slip_t
        return [
            y[2] - y[1],
            (push - tyre_c) / self.M_c,
            (-push - tyre_t) / self.M_t,
            (tyre_c * self.R_c - self.brake_torque) / self.I_c,
            (tyre_t * self.R_t - torque) / self.I_t,
        ]

    def _show(self):
        push, self.trailer_brake_torque, self.slip_car, self.slip_trailer = self._forces(self.state)
        self.compression, self.v_car, self.v_trailer = self.state[:3]
        _, self.a_car, self.a_trailer = self._rates(self.state)[:3]
        self.F_hitch = SIGN * push
