"""Names of our own: none is one that a Modelica variable can have, and what was put into one comes out again."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_build.ir.symbols import (
    Kind,
    derivative,
    derivative_of,
    guess_name,
    holds,
    kind_of,
    numbered,
    partial_name,
    pre,
    relation_of,
    residual_names,
    shared_name,
    symbol,
)

# Modelica specification, section 2.3.1: identifiers, or any characters in quotes; then dots and subscripts
WORD, QUOTED = r"[A-Za-z_]\w{0,9}", r"'[ -&(-\[\]-~]{1,9}'"
PART = rf"(?:{WORD}|{QUOTED})(?:\[\d(?:,\d)?\])?"
NAME = re.compile(rf"{PART}(?:\.{PART})*", re.ASCII)
NAMES = st.from_regex(NAME, fullmatch=True) | st.builds(
    "{}{}".format,
    st.sampled_from([*(kind.value for kind in Kind), "'pre(x)'", "'fires{1}'", "'a,2)'"]),
    st.sampled_from(["", "[1]", "[2].x"]),
)
indices = st.integers(0, 12)


@given(NAMES)
def test_no_name_of_a_model_is_taken_for_one_of_ours(name: str) -> None:
    assert kind_of(name) is None and derivative_of(name) == (name, 0) and relation_of(symbol(name)) is None


@given(NAMES, NAMES, indices)
def test_none_of_ours_is_a_name_of_a_model(name: str, other: str, index: int) -> None:
    ours = [pre(name), guess_name(name), partial_name(name, other), shared_name(name, index), derivative(name, 2)]
    ours += [holds(index).name, *(numbered(kind, index) for kind in Kind)]
    assert not [one for one in ours if NAME.fullmatch(one)]
    assert len(set(ours)) == len(ours)


@given(NAMES, NAMES, st.integers(1, 4))
def test_a_name_made_of_names_tells_its_kind(name: str, other: str, order: int) -> None:
    assert kind_of(pre(name)) is Kind.BEFORE
    assert kind_of(guess_name(name)) is Kind.GUESS
    assert kind_of(partial_name(name, other)) is Kind.PARTIAL
    assert kind_of(derivative(name, order)) is Kind.DERIVATIVE
    assert derivative_of(derivative(name, order)) == (name, order)


@pytest.mark.parametrize("kind", Kind)
def test_a_numbered_name_tells_its_kind(kind: Kind) -> None:
    names = [numbered(kind, i, part) for i in range(12) for part in ("", "value")]
    assert len(set(names)) == len(names) and {kind_of(name) for name in names} == {kind}


@given(indices)
def test_a_truth_tells_its_relation(index: int) -> None:
    assert relation_of(holds(index)) == index and relation_of(symbol(f"holds[{index}]")) is None


@given(st.lists(NAMES, max_size=4), indices)
def test_names_of_residuals_are_free(taken: list[str], count: int) -> None:
    names = residual_names(count, [*taken, "relation[3]"])
    assert len({*names, *taken}) == count + len({*taken})
    assert residual_names(2, ["relation", "relations[1]", "a.relation[1]"]) == ["relation[1]", "relation[2]"]
