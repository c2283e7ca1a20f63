"""hitch crosscheck: an FMU agrees with itself, a 1 % different one does not, and what is written is as documented."""

from __future__ import annotations

import json
import math
import shutil
import tempfile
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

import numpy as np
import pyfunnel
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fmu_build.pipeline import build
from overrun_hitch import cli
from overrun_hitch.comparison import crosscheck_table
from overrun_hitch.comparison.crosscheck import Comparison, Crosscheck, compare_runs
from overrun_hitch.comparison.crosscheck_figures import LINES, draw, names
from overrun_hitch.comparison.distances import Allowed
from overrun_hitch.comparison.record import Compared
from overrun_hitch.measure.funnel import funnel
from overrun_hitch.measure.judged import Judged
from overrun_hitch.measure.passages import passages
from overrun_hitch.parameters import FIGURES
from overrun_hitch.results import VARIABLES
from overrun_hitch.show.traces import KINDS, rendered
from tests.oracles import radau
from tests.overrun_hitch.experiments.test_step_brake import rewritten
from tests.runs import step_brake
from tests.sampling import sampled

Brake = Callable[..., xr.Dataset]
TIME = np.arange(601) * 0.01


@pytest.fixture(scope="module")
def other_damper_fmu(modelica_library: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Our FMU, but its damper's force is 1 % larger."""
    library = tmp_path_factory.mktemp("other") / modelica_library.name
    shutil.copytree(modelica_library, library)
    drawbar = library / "Interfaces" / "PartialDrawbar.mo"
    text = drawbar.read_text(encoding="utf-8")
    assert text.count("= F_damper +") == 1
    drawbar.write_text(text.replace("= F_damper +", "= 1.01*F_damper +"), encoding="utf-8")
    fmu = library.with_name("Other.fmu")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("CFLAGS", "-O0")  # the same bits
        build(library, "OverrunHitch.Systems.CarTrailer", fmu, references=False)
    return fmu


@pytest.fixture
def brake(car_trailer_fmu: Path) -> Brake:
    """brake(figure, **changes): the figure's run with parameters changed, as if they had not been."""

    def run(figure: str, **changes: float) -> xr.Dataset:
        scenario = FIGURES[figure]
        changed = scenario.changed(parameters=scenario.parameters.changed(changes))
        return step_brake(changed, fmu=car_trailer_fmu).assign_attrs(scenario.parameters.model_dump())

    return run


def compared(*names: str) -> list[Compared]:
    return [Compared(label, name, (), {}) for label, name in zip("AB", names, strict=True)]


def with_values(run: xr.Dataset, name: str, values: np.ndarray) -> xr.Dataset:
    return run.assign({name: ("time", values, run[name].attrs)})


def number(comparison: Comparison, quantity: str) -> Judged:
    (found,) = (row for row in comparison.numbers if row.quantity == quantity)
    return found


def test_an_fmu_agrees_with_itself_and_the_files_are_as_documented(
    car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    chosen = ["--figure", "10", "--figure", "8", "--figure", "10"]
    output = tmp_path / "out"
    assert cli.main(["crosscheck", *[str(car_trailer_fmu)] * 3, *chosen, "--output", str(output)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    names = {"crosscheck.json", *(f"figure-{figure}.{kind}" for figure in ("8", "10") for kind in ("png", "svg"))}
    assert {path.name for path in output.iterdir()} == names
    assert all(f"wrote {output / name}\n" in out for name in names)
    assert "differs" not in out
    assert "B agrees with A in figure 10, figure 8\n" in out
    assert "C agrees with A in figure 10, figure 8\n" in out

    content = json.loads((output / "crosscheck.json").read_text(encoding="utf-8"))
    assert content["agrees"] is True
    assert set(content["files"]) == {str(output / name) for name in names}
    assert [source["label"] for source in content["sources"]] == ["A", "B", "C"]
    assert {source["path"] for source in content["sources"]} == {str(car_trailer_fmu)}
    assert {source["sha256"] for source in content["sources"]} == {sha256(car_trailer_fmu.read_bytes()).hexdigest()}
    assert {source["interface"] for source in content["sources"]} == {"FMI 2.0, Co-Simulation"}
    assert [figure["name"] for figure in content["figures"]] == ["figure 10", "figure 8"]
    for figure in content["figures"]:
        assert [comparison["source"] for comparison in figure["comparisons"]] == ["B", "C"]
        for comparison in figure["comparisons"]:
            assert [row["variable"] for row in comparison["variables"]] == list(VARIABLES)
            assert {row["largest"] for row in comparison["variables"]} == {0.0}
            assert {row["difference"] for row in comparison["numbers"] + comparison["passages"]} == {0.0}


def test_a_damper_one_percent_off_differs(
    car_trailer_fmu: Path, other_damper_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["crosscheck", str(car_trailer_fmu), str(other_damper_fmu), "--output", str(tmp_path)]
    assert cli.main([*arguments, "--figure", "8"]) == 1
    out = capsys.readouterr().out
    assert "B differs from A in figure 8: a_trailer, compression, F_hitch, slip_trailer" in out
    assert "shunting growth, damping ratio\n" in out
    # Where growth is not judged, traces and passages still are.
    assert cli.main([*arguments, "--figure", "7", "--json"]) == 1
    out, err = capsys.readouterr()
    assert err == ""
    assert out == (tmp_path / "crosscheck.json").read_text(encoding="utf-8")
    (comparison,) = json.loads(out)["figures"][0]["comparisons"]
    verdicts = {row["variable"]: row["verdict"] for row in comparison["variables"]}
    assert verdicts["F_hitch"] == verdicts["compression"] == "differs"
    assert {row["verdict"] for row in comparison["passages"]} == {"differs"}
    assert comparison["numbers"][0]["verdict"] == "not judged"
    assert comparison["numbers"][0]["not_judged"].startswith("drawbar leaves compression")


@pytest.mark.parametrize("figure", sampled(FIGURES, ["6a", "8", "11"]))
def test_a_coarser_tolerance_agrees(car_trailer_fmu: Path, figure: str) -> None:
    fine, coarse = (step_brake(FIGURES[figure], fmu=car_trailer_fmu, relative_tolerance=rtol) for rtol in (1e-10, 1e-5))
    comparison = compare_runs(fine, coarse, "B", Allowed())
    assert comparison.differing == []
    assert 1e-5 < max(row.largest / row.range for row in comparison.distances) < 2e-3


def test_passages_are_the_oracles(car_trailer_fmu: Path) -> None:
    for figure in ("10", "11"):
        found = passages(step_brake(FIGURES[figure], fmu=car_trailer_fmu))
        events = radau.trajectory(FIGURES[figure].parameters, method="DOP853").events
        assert [passage.time for passage in found] == pytest.approx(events, abs=1e-6)
        assert [passage.kind for passage in found] == [
            "eps in",
            "eps out",
            *["eps in", "eps out"] * 9,
        ][: len(events)]
    # The drawbar of figure 6a strikes its stop; the cubic has a kink inside it there.
    found = passages(step_brake(FIGURES["6a"], fmu=car_trailer_fmu))
    events = radau.trajectory(FIGURES["6a"].parameters, method="DOP853").events
    assert [passage.time for passage in found] == pytest.approx(events, abs=2e-5)
    assert {passage.end for passage in found} == {"0"}


def test_passages_of_one_alone_differ(brake: Brake) -> None:
    """With C = 130 the drawbar stays in compression, with 100 it dips out of it."""
    stays, dips = (brake("7", C=C) for C in (130.0, 100.0))
    for reference, run in ((stays, dips), (dips, stays)):
        comparison = compare_runs(reference, run, "B", Allowed())
        assert len(comparison.passages) == 16
        assert all(row.differs for row in comparison.passages)
        assert "drawbar passages" in comparison.differing
    assert number(compare_runs(stays, dips, "B", Allowed()), "shunting growth").not_judged.startswith("B: drawbar ")


def test_growth_is_judged_where_both_stay_in_compression(brake: Brake) -> None:
    reference = brake("8")
    for C, verdict in ((500.0, "agrees"), (500.1, "agrees"), (505.0, "differs")):
        growth = number(compare_runs(reference, brake("8", C=C), "B", Allowed()), "shunting growth")
        assert growth.verdict == verdict
    assert growth.difference == pytest.approx(-0.0072, abs=2e-4)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_funnel_is_as_high_and_as_wide_as_told(sign: float) -> None:
    sine, slope = 3e-9 * np.sin(7.0 * TIME), 5e-10 * TIME  # small against pyfunnel's own threshold
    for share, inside in ((0.99, True), (1.01, False)):
        raised = funnel(TIME, sine, sine + sign * share * 1e-12, height=1e-12, width=0.0)
        assert (raised.outside.max() == 0.0) == inside
        assert raised.outside.max() == pytest.approx(max(0.0, share - 1.0) * 1e-12, abs=1e-16)
        late = funnel(TIME, slope, slope - sign * share * 5e-13, height=1e-16, width=1e-3)
        assert (late.outside[1:-1].max() == 0.0) == inside
    assert (raised.lower < sine).all()
    assert (raised.upper > sine).all()


def test_what_is_no_number_differs(brake: Brake) -> None:
    reference = brake("8")
    for value in (math.nan, math.inf):
        slip = reference["slip_car"].values.copy()
        slip[300] = value
        broken = with_values(reference, "slip_car", slip)
        for a, b in ((reference, broken), (broken, reference)):
            comparison = compare_runs(a, b, "B", Allowed())
            assert comparison.differing == ["slip_car"]
            assert number(comparison, "shunting growth").verdict == "not judged"
            check = Crosscheck(FIGURES["8"], a, (comparison,))
            assert rendered(draw(check, ["a", "b"], Allowed()), "svg").startswith(b"<?xml")
            crosscheck_table.show([check], compared("a", "b"), Allowed(), [])


def test_a_run_that_ends_early_or_runs_away_differs(brake: Brake) -> None:
    reference = brake("8")
    early = compare_runs(reference, reference.isel(time=slice(0, 301)), "B", Allowed())
    assert early.differing == ["end of the run"]
    assert {row.largest for row in early.distances} == {0.0}
    away = with_values(reference, "compression", reference["compression"].values * np.exp(5.0 * TIME))
    comparison = compare_runs(reference, away, "B", Allowed())
    assert comparison.differing[0] == "compression"
    above, below = draw(Crosscheck(FIGURES["8"], reference, (comparison,)), ["a", "b"], Allowed()).axes
    assert np.abs(above.get_ylim()).max() < 0.2
    assert np.abs(below.get_ylim()).max() < 60.0


@pytest.mark.full
def test_pictures_have_units_and_legends_off_the_curves(brake: Brake) -> None:
    reference, *others = [brake("6a", C=C) for C in (20.0, 21.0, 22.0, 25.0)]
    comparisons = [compare_runs(reference, one, label, Allowed()) for label, one in zip("BCD", others, strict=True)]
    check = Crosscheck(FIGURES["6a"], reference, tuple(comparisons))

    def drawn() -> Figure:
        return draw(check, ["A.fmu", "b" * 80, "$^$.fmu", "D.fmu"], Allowed())

    assert all(rendered(drawn(), kind) == rendered(drawn(), kind) for kind in KINDS)
    figure = drawn()
    above, below = figure.axes
    labels = [above.get_ylabel(), below.get_ylabel(), below.get_xlabel()]
    assert labels == ["Compression (m)", "Difference (mm)", "Time (s)"]
    FigureCanvasAgg(figure).draw()
    for axes in (above, below):
        legend = axes.get_legend().get_window_extent()
        assert legend.y0 >= axes.get_window_extent().y1
        assert legend.x0 >= 0.0
    assert len({str(line["linestyle"]) for line in LINES}) == len(LINES)  # for those who print in grey


BAD = [
    ([], "nothing cannot be compared: two files at least are needed"),
    (["one.fmu"], "one.fmu alone cannot be compared: two files at least are needed"),
    (["no.fmu", "none.fmu"], "no.fmu is not there"),
    (["text.fmu", "text.fmu"], "an FMU is a zip archive"),
    (["text.fmu"] * 27, "27 files are too many: 26 at most"),
    (["text.fmu", "text.fmu", "--figure", "12"], "there is no figure '12'; allowed: "),
    (["text.fmu", "text.fmu", "--funnel", "0"], "funnel = 0 is not allowed"),
    (["text.fmu", "text.fmu", "--funnel", "nan"], "funnel = nan is not allowed"),
    (["text.fmu", "text.fmu", "--funnel-time", "-1"], "funnel_time = -1 s is not allowed"),
    (["text.fmu", "text.fmu", "--tolerance", "0"], "relative_tolerance = 0 is not allowed"),
    (["text.fmu", "text.fmu", "--step", "0"], "communication_step = 0 s is not allowed"),
]


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_bad_input_is_one_line_and_status_2(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("text.fmu").write_text("no archive")
    assert cli.main(["crosscheck", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert message in err
    assert [path.name for path in tmp_path.iterdir()] == ["text.fmu"]


def test_what_one_has_not_is_said_and_the_rest_compared(
    car_trailer_fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other.fmu"
    rewritten(car_trailer_fmu, other, "modelDescription.xml", b'name="F_hitch"', b'name="F_hinge"')
    arguments = ["crosscheck", str(car_trailer_fmu), str(other), "--figure", "8", "--output", str(tmp_path / "out")]
    assert cli.main(arguments) == 0
    said = "B agrees with A in figure 8 in all that can be compared; not compared: F_hitch\n"
    assert said in capsys.readouterr().out


@pytest.mark.parametrize("place", ["pyfunnel.compareAndReport", "overrun_hitch.show.traces.rendered"])
def test_interrupted_it_leaves_nothing(
    place: str, car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(place, interrupt)
    arguments = [str(car_trailer_fmu), str(car_trailer_fmu), "--figure", "8", "--output", str(tmp_path / "out")]
    assert cli.main(["crosscheck", *arguments]) == 130
    assert list(tmp_path.iterdir()) == []


def test_where_pyfunnel_has_no_library(
    car_trailer_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(pyfunnel.core, "_get_lib_path", lambda _: str(tmp_path / "lib" / "linuxarm64" / "libfunnel.so"))
    arguments = [str(car_trailer_fmu), str(car_trailer_fmu), "--output", str(tmp_path / "out")]
    assert cli.main(["crosscheck", *arguments]) == 2
    err = capsys.readouterr().err
    assert "traces cannot be compared here: No funnel library for this platform" in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_pictures_tell_files_of_one_name_apart() -> None:
    fmus = [Path(p) for p in ("x/a/Car.fmu", "y/a/Car.fmu", "y/b/Car.fmu", "b/Van.fmu", "Car.fmu", "b/Van.fmu")]
    expected = ["x/a/Car.fmu", "y/a/Car.fmu", "b/Car.fmu", "Van.fmu", f"{Path.cwd().name}/Car.fmu", "Van.fmu"]
    assert names(fmus) == [str(Path(name)) for name in expected]


def test_narrow_output_stays_readable(
    brake: Brake, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    runs = tuple(brake("7", C=C) for C in (100.0, 101.0))
    check = Crosscheck(FIGURES["7"], runs[0], (compare_runs(*runs, "B", Allowed()),))
    for width in ("40", "80"):
        monkeypatch.setenv("COLUMNS", width)
        crosscheck_table.show([check], compared("a" * 90, "b.fmu"), Allowed(), [])
        out = capsys.readouterr().out
        assert "\x1b" not in out
        for words in (
            "a" * 90,
            "trailer_brake_torque",
            "shunting frequency",
            "passes 0 out",
            "not judged: drawbar",
        ):
            assert words in out
        assert "of 16 drawbar passages the 6" in " ".join(out.split())
