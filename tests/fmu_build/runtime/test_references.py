"""Who asks for a variable that is not there, or not of that type, learns which: every function of both standards."""

from __future__ import annotations

import ctypes as ct
import re
from collections.abc import Callable, Iterator

import pytest

from fmu_build.fmu.compile import HEADERS
from tests.fmu_build.runtime.runtime_fmi3 import Unit3
from tests.fmu_build.runtime.runtime_models import OSCILLATOR
from tests.fmu_build.runtime.runtime_unit import ERROR, OK, Unit

UNKNOWN = 4_000_000_001
NEVER_LEGAL = {"ActivateModelPartition"}
Arguments = list[tuple[str, str]]


def functions(fmi: int) -> dict[str, Arguments]:
    """Type and name of each argument but the instance, of all functions that take value references."""
    text = (HEADERS / f"fmi{fmi}" / f"fmi{fmi}FunctionTypes.h").read_text(encoding="utf-8")
    types = re.findall(rf"typedef\s+fmi{fmi}Status\s+fmi{fmi}(\w+)TYPE\s*\(([^)]*)\)", text)
    found = {name: re.findall(r"(\w+\s*\*?)\s*(\w+(?:\[\])?)\s*(?:,|$)", rest)[1:] for name, rest in types}
    with_references = {name for name, rest in found.items() if any("ValueReference" in kind for kind, _ in rest)}
    return {name: found[name] for name in sorted(with_references - NEVER_LEGAL)}


def argument(kind: str, name: str, reference: int) -> object:
    """One element of each array; orders of derivatives are 1."""
    if "ValueReference" in kind:
        return (ct.c_uint * 1)(reference) if name.endswith("[]") else ct.c_uint(reference)
    if name.endswith("[]") or kind.endswith("*"):
        return (ct.c_int * 16)(1) if name.startswith("order") else (ct.c_int64 * 8)()
    return ct.c_size_t(1)


def said(fmi: int, create: Callable[..., Unit | Unit3], function: str, of: Arguments, name: int | str) -> Iterator[str]:
    """What the function says, wherever it is legal, of a variable by reference or name."""
    prefix = "fmi2" if fmi == 2 else ""
    for exchange in (False, True):
        u = create(OSCILLATOR, exchange=exchange)
        reference = name if isinstance(name, int) else u.references[name]
        for enter in ("EnterInitializationMode", "ExitInitializationMode"):
            given = (False, ct.c_double(), ct.c_double(), False, ct.c_double()) if fmi == 3 and "Enter" in enter else ()
            assert u.call(prefix + enter, *given) == OK
            assert u.call(prefix + function, *[argument(*each, reference) for each in of]) == ERROR
            if not re.search("must not be called now|is not for", u.messages()[-1]):
                yield u.messages()[-1]


@pytest.mark.parametrize(("fmi", "function"), [(fmi, function) for fmi in (2, 3) for function in functions(fmi)])
def test_what_is_unknown_is_named(
    unit: Callable[..., Unit], unit3: Callable[..., Unit3], fmi: int, function: str
) -> None:
    create, of = (unit if fmi == 2 else unit3), functions(fmi)[function]
    messages = list(said(fmi, create, function, of, UNKNOWN))
    assert messages and all(str(UNKNOWN) in message for message in messages), messages
    kind = re.fullmatch("[GS]et(?!Float64|Real|Directional|Adjoint|Output|Number|Variable)(.*)", function)
    if kind is not None:
        messages = list(said(fmi, create, function, of, "gap"))
        assert messages and all(message.startswith("gap is a Real, not a") for message in messages), messages


def test_all_functions_are_looked_at() -> None:
    assert [len(functions(fmi)) for fmi in (2, 3)] == [11, 41]
