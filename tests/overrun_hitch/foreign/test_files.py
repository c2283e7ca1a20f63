"""Other people's files and names: CSV of any kind, MAT files that are none, units, a mapping proposed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.io import savemat

from overrun_hitch import cli
from overrun_hitch.comparison.proposal import proposal
from overrun_hitch.foreign.mapping import OURS, read_mapping
from overrun_hitch.foreign.trace_file import read_table
from overrun_hitch.foreign.units import factor
from overrun_hitch.parameters import HitchError
from tests.overrun_hitch.experiments.test_step_brake import rewritten

SEPARATORS = st.sampled_from([",", ";", "\t", "|", " "])
NUMBERS = st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=5)


@given(NUMBERS, SEPARATORS, st.booleans(), st.booleans(), st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]))
def test_a_table_is_the_same_in_any_form(
    tmp_path_factory: pytest.TempPathFactory,
    numbers: list[float],
    separator: str,
    comma: bool,
    units_below: bool,
    encoding: str,
) -> None:
    """Names with a letter that is not ASCII; units behind them or on a line of their own."""
    names, units = ("t", "Größe", "k"), ("s", "km/h", "N/m")
    head = [names, units] if units_below else [[f"{n}[{u}]" for n, u in zip(names, units, strict=True)]]
    rows = [[f"{i}", f"{value!r}", f"{value:.3e}"] for i, value in enumerate(numbers)]
    if comma and separator != ",":
        rows = [[cell.replace(".", ",") for cell in row] for row in rows]
    path = tmp_path_factory.mktemp("csv") / "a.csv"
    path.write_text("".join(separator.join(line) + "\r\n" for line in [*head, *rows]), encoding=encoding, newline="")
    table = read_table(path)
    for name, unit in zip(names, units, strict=True):
        assert table.column(name)[1] == unit
    np.testing.assert_array_equal(table.column("Größe")[0], numbers)
    np.testing.assert_allclose(table.column("k")[0], numbers, rtol=1e-3)


@pytest.mark.parametrize("separator", [",", ";", "\t", "|", " "])
def test_numbers_without_a_name_never_move_the_others(separator: str, tmp_path: Path) -> None:
    """A number too many on all lines made the first column none, and the others' names one too far to the left."""
    path = tmp_path / "a.csv"
    path.write_text("\n".join(map(separator.join, (("time", "torque"), ("0", "1", "5"), ("1", "2", "6")))))
    with pytest.raises(HitchError, match=r"allowed: one for each|is no table"):
        read_table(path)


@pytest.mark.parametrize("separator", [", ", " ; ", " \t", " | "])
def test_separators_at_the_ends_and_spaces_around_names_are_nothing(separator: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(
        f" time {separator}torque \n0{separator}1{separator.strip(' ')}\n1{separator}2{separator.strip(' ')}\n"
    )
    table = read_table(path)
    assert [table.column(name)[0].tolist() for name in ("time", "torque")] == [[0.0, 1.0], [1.0, 2.0]]


@pytest.mark.parametrize(
    ("unit", "ours", "expected"),
    [
        ("km/h", "m/s", 1 / 3.6), ("kN.m", "N.m", 1e3), ("kNm", "N.m", 1e3), ("mm", "m", 1e-3), ("kgf", "N", 9.80665),
        ("m/s2", "m/s2", 1.0), ("m/s^2", "m/s2", 1.0), ("g0", "m/s2", 9.80665), ("m.s-2", "m/s2", 1.0),
        ("kg*m**1*s**-2", "N", 1.0), ("%", "1", 0.01), ("1", "1", 1.0), ("ms", "s", 1e-3), ("N/mm", "N/m", 1e3),
        ("kg.m2", "kg.m2", 1.0), ("lbf", "N", 4.4482216152605),
    ],
)  # fmt: skip
def test_units_as_people_write_them(unit: str, ours: str, expected: float) -> None:
    assert factor("x", unit, ours) == pytest.approx(expected, rel=1e-12)


@given(st.text(max_size=20) | st.text("9*^()N. m-e", max_size=40))
@example("9**9**9")
@example("N^9^9^9")
@example("((9**99)*1)**99")
@example("N**(9**9**9)")
def test_what_is_no_unit_is_one_line_and_soon(unit: str) -> None:
    """Not computed until the machine is full, either."""
    try:
        assert isinstance(factor("F_hitch", unit, "N"), float)
    except HitchError as error:
        assert "\n" not in str(error) and "is no unit of F_hitch; allowed: N " in str(error)


def test_mat_files_that_are_none(tmp_path: Path) -> None:
    words, empty, vectors, broken = (tmp_path / f"{name}.mat" for name in ("words", "empty", "vectors", "broken"))
    words.write_text("no MAT file at all, " * 20)
    savemat(empty, {"text": "nothing"})
    savemat(vectors, {"time": [0.0, 1.0], "speed": [3, 4], "matrix": np.eye(2)})
    trajectories = {name: np.zeros((2, 2)) for name in ("dataInfo", "data_1", "data_2")}
    texts = {name: np.array([list("ab")]) for name in ("name", "description")}
    savemat(broken, {"Aclass": np.array([list("x       "), *[list("binTrans")] * 3]), **texts, **trajectories})
    for path, words_ in (
        (words, "is no MAT file"),
        (empty, "neither trajectories nor"),
        (broken, "is broken: what it"),
    ):
        with pytest.raises(HitchError, match=words_) as caught:
            read_table(path)
        assert "\n" not in str(caught.value)
    table = read_table(vectors)
    assert table.names == ("time", "speed")
    np.testing.assert_array_equal(table.column("speed")[0], [3.0, 4.0])
    with pytest.raises(HitchError, match=r"is no trace that can be read; allowed: \.csv"):
        read_table(tmp_path / "a.xlsx")


FOREIGN = {
    "Zeit [s]": None, "t": "time", "vehicle.speed [km/h]": "v_car", "caravan.velocity [km/h]": "v_trailer",
    "VehicleAcceleration [m/s2]": "a_car", "hitch_force [kN]": "F_hitch", "Drawbar travel (mm)": "compression",
    "temperature [K]": None,
}  # fmt: skip


def test_a_mapping_is_proposed_for_a_trace(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "theirs.csv"
    path.write_text(",".join(FOREIGN) + "\n" + ",".join("0" * len(FOREIGN)) + "\n", encoding="utf-8")
    assert cli.main(["crosscheck", "--propose", str(path), "--output", str(tmp_path)]) == 0
    assert capsys.readouterr().out == f"wrote {tmp_path / 'theirs.toml'}\n"
    found = {ours: theirs.name for ours, theirs in read_mapping(tmp_path / "theirs.toml").items()}
    assert found.items() >= {ours: theirs for theirs, ours in FOREIGN.items() if ours and ours != "time"}.items()
    assert "temperature [K]" not in found.values()


def test_a_mapping_is_proposed_for_an_fmu(car_trailer_fmus: dict[int, Path], tmp_path: Path) -> None:
    """For ours it is ours; for one that calls the force otherwise it is that."""
    for fmu in car_trailer_fmus.values():
        other, mapping = tmp_path / "other.fmu", tmp_path / "other.toml"
        rewritten(fmu, other, "modelDescription.xml", b'name="F_hitch"', b'name="coupling.forceHitch"')
        mapping.write_text(proposal(other), encoding="utf-8")
        found = {ours: theirs.name for ours, theirs in read_mapping(mapping).items()}
        assert found.pop("F_hitch") == "coupling.forceHitch"
        assert found == {name: name for name in OURS if name not in ("time", "F_hitch")}


@given(st.lists(st.text(st.characters(exclude_categories=("Cs",)), min_size=1), min_size=1, max_size=4))
def test_whatever_names_there_are_the_proposal_can_be_read(
    tmp_path_factory: pytest.TempPathFactory, names: list[str]
) -> None:
    from unittest.mock import patch

    from overrun_hitch.foreign.candidates import Candidate

    hostile = [Candidate(f"v_car.{name}", name, name, "") for name in names]
    with patch("overrun_hitch.comparison.proposal._columns", lambda _: [*hostile, Candidate("v_car", None, "", "")]):
        text = proposal(Path("a.csv"))
    mapping = tmp_path_factory.mktemp("toml") / "a.toml"
    mapping.write_text(text, encoding="utf-8", newline="")
    assert read_mapping(mapping)["v_car"].name == "v_car" and all(c.isprintable() or c == "\n" for c in text)
