"""What units say: their messages, caught from fmpy's native logger instead of printed, and the errors made of them."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import fmpy
from fmpy.fmi1 import printLogMessage
from fmpy.fmi2 import (
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2OK,
)

from overrun_hitch.parameters import HitchError


class StartRefused(HitchError):
    """The unit could not start a run with these values; the message is its own."""


class StepRefused(HitchError):
    """The unit could not make a step; the message is its own."""


# fmpy's native proxy, which formats messages, knows one receiver for the whole process. So ours stays for good, tells
# runs apart by their component environment, and hands on what is not ours to fmpy's own.
caught: dict[int, list[str]] = {}


def _receive(environment: int | None, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    if environment not in caught:
        printLogMessage(environment, instance, status, category, message)
    elif status != fmi2OK:
        caught[environment].append(message.decode("utf-8", errors="replace"))


_RECEIVER = fmi2CallbackLoggerTYPE(_receive)


def listening() -> Any:
    """Callbacks for an FMU. From now on messages come to us, also after others have left a receiver that is gone, as
    fmpy.simulate_fmu does when it is given a logger."""
    callbacks = fmi2CallbackFunctions(
        logger=_RECEIVER,
        allocateMemory=fmpy.fmi2.defaultCallbacks.allocateMemory,
        freeMemory=fmpy.fmi2.defaultCallbacks.freeMemory,
    )
    try:
        from fmpy.logging import addLoggerProxy

        addLoggerProxy(ctypes.byref(callbacks))
    except (ImportError, OSError):
        pass  # fmpy ships no proxy for this platform: messages come without their values
    return callbacks


def refusal(name: str, messages: Sequence[str], error: Exception) -> str:
    """The unit's last message, or fmpy's where it has none."""
    return f"{name}: {one_line(messages[-1] if messages else error)}"


def one_line(message: object) -> str:
    """The message without line breaks."""
    return " ".join(str(message).split())
