"""Figures: the paper's traces with units, the same bytes for the same run."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import pytest
import xarray as xr
from matplotlib.axes import Axes

from overrun_hitch.parameters import FIGURES
from overrun_hitch.show.traces import DPI, STYLE, draw, rendered, write
from tests.sampling import sampled

OracleRun = Callable[..., xr.Dataset]


def test_five_traces_with_units(oracle_run: OracleRun) -> None:
    panels = draw(oracle_run(FIGURES["8"])).axes
    assert [axes.get_ylabel() for axes in panels] == ["Acceleration (m/s²)", "Compression (m)", "Slip (%)"]
    assert panels[-1].get_xlabel() == "Time (s)"
    traces = [line for axes in panels for line in axes.lines if len(line.get_xydata()) > 2]
    assert len(traces) == 5


def test_a_notebook_shows_them(oracle_run: OracleRun) -> None:
    """Jupyter asks for this method (IPython, Integrating your objects)."""
    picture = draw(oracle_run(FIGURES["8"]))._repr_svg_()  # type: ignore[attr-defined]
    assert picture.startswith("<?xml") and "<svg" in picture


def told(axes: Axes) -> list[str]:
    return [text.get_text() for text in axes.texts]


def test_a_start_does_not_squeeze_what_follows(oracle_run: OracleRun) -> None:
    run = oracle_run(FIGURES["8"]).copy(deep=True)
    usual = [axes.get_ylim() for axes in draw(run).axes]
    assert [told(axes) for axes in draw(run).axes] == [[], [], []]
    run["a_trailer"][0], run["a_car"][1] = 32.0, -64.0
    above, *others = draw(run).axes
    assert told(above) == ["at the start to -64 and 32"] and above.get_ylim() == pytest.approx(usual[0], rel=0.1)
    assert [axes.get_ylim() for axes in others] == usual[1:] and not [word for axes in others for word in told(axes)]


def test_what_comes_later_is_never_cut(oracle_run: OracleRun) -> None:
    run = oracle_run(FIGURES["8"]).copy(deep=True)
    run["a_trailer"][300] = 32.0
    (low, high), words = draw(run).axes[0].get_ylim(), told(draw(run).axes[0])
    assert low < -4.0 and high > 32.0 and words == []


@pytest.mark.parametrize("figure", sampled(["6a", "10"], ["10"]))
def test_the_same_run_gives_the_same_files(oracle_run: OracleRun, tmp_path: Path, figure: str) -> None:
    run = oracle_run(FIGURES[figure])
    first, second = write(run, tmp_path / "a"), write(run, tmp_path / "b")
    assert [path.name for path in first] == ["a.png", "a.svg"]
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
    assert first[0].read_bytes().startswith(b"\x89PNG")
    assert b"<svg" in first[1].read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.png", "a.svg", "b.png", "b.svg"]


@pytest.mark.full
def test_files_are_those_of_savefig(oracle_run: OracleRun) -> None:
    """Which draws everything twice."""
    run = oracle_run(FIGURES["8"])
    mine, theirs = draw(run), draw(run)
    for kind, how in [("png", {"dpi": DPI}), ("svg", {"metadata": {"Date": None}})]:
        buffer = io.BytesIO()
        with mpl.rc_context(STYLE):
            theirs.savefig(buffer, format=kind, **how)
        assert rendered(mine, kind) == buffer.getvalue()
