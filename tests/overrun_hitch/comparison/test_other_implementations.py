"""hitch crosscheck with other people's FMUs: hand-made ones, other kinds of ours, other names, hostile words."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from lxml import etree

from overrun_hitch import cli
from overrun_hitch.comparison.crosscheck import Crosscheck, crosscheck
from overrun_hitch.comparison.distances import Allowed
from overrun_hitch.comparison.sources import Asked, Manoeuvre, opened_sources
from overrun_hitch.experiments.step_brake import car_alone
from overrun_hitch.fmu.opening import opened_foreign
from overrun_hitch.fmu.settings import Settings
from overrun_hitch.foreign.mapping import read_mapping
from overrun_hitch.parameters import FIGURES, HitchError
from tests.overrun_hitch.experiments.test_step_brake import rewritten
from tests.overrun_hitch.fmu.strangers import FAULTS, stranger
from tests.overrun_hitch.foreign.hand_made import hand_made


def checked(*files: Asked, figures: list[str]) -> Iterator[Crosscheck]:
    with opened_sources(list(files), 60.0) as sources:
        for figure in figures:
            yield crosscheck(Manoeuvre(FIGURES[figure], Settings()), sources, Allowed())


@pytest.mark.parametrize("figures", [["10"], pytest.param(list(FIGURES), marks=pytest.mark.full)], ids=["10", "all"])
def test_a_hand_made_fmu_agrees_in_all_figures_and_a_stiffer_one_in_none(
    figures: list[str], car_trailer_fmu: Path
) -> None:
    """It has 13 parameters, V_0 and compression_start; the other's drawbar is 1 % stiffer."""
    files = [Asked(fmu, {}, None) for fmu in (car_trailer_fmu, hand_made(), hand_made(1.01))]
    for check in checked(*files, figures=figures):
        hand, stiffer = check.comparisons
        farthest = max(row.largest / row.range for row in hand.distances)
        print(f"{check.scenario.name}: hand-made within {farthest:.1e} of a range, stiffer: {stiffer.differing}")
        assert hand.failure == "" and hand.differing == [] and hand.not_compared == []
        assert {"F_hitch", "slip_trailer"} <= set(stiffer.differing)


ORDERS = ["ours hand stiffer turned", "turned hand ours stiffer", "hand stiffer turned hand"]


@pytest.mark.full
@pytest.mark.parametrize("order", ORDERS)
def test_verdicts_do_not_depend_on_what_else_there_is(
    order: str, car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fmus = {"ours": car_trailer_fmu, "hand": hand_made(), "stiffer": hand_made(1.01), "turned": hand_made(sign=-1.0)}
    chosen = order.split()
    command = ["crosscheck", *(str(fmus[name]) for name in chosen), "--figure", "8", "--output", str(tmp_path)]
    assert cli.main(command) == 1
    out = capsys.readouterr().out
    for label, name in zip("BCD", chosen[1:], strict=True):
        differing = {"slip_trailer"} if name == "stiffer" else set()
        if (name == "turned") != (chosen[0] == "turned"):
            differing.add("F_hitch")
        (line,) = [line for line in out.splitlines() if line.startswith(f"{label} ") and " A in " in line]
        said = {part for part in line.rpartition(": ")[2].split(", ") if "differs" in line}
        assert differing <= said if name == "stiffer" else differing == said
    assert out.count("   F_hitch: opposite sign?\n") == sum(
        (name == "turned") != (chosen[0] == "turned") for name in chosen
    )


@pytest.mark.full
def test_other_kinds_of_the_same_unit_agree(car_trailer_fmus: dict[int, Path]) -> None:
    kinds = [Asked(car_trailer_fmus[fmi], {}, use) for fmi, use in ((2, "cs"), (2, "me"), (3, "cs"), (3, "me"))]
    for check in checked(*kinds, figures=["6a"]):
        assert [comparison.differing for comparison in check.comparisons] == [[], [], []]


@pytest.mark.full
def test_runs_of_another_kind(
    car_trailer_fmus: dict[int, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["run", "--fmu", str(car_trailer_fmus[3]), "--type", "me", "--output", str(tmp_path)]) == 0
    assert capsys.readouterr().err == ""
    assert cli.main(["run", "--fmu", str(hand_made()), "--output", str(tmp_path)]) == 0
    assert "hint: PaperSlave.fmu declares no unit, taken as ours: all of them\n" in capsys.readouterr().err


def test_a_parameter_that_is_not_there_counts_as_neutral(car_trailer_fmu: Path, tmp_path: Path) -> None:
    other, torque = tmp_path / "other.fmu", {"brake_torque": 1000.0}
    rewritten(car_trailer_fmu, other, "modelDescription.xml", b'name="eps"', b'name="gap"')
    said = r"^other\.fmu has no eps, which is 0\.1 m in this run; without it allowed: 0 m$"
    with pytest.raises(HitchError, match=said), opened_foreign(other, {}, None) as unit:
        assert unit.identity.notes == ("has no parameter eps: taken as at their defaults",)
        unit.start(FIGURES["8"].parameters, torque, 1e-6)
        unit.start(FIGURES["10"].parameters, torque, 1e-6)


def test_a_stiffness_that_is_out_of_reach_does_not_count(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """As `hitch run` sets all of them to 0 for the car alone."""
    other, torque, parameters = tmp_path / "other.fmu", {"brake_torque": 1000.0}, FIGURES["8"].parameters
    rewritten(car_trailer_fmu, other, "modelDescription.xml", b'name="k_3"', b'name="k_4"')
    with opened_foreign(other, {}, None) as unit:
        unit.start(car_alone(FIGURES["8"]).parameters, torque, 1e-6)
        with pytest.raises(HitchError, match=r"has no k_3, which is 1 N/m in this run; without it allowed: 5480 N/m"):
            unit.start(parameters.changed({"k_3": 1.0, "x_3": 0.1}), torque, 1e-6)


def test_names_signs_and_units_of_others(car_trailer_fmu: Path, tmp_path: Path) -> None:
    other, mapping = tmp_path / "other.fmu", tmp_path / "other.toml"
    rewritten(car_trailer_fmu, other, "modelDescription.xml", b'name="F_hitch"', b'name="Vehicle.hitch.force"')
    verdicts = []
    for rest in ("", 'sign = -1\nunit = "kN"\n'):
        mapping.write_text(f'[F_hitch]\ntheirs = "Vehicle.hitch.force"\n{rest}')
        verdicts.append(Asked(other, read_mapping(mapping), None))
    (check,) = checked(Asked(car_trailer_fmu, {}, None), *verdicts, figures=["8"])
    named, turned = check.comparisons
    assert named.differing == [] and turned.differing == ["F_hitch"]
    assert [row.hint for row in turned.distances if row.differs] == ["opposite sign?, a factor of 1000, unit?"]


@pytest.mark.full
def test_units_are_the_fmus_own(car_trailer_fmu: Path, tmp_path: Path) -> None:
    """What the FMU calls "m/s2" it defines as 1000 of ours."""
    other = tmp_path / "other.fmu"
    old = b'<BaseUnit m="1" s="-2"/>'
    rewritten(car_trailer_fmu, other, "modelDescription.xml", old, old.replace(b"/>", b' factor="1000.0"/>'))
    (check,) = checked(Asked(car_trailer_fmu, {}, None), Asked(other, {}, None), figures=["8"])
    hints = {row.variable: row.hint for row in check.comparisons[0].distances}
    assert hints["a_car"] == hints["a_trailer"] == "a factor of 1000, unit?"


@pytest.mark.parametrize(
    ("toml", "message"),
    [
        ('[F_hitsch]\ntheirs = "F"', "there is no variable 'F_hitsch'; did you mean F_hitch?"),
        ('[F_hitch]\ntheirs = "F_hich"', "there is no variable 'F_hich'; did you mean F_hitch?"),
        ('[F_hitch]\ntheirs = "M_c"', "'M_c' cannot be F_hitch: it is no real number that can be read (parameter)"),
        ('[F_hitch]\ntheirs = "F_hitch"\nunit = "m"', "F_hitch: 'm' is no unit of F_hitch; allowed: N and what can"),
        ('[F_hitch]\ntheirs = "F_hitch"\nsign = 2', "sign = 2 of [F_hitch] is not allowed; allowed: 1 or -1"),
        ("[F_hitch]\nsign = 1", "[F_hitch] is not allowed as it is; allowed: theirs ="),
        ("F_hitch = 1", "[F_hitch] is not allowed as it is; allowed: theirs ="),
        ("[F_hitch", "is not TOML"),
    ],
)
def test_a_mapping_that_is_none(toml: str, message: str, car_trailer_fmu: Path, tmp_path: Path) -> None:
    mapping = tmp_path / "bad.toml"
    mapping.write_text(toml)
    with pytest.raises(HitchError) as caught, opened_foreign(car_trailer_fmu, read_mapping(mapping), None):
        pass
    assert message in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.full
def test_one_that_fails_is_one_line_and_the_others_are_judged(
    car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = tmp_path / "broken.fmu"
    broken.write_text("no archive")
    crashes = stranger(car_trailer_fmu, tmp_path / "crashes.fmu", do_step=f"if (time > 1.0) {{ {FAULTS} }}")
    hangs = stranger(car_trailer_fmu, tmp_path / "hangs.fmu", do_step="if (time > 1.0) for (;;) pause();")
    fmus = [car_trailer_fmu, broken, hangs, car_trailer_fmu, crashes]
    options = ["--figure", "8", "--figure", "10", "--time-limit", "4", "--output", str(tmp_path / "out")]
    junit = tmp_path / "verdict.xml"
    assert cli.main(["crosscheck", *map(str, fmus), *options, "--junit", str(junit)]) == 2
    out = capsys.readouterr().out
    verdicts = [line for line in out.splitlines() if line[1:].startswith((" agrees", " differs", " could"))]
    both = "in figure 8, figure 10"
    assert verdicts[0].startswith(f"B could not be compared {both}: {broken} is broken")
    assert verdicts[1].startswith(f"C could not be compared {both}: {hangs}: did not finish within 4 s")
    assert verdicts[2] == f"D agrees with A {both}"
    assert verdicts[3].startswith(f"E could not be compared {both}: {crashes}: crashed: segmentation fault")
    suites = etree.parse(str(junit)).getroot()
    assert [(suite.get("errors"), suite.get("failures")) for suite in suites] == [("2", "0")] * 2 + [
        ("0", "0"),
        ("2", "0"),
    ]
    document = json.loads((tmp_path / "out" / "crosscheck.json").read_text(encoding="utf-8"))
    assert document["agrees"] is False and document["status"] == 2


def test_hostile_words_do_nothing(car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hostile = "\u202e[red]<script>alert(1)</script>&#10;$x^2$; `rm -rf ~` \x9b31m"
    other, mapping, junit = tmp_path / "other.fmu", tmp_path / "other.toml", tmp_path / "verdict.xml"
    name = hostile.replace("&", "&amp;").replace("<", "&lt;").encode()
    rewritten(car_trailer_fmu, other, "modelDescription.xml", b'name="F_hitch"', b'name="' + name + b'"')
    mapping.write_text(f"[F_hitch]\ntheirs = {json.dumps(hostile)}\nunit = {json.dumps(hostile)}\n", encoding="utf-8")
    command = ["crosscheck", str(car_trailer_fmu), str(other), "--figure", "8", "--map", str(mapping)]
    assert cli.main([*command, "--junit", str(junit), "--output", str(tmp_path / "out")]) == 2
    out, err = capsys.readouterr()
    assert err == "" and "[red]" in out
    assert not set(out) & {"\u202e", "\x9b", "\x1b"}
    assert "script" in str(etree.parse(str(junit)).getroot()[0][0][0].get("message"))


def test_files_that_are_not_there(car_trailer_fmu: Path) -> None:
    with pytest.raises(HitchError, match=r"none\.fmu is not there"):
        list(checked(Asked(car_trailer_fmu, {}, None), Asked(Path("none.fmu"), {}, None), figures=["8"]))
