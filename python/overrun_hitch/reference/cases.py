"""What the reference set shows: the paper's figures, stops, and devices that lag and rub."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from overrun_hitch.parameters import CASES, FIGURES, Scenario

LOCKING = 3500.0  # N.m: more than wheels can pass on to a road of mu = 0.6


def _case(name: str, brake_torque: float = 1000.0, **changes: float) -> Scenario:
    parameters = CASES["ii"].changed(changes)
    return Scenario(name=name, parameters=parameters, brake_torque=brake_torque, duration=6.0)


def _named(*scenarios: Scenario) -> Mapping[str, Scenario]:
    return MappingProxyType({scenario.name.replace(" ", "-"): scenario for scenario in scenarios})


# By the stem of its files.
REFERENCES = _named(
    *FIGURES.values(),
    _case("stop", V_0=10.0),
    _case("stop with clearance", V_0=10.0, eps=0.1),
    _case("stop with locked wheels", LOCKING, V_0=10.0, mu=0.6),
    _case(
        "stop with drag and rolling resistance", 500.0, V_0=8.0, CdA_c=0.7, CdA_t=1.5, C_rr=0.012, reverse_braking=0.0
    ),
    _case("lagging brake", C=1500.0, tau_b=0.03),
    _case("rubbing drawbar", C=300.0, F_f=40.0),
)
