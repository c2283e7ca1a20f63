"""Sustained oscillations of a drawbar with clearance, estimated by the describing function.

A harmonic delta = B + a sin(omega t) is put through the drawbar's piecewise laws; of what comes out the mean and the
fundamental are kept (dual-input describing function: A. Gelb and W. E. Vander Velde, Multiple-Input Describing
Functions and Nonlinear System Design, McGraw-Hill 1968, chapter 6). The fundamental makes k and r smaller, because they
act over a part of the cycle alone, and adds a share of k_t; with these the linear module tells growth and frequency. A
cycle is where the growth rate is zero, and stable where growth falls with amplitude. An estimate: harmonics are
neglected, which is good for cycles that barely enter the clearance and poor for those that strike the tension stop.

At held speed: the weight on a downhill grade does what the deceleration does otherwise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from overrun_hitch.parameters import Parameters
from overrun_hitch.theory.linear import ShuntingMode, shunting_mode
from overrun_hitch.theory.working_point import check_one_piece

AMPLITUDES = np.geomspace(1e-2, 1e2, 120)  # where cycles are looked for, relative to the steady compression beyond eps


@dataclass(frozen=True)
class Cycle:
    """A sustained oscillation of the drawbar compression."""

    amplitude: float  # m, of the fundamental
    frequency: float  # Hz
    mean: float  # m
    is_stable: bool  # False: motions move away from it, to both sides


def ramp_gain(bias: float, amplitude: float) -> tuple[float, float]:
    """Mean of max(0, bias + amplitude sin) and its fundamental over amplitude (1)."""
    share = min(1.0, max(-1.0, bias / amplitude))
    angle = math.asin(share)
    conducting = 0.5 * math.pi + angle
    return (
        (bias * conducting + amplitude * math.cos(angle)) / math.pi,
        (conducting + share * math.cos(angle)) / math.pi,
    )


def predicted_cycles(parameters: Parameters, V: float, push: float) -> list[Cycle]:
    """All cycles at V (m/s) where the trailer pushes with `push` (N): its weight along the road. Smallest first.

    HitchError, naming it, for a parameter that is not among these laws (threshold, other stiffnesses, limits).
    """
    check_one_piece(parameters, "the describing function")
    steady = push / (parameters.k + parameters.r / parameters.R_t)

    def growth(amplitude: float) -> float:
        return float(_mode(parameters, V, push, amplitude).growth_rate)

    cycles = []
    for smaller, larger in pairwise((AMPLITUDES * steady).tolist()):
        before, behind = growth(smaller), growth(larger)
        if before * behind < 0.0:
            amplitude = float(brentq(growth, smaller, larger, xtol=1e-9 * steady))
            frequency = float(_mode(parameters, V, push, amplitude).frequency)
            cycles.append(Cycle(amplitude, frequency, _bias(parameters, push, amplitude), before > 0.0))
    return cycles


def _mode(parameters: Parameters, V: float, push: float, amplitude: float) -> ShuntingMode:
    """The shunting mode with the gains that hold for a cycle of this amplitude."""
    p = parameters
    bias = _bias(p, push, amplitude)
    _, compression = ramp_gain(bias - p.eps, amplitude)
    _, tension = ramp_gain(-bias, amplitude)
    return shunting_mode(p.changed({"k": p.k * compression + p.k_t * tension, "r": p.r * compression}), V)


def _bias(parameters: Parameters, push: float, amplitude: float) -> float:
    """Mean compression (m) at which spring, tension stop and trailer brake carry the push on average."""
    p = parameters

    def excess(bias: float) -> float:
        compression, _ = ramp_gain(bias - p.eps, amplitude)
        tension, _ = ramp_gain(-bias, amplitude)
        return (p.k + p.r / p.R_t) * compression - p.k_t * tension - push

    reach = p.eps + push / (p.k + p.r / p.R_t) + amplitude
    return float(brentq(excess, -reach, reach, xtol=1e-12 * reach))
