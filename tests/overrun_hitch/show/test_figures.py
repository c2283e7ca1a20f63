"""Figures: the paper's traces with units, the same bytes for the same run."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import pytest
import xarray as xr

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
