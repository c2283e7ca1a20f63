"""The shunting mode fitted to small free vibrations of the FMU, against linear theory."""

from __future__ import annotations

from pathlib import Path

import pytest

from overrun_hitch.experiments.free_vibration import measured_mode, measured_vibration
from overrun_hitch.fmu.opening import opened_unit
from overrun_hitch.parameters import CASES, DATUM, HitchError
from overrun_hitch.theory.linear import rebound_error, shunting_mode
from tests.sampling import sampled, spread


@pytest.mark.parametrize("case", sampled(CASES, ["i", "ii", "iii"]))
def test_it_is_the_eigenvalue(case: str, car_trailer_fmu: Path) -> None:
    """At a slip s of 0.0007 the tyre's slopes are smaller by s than theory's: 1e-4 1/s in growth, s in the ratio."""
    worst = [0.0] * 4
    with opened_unit(car_trailer_fmu) as unit:
        for V in (10.0, 20.0, 40.0):
            for C in (0.0, 50.0, 400.0, 3200.0):
                parameters = CASES[case].changed({"C": C})
                found, theory = measured_mode(unit, parameters, V), shunting_mode(parameters, V)
                distances = (
                    abs(found.growth_rate - float(theory.growth_rate)),
                    abs(found.frequency / float(theory.frequency) - 1.0),
                    abs(found.amplitude_ratio / float(theory.amplitude_ratio) - 1.0),
                    abs(found.phase - float(theory.phase)),
                )
                worst = [max(pair) for pair in zip(worst, distances, strict=True)]
                assert found.residual < 1e-5
    print(
        f"case {case}: growth {worst[0]:.1e} 1/s, frequency {worst[1]:.1e}, ratio {worst[2]:.1e}, phase {worst[3]:.1e}"
    )
    assert worst[0] < 2e-4 and worst[1] < 5e-5 and worst[2] < 7e-4 and worst[3] < 0.05


def test_clearance_only_shifts_it(car_trailer_fmu: Path) -> None:
    """About steady braking the drawbar is past its clearance, however wide."""
    parameters = CASES["ii"].changed({"C": 200.0})
    with opened_unit(car_trailer_fmu) as unit:
        without = measured_mode(unit, parameters, 20.0)
        wide = measured_mode(unit, parameters.changed({"eps": 0.1}), 20.0)
    assert wide.eigenvalue == pytest.approx(without.eigenvalue, rel=1e-6)


# Where rebound is 1, the vibration is an exponential: above.
@pytest.mark.parametrize(("C", "rebound"), spread([100.0, 200.0, 830.0, 1600.0], [0.0, 0.5, 3.0, 5.0]))
def test_a_damper_of_two_rates_is_nearly_one_of_their_mean(car_trailer_fmu: Path, C: float, rebound: float) -> None:
    """What theory neglects is what it says, and the FMU always decays a little faster."""
    p = DATUM.changed({"C": 2.0 * C / (1.0 + rebound), "rebound": rebound})
    with opened_unit(car_trailer_fmu) as unit:
        found = measured_vibration(unit, p, 20.0).eigenvalue
    theory, error = complex(shunting_mode(p, 20.0).eigenvalue), rebound_error(p, 20.0)
    ratios = [-value.real / abs(value) for value in (found, theory)]
    off = ratios[0] / ratios[1] - 1.0
    print(f"C {C:g}, rebound {rebound:g}: damping ratio {ratios[1]:.4f} off by {off:.1e}, at most {error:.1e}")
    assert -2e-4 < off < error + 3e-4
    assert -2e-4 < (theory.real - found.real) < error * abs(theory.real) + 2e-4
    assert found.imag == pytest.approx(theory.imag, rel=0.002 + 2.0 * error)


def test_no_mode_where_no_exponential_fits(car_trailer_fmu: Path) -> None:
    with opened_unit(car_trailer_fmu) as unit, pytest.raises(HitchError, match="no exponential fits the oscillation"):
        measured_mode(unit, DATUM.changed({"C": 400.0, "rebound": 3.0}), 20.0)


def test_where_there_is_nothing_to_measure(car_trailer_fmu: Path) -> None:
    with opened_unit(car_trailer_fmu) as unit:
        with pytest.raises(HitchError, match="does not oscillate"):
            measured_mode(unit, DATUM.changed({"C": 20000.0}), 20.0)
        with pytest.raises(HitchError, match="no shunting mode"):
            measured_mode(unit, DATUM.changed({"k": 0.0, "r": 0.0}), 20.0)
