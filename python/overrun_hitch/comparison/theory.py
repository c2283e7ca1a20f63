"""Theory against simulation, for a step brake: each quantity from both sides, what may differ, and a verdict.

Theory is linear.py and steady.py, simulation is the traces alone. Linear theory speaks of a drawbar that is in
compression all the time, so a run whose drawbar starts out of it (a clearance, a threshold) or leaves it is reported,
not judged. Nor is a run with what theory does not take exactly however large the motion: a second stiffness reached, or
a parameter that parameters.py declares small, approximate or neutral.

What may differ, and why:

- growth rate 0.005 1/s + 1 %, frequency 0.2 %: theory holds the slip denominators at V. With a slip of 0.007 and
  wheels of 4 % of the inertia the frequency comes out 0.02 % higher in simulation, the growth rate 1e-4 1/s off.
- steady acceleration and compression: equation 15 lets wheels turn as if without slip, so it is off by slip times
  the wheels' share of the inertia, vehicle by vehicle (0.03 % for the paper's); 0.01 % is added for fit and integrator.
- A / A_c: half a unit of the third digit, as the paper prints it. Slip cancels in the ratio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from overrun_hitch.comparison.motion import with_motion
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.oscillation import NoOscillation, Oscillation, fitting, measure
from overrun_hitch.measure.passages import compressed_from
from overrun_hitch.measure.sampled import integrals
from overrun_hitch.parameters import HitchError, Parameters
from overrun_hitch.results import Run, missing, scenario_of, values
from overrun_hitch.theory.linear import ShuntingMode, shunting_mode, wheel_decay_rate
from overrun_hitch.theory.steady import steady

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]

GROWTH_RATE_ALLOWED = (0.005, 0.01)  # 1/s, and relative
FREQUENCY_ALLOWED = 0.002  # relative
STEADY_ALLOWED = 1e-4  # relative, beside slip
RATIO_ALLOWED = 0.0005

NEEDED = ("v_car", "compression")
WHEELS_SETTLED = math.log(1e6)  # the wheels' transient starts at the size of the motion itself
DECAYED = math.log(100.0)  # 40 dB down the rest weighs nothing in the fit, and soon is the integrator's noise
SETTLED = math.log(1e5)  # below what is allowed for steady values


@dataclass(frozen=True)
class _Run:
    """What is needed of a run, from the moment on when start-up transients are over."""

    parameters: Parameters
    time: Floats
    v_car: Floats
    a_car: Floats
    compression: Floats
    slip: float  # the largest
    mode: ShuntingMode | None  # along v_car; None: there is none (k = r = 0)
    stays: bool  # in compression from here on
    not_linear: str  # "" or a sentence about why linear theory does not hold

    @property
    def window(self) -> slice:
        """The samples to fit: until the oscillation has decayed."""
        return slice(0, self.decay(DECAYED) + 1)

    def decay(self, measure: float) -> int:
        """How many samples pass until theory has the oscillation fall by exp(-measure)."""
        if self.mode is None:
            return len(self.time)
        exponent = integrals(self.mode.growth_rate, self.time)
        return int(np.searchsorted(-np.minimum.accumulate(exponent), measure))


def compare(run: Run | xr.Dataset, alone: Run | xr.Dataset | None) -> list[Judged]:
    """Judge a step brake; `alone` is the same one with the car alone (run.car_alone), for A_c, if there is one.

    Growth rate (1/s) and frequency (Hz) are means over the window that was fitted (NaN where no exponential fits),
    theory's of the eigenvalue at the simulated speed of the car; then the paper's A (m/s2), A / A_c (1) and D (m).
    HitchError where the run has not what is NEEDED.
    """
    absent = [name for name in NEEDED if name in missing(run)]
    if absent:
        raise HitchError(f"{run.attrs['fmu']} has no {', '.join(absent)}, which the comparison with theory needs")
    run = with_motion(run, run)
    part = _settled_part(run)
    found = fitting(_oscillation(part))
    return [*_mode_rows(part, part.window, found), *_steady_rows(part, found, run, alone)]


def shunting(run: Run | xr.Dataset) -> tuple[Oscillation | NoOscillation, str]:
    """The shunting oscillation as `compare` measures it, and "" or why linear theory does not hold meanwhile."""
    part = _settled_part(run)
    return _oscillation(part), "" if part.stays else part.not_linear


def shunting_window(run: Run | xr.Dataset) -> tuple[float, float]:
    """When (s) `shunting` begins and ends to look."""
    part = _settled_part(run)
    seen = part.time[part.window]
    return float(seen[0]), float(seen[-1])


def _oscillation(part: _Run) -> Oscillation | NoOscillation:
    return measure(part.time[part.window], part.compression[part.window])


def _settled_part(run: Run | xr.Dataset) -> _Run:
    p = scenario_of(run).parameters
    known = p.at_default("neutral")
    time, compression = values(run, "time"), values(run, "compression")
    rate = values(run, "v_trailer") - values(run, "v_car")
    entry, stays, sentence = compressed_from(time, compression, rate, p.gives_from, p.linear_until)
    try:
        start = max(entry, WHEELS_SETTLED / max(wheel_decay_rate(known, p.V_0), 1e-9))
        mode_exists = True
    except HitchError:
        start, mode_exists = entry, False
    after = slice(min(int(np.searchsorted(time, start)), len(time) - 1), None)
    v_car = values(run, "v_car")[after]
    return _Run(
        parameters=p,
        time=time[after],
        v_car=v_car,
        a_car=values(run, "a_car")[after],
        compression=compression[after],
        slip=_largest_slip(run, after),
        mode=shunting_mode(known, v_car) if mode_exists else None,
        stays=stays,
        not_linear=_no_step(run) or _beyond_theory(p) or sentence,
    )


def _largest_slip(run: Run | xr.Dataset, after: slice) -> float:
    """Of both vehicles; where it is not given, what the car's brake torque and the steady brake force make of it."""
    if not {"slip_car", "slip_trailer"} & set(missing(run)):
        return float(np.abs([values(run, "slip_car")[after], values(run, "slip_trailer")[after]]).max())
    scenario = scenario_of(run)
    p = scenario.parameters
    try:
        pushed = steady(p, scenario.brake_torque).D - p.eps
    except HitchError:
        pushed = 0.0
    return max(scenario.brake_torque / p.R_c / p.C_kc, p.r * max(pushed, 0.0) / p.R_t / p.C_kt)


def _no_step(run: Run | xr.Dataset) -> str:
    """What makes it another manoeuvre than the paper's; "" if nothing does."""
    if run.attrs.get("profile"):
        return "the brake torque is no step"
    grade = float(run.attrs.get("grade", 0.0))
    return f"grade = {grade:g}: the road is not level" if grade else ""


def _beyond_theory(p: Parameters) -> str:
    """The first parameter that is not neutral and does not hold for large motions; "" if there is none."""
    changed = p.off_default("small", "large", "approximate", "neutral")
    return f"{changed[0]} = {getattr(p, changed[0]):g} is beyond linear theory" if changed else ""


def _mode_rows(part: _Run, window: slice, found: Oscillation | NoOscillation) -> list[Judged]:
    growth = frequency = math.nan
    reason = part.not_linear
    if part.mode is None:
        reason = reason or "k = r = 0 leave no shunting mode"
    else:
        growth = _mean(part.time[window], part.mode.growth_rate[window])
        frequency = _mean(part.time[window], part.mode.frequency[window])
        if not part.mode.oscillates[window].all():
            reason = reason or "the shunting mode is overdamped"
    if isinstance(found, NoOscillation):
        reason = f"{reason}; {found.reason}" if found.misfit and reason else reason or found.reason
    measured = (found.growth_rate, found.frequency) if isinstance(found, Oscillation) else (math.nan, math.nan)
    growth_allowed = GROWTH_RATE_ALLOWED[0] + GROWTH_RATE_ALLOWED[1] * abs(growth)
    return [
        Judged("shunting growth", "1/s", growth, measured[0], growth_allowed, reason),
        Judged("shunting frequency", "Hz", frequency, measured[1], FREQUENCY_ALLOWED * frequency, reason),
    ]


def _steady_rows(
    part: _Run, found: Oscillation | NoOscillation, run: Run | xr.Dataset, alone: Run | xr.Dataset | None
) -> list[Judged]:
    p = part.parameters
    A, D, reason = _steady_values(part, found)
    try:
        theory = steady(p, scenario_of(run).brake_torque)
    except HitchError:
        unknown = "k = r = 0 leave no steady state"
        return [Judged("acceleration A", "m/s2", math.nan, A, math.nan, reason or unknown)]
    wheels_c, wheels_t = p.I_c / p.R_c**2, p.I_t / p.R_t**2
    shares = wheels_c / (p.M_c + wheels_c) + wheels_t / (p.M_t + wheels_t)
    relative = STEADY_ALLOWED + part.slip * shares
    A_c = math.nan if alone is None else _mean_acceleration(alone, part.time[0])
    ratio = A / A_c if A_c else math.nan
    if not A_c:
        reason = reason or "nothing brakes the car"
    no_ratio = reason or ("nothing is known of the car alone" if alone is None else "")
    return [
        Judged("acceleration A", "m/s2", theory.A, A, relative * abs(theory.A), reason),
        Judged("A / A_c", "1", theory.ratio, ratio, RATIO_ALLOWED, no_ratio),
        Judged("compression D", "m", theory.D, D, relative * (theory.D - p.eps), reason),
    ]


def _steady_values(part: _Run, found: Oscillation | NoOscillation) -> tuple[float, float, str]:
    """A (m/s2), D (m) and why they are not to be judged: from the settled end of the run, else from the fit."""
    reason = part.not_linear
    settled = part.decay(SETTLED)
    if part.stays and settled < len(part.time) - 1:
        tail = slice(settled, None)
        return _mean(part.time[tail], part.a_car[tail]), _mean(part.time[tail], part.compression[tail]), reason
    if part.stays and isinstance(found, Oscillation):
        return found.offset_of(part.time[part.window], part.a_car[part.window]), found.offset, reason
    reason = reason or "the run is too short to judge: it ends before the motion has settled"
    return _mean(part.time, part.a_car), _mean(part.time, part.compression), reason


def _mean_acceleration(result: Run | xr.Dataset, start: float) -> float:
    """Mean acceleration of the car (m/s2) from `start` (s) to the end, from its speed."""
    time, speed = values(result, "time"), values(result, "v_car")
    first = min(int(np.searchsorted(time, start)), len(time) - 2)
    return float((speed[-1] - speed[first]) / (time[-1] - time[first]))


def _mean(time: Floats, samples: Floats) -> float:
    if len(time) < 2:
        return float(samples[0]) if len(samples) else math.nan
    return float(integrals(samples, time)[-1] / (time[-1] - time[0]))
