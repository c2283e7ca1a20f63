"""`hitch paper`: the table, the JSON document, the files, the exit status."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from overrun_hitch import cli
from overrun_hitch.paper.claims.all import all_claims
from overrun_hitch.paper.figures import all as paper_figures_module
from overrun_hitch.paper.study import study as study_module
from overrun_hitch.paper.study.study import Study
from tests.sampling import sampled

Command = Callable[..., int]


def with_wrong_ratio(study: Study) -> Study:
    """Claim 1 does not hold on the FMU."""
    wrong = dataclasses.replace(study.steady_fmu["ii"], ratio=0.9)
    return dataclasses.replace(study, steady_fmu={**study.steady_fmu, "ii": wrong})


@pytest.fixture
def command(
    paper_study: Study, paper_figures: dict[str, Figure], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> Command:
    """`hitch paper` on what was computed once; without `every`, with one figure alone."""

    def run(*arguments: str, study: Study = paper_study, every: bool = False) -> int:
        chosen = paper_figures if every else {"3": paper_figures["3"]}
        monkeypatch.setattr(study_module, "study", lambda *_: study)
        monkeypatch.setattr(paper_figures_module, "figures", lambda *_: chosen)
        return cli.main(["paper", "--fmu", "any.fmu", "--output", str(tmp_path / "out"), *arguments])

    return run


@pytest.mark.full
def test_files(command: Command, paper_figures: dict[str, Figure], tmp_path: Path) -> None:
    assert command(every=True) == 0
    names = {path.name for path in (tmp_path / "out").iterdir()}
    stems = {f"figure-{name}" for name in paper_figures if name[0].isdigit()} | {
        "boundary",
        "cycles",
        "device",
        "stops",
    }
    assert names == {f"{stem}.{kind}" for stem in stems for kind in ("svg", "png")}
    for path in (tmp_path / "out").iterdir():
        assert path.read_bytes().startswith(b"\x89PNG" if path.suffix == ".png" else b"<?xml")


@pytest.mark.parametrize("width", sampled(["40", "80", "140"], ["40"]))
def test_table_piped_and_narrow(
    command: Command,
    paper_study: Study,
    width: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("COLUMNS", width)
    assert command() == 0
    out, err = capsys.readouterr()
    assert "\x1b" not in out and err == ""
    # Words alone: where lines break depends on the width.
    words = " ".join(out.split())
    for claim in all_claims(paper_study):
        assert f"{claim.number} holds ({claim.where}) {claim.text}" in words
    assert "13 of 13 claims of the paper hold" in words
    assert "0.89999" in words and "rounds to 0.90" in words
    assert f"wrote {Path('x').parent}" not in words and "figure-3.svg" in words
    assert max(len(line) for line in out.splitlines() if "wrote" not in line) <= int(width)


def test_json_alone_on_stdout(
    command: Command, paper_study: Study, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("--json") == 0
    out, err = capsys.readouterr()
    assert err == ""
    document = json.loads(out)
    assert document["holds"] is True and document["guid"] == paper_study.guid
    assert [claim["number"] for claim in document["claims"]] == list(range(1, 14))
    for found, claim in zip(document["claims"], all_claims(paper_study), strict=True):
        assert found["verdict"] == claim.verdict
        for row, part in zip(found["parts"], claim.parts, strict=True):
            assert row["unit"] and row["criterion"]
            assert row["fmu"] is None or row["fmu"] == part.fmu
            assert (row["theory"] is None) == (row["holds"]["theory"] is None)
    assert any(row["theory"] is None for claim in document["claims"] for row in claim["parts"])
    assert sorted(Path(file).name for file in document["files"]) == ["figure-3.png", "figure-3.svg"]
    assert all(Path(file).is_file() for file in document["files"])


@pytest.mark.parametrize("width", sampled(["40", "100"], ["40"]))
def test_a_claim_that_does_not_hold(
    command: Command,
    paper_study: Study,
    width: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("COLUMNS", width)
    assert command(study=with_wrong_ratio(paper_study)) == 1
    words = " ".join(capsys.readouterr().out.split())
    assert "1 does not hold on the FMU (sections 8.1, 8.2)" in words
    assert "12 of 13 claims of the paper hold; claim 1 does not hold on the FMU" in words
    assert "0.90000 !" in words and "a number with ! does not meet its criterion" in words


def test_a_claim_that_does_not_hold_in_json(
    command: Command, paper_study: Study, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("--json", study=with_wrong_ratio(paper_study)) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["holds"] is False
    claim = document["claims"][0]
    assert claim["holds"] == {"theory": True, "fmu": False}
    assert [row["what"] for row in claim["parts"] if row["holds"]["fmu"] is False] == ["case ii: A / A_c"]


def test_bad_fmu(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bad = tmp_path / "text.fmu"
    bad.write_text("no archive")
    assert cli.main(["paper", "--fmu", str(bad), "--output", str(tmp_path / "out")]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and "text.fmu" in err
    assert not (tmp_path / "out").exists()


def test_output_that_cannot_be_a_folder(command: Command, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "out").write_text("a file")
    assert command() == 2
    assert "cannot write" in capsys.readouterr().err


@pytest.mark.full
@pytest.mark.parametrize("where", [(study_module, "study"), (paper_figures_module, "figures")])
def test_interrupted(
    command: Command, where: tuple[object, str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    assert command() == 0
    for path in (tmp_path / "out").iterdir():
        path.unlink()
    monkeypatch.setattr(*where, interrupt)
    assert cli.main(["paper", "--fmu", "any.fmu", "--output", str(tmp_path / "out")]) == 130
    assert list((tmp_path / "out").iterdir()) == []
