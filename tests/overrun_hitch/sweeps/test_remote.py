"""Schedulers elsewhere: as docs/sweep.md starts one, and whatever is wrong with one told in a line, without a hang."""

from __future__ import annotations

import gc
import os
import shutil
import socket
import subprocess
import sys
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import xarray as xr

from overrun_hitch import cli
from overrun_hitch.parameters import HitchError
from overrun_hitch.sweeps import remote
from overrun_hitch.sweeps.store import read_sweep

SPEC = "metrics = ['peak_jerk']\ncommunication_step = 0.1\ngrid = {C = [100.0, 400.0, 900.0]}"


@pytest.fixture(autouse=True)
def sockets_that_dask_leaves() -> Iterator[None]:
    """Of clients that find no scheduler: gone here, and not in the middle of another test."""
    yield
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        gc.collect()


def documented(program: str) -> list[str]:
    """What docs/sweep.md says after the name of a program."""
    text = (Path(__file__).parents[3] / "docs" / "sweep.md").read_text(encoding="utf-8")
    return next(line for line in text.splitlines() if line.startswith(f"{program} ")).split(program)[1].split()


def certificate(folder: Path) -> Path:
    folder.mkdir()
    subprocess.run(["openssl", *documented("openssl")], cwd=folder, check=True, capture_output=True)
    return folder


def tls(folder: Path, key: Path | None = None) -> list[str]:
    files = {"--tls-ca-file": folder / "cert.pem", "--tls-cert": folder / "cert.pem"}
    options = {**files, "--tls-key": (key or folder) / "key.pem"}
    return [str(word) for pair in options.items() for word in pair]


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


@contextmanager
def started(*command: str, folder: Path, **environment: str) -> Iterator[None]:
    process = subprocess.Popen(
        [sys.executable, "-m", "dask", *command, "--host", "127.0.0.1"],
        cwd=folder, env={**os.environ, **environment}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield
    finally:
        process.terminate()
        process.wait(30.0)


@contextmanager
def scheduler(folder: Path, *options: str) -> Iterator[str]:
    """The address of one that listens on the loopback."""
    port, scheme = free_port(), "tls" if "tls" in options else "tcp"
    with started("scheduler", "--port", str(port), "--dashboard-address", "127.0.0.1:0", *options, folder=folder):
        deadline = time.monotonic() + 60.0
        while time.monotonic() < deadline:
            try:
                socket.create_connection(("127.0.0.1", port), 1.0).close()
            except OSError:
                time.sleep(0.1)
            else:
                break
        yield f"{scheme}://127.0.0.1:{port}"


@contextmanager
def worker(folder: Path, address: str, *options: str, **environment: str) -> Iterator[None]:
    with started("worker", address, "--local-directory", str(folder / "work"), *options, folder=folder, **environment):
        yield


@pytest.fixture
def command(car_trailer_fmu: Path, tmp_path: Path) -> list[str]:
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    return ["sweep", str(spec), "--fmu", str(car_trailer_fmu), "--output", str(tmp_path / "out")]


def refusal(capsys: pytest.CaptureFixture[str], command: list[str]) -> str:
    """What the command says on stderr, in one line beside the hint, where it ends in status 2."""
    began = time.monotonic()
    assert cli.main(command) == 2
    lines = [line for line in capsys.readouterr().err.splitlines() if not line.startswith("hint: ")]
    assert len(lines) == 1
    assert time.monotonic() - began < 60.0
    return lines[0]


def test_options_and_addresses(
    command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(remote, "PATIENCE", 0.5)
    (tmp_path / "no.pem").write_text("no certificate")
    bad = [str(tmp_path / "no.pem")] * 3
    options = ["--tls-ca-file", "--tls-cert", "--tls-key"]
    given = [word for pair in zip(options, bad, strict=True) for word in pair]
    encrypted = [*command, "--scheduler", f"tls://127.0.0.1:{free_port()}"]
    assert "are for --scheduler tls://host:port" in refusal(capsys, [*command, "--tls-key", "key.pem"])
    assert "--tls-ca-file FILE, or DASK_DISTRIBUTED__COMM__TLS__CA_FILE" in refusal(capsys, encrypted)
    assert "--tls-key FILE, or DASK_DISTRIBUTED__COMM__TLS__CLIENT__KEY" in refusal(capsys, [*encrypted, *given[:4]])
    assert "--tls-cert: there is no file nowhere.pem" in refusal(
        capsys, [*encrypted, *given, "--tls-cert", "nowhere.pem"]
    )
    assert "no Dask scheduler answers at 'tls://127.0.0.1:" in refusal(capsys, [*encrypted, *given])
    nobody = f"tcp://127.0.0.1:{free_port()}"
    assert f"no Dask scheduler answers at '{nobody}': " in refusal(capsys, [*command, "--scheduler", nobody])
    assert "no Dask scheduler answers" in refusal(capsys, [*command, "--scheduler", "tcp://nowhere.invalid:8786"])


@pytest.mark.full
def test_tcp_is_warned_of_once_and_one_that_says_nothing_does_not_hang(
    command: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(remote, "PATIENCE", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        address = f"tcp://127.0.0.1:{silent.getsockname()[1]}"
        assert cli.main([*command, "--scheduler", address]) == 2
    hint, error = capsys.readouterr().err.splitlines()
    assert hint.startswith(f"hint: whoever reaches {address} can run code there and here; ")
    assert error.startswith(f"hitch: no Dask scheduler answers at '{address}': timed out")


@pytest.mark.full
@pytest.mark.skipif(not shutil.which("openssl"), reason="no openssl to make certificates")
def test_a_cluster_with_certificates(
    command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """By options and by environment, the numbers are those of this machine alone; with others' certificates none."""
    ours, others = certificate(tmp_path / "ours"), certificate(tmp_path / "others")
    assert cli.main([*command, "--workers", "1"]) == 0
    store = tmp_path / "out" / "sweep.zarr"
    here = read_sweep(store).load()
    options_of = {one: documented(f".venv/bin/dask {one}") for one in ("scheduler", "worker")}
    with scheduler(ours, *options_of["scheduler"]) as address, worker(ours, address, *options_of["worker"][1:]):
        for options in (tls(ours), []):
            shutil.rmtree(store)
            capsys.readouterr()
            assert cli.main([*command, "--scheduler", address, *options]) == 0
            assert capsys.readouterr().err == ""
            xr.testing.assert_identical(read_sweep(store).load(), here)
            monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TLS__CA_FILE", str(ours / "cert.pem"))
            monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TLS__CLIENT__CERT", str(ours / "cert.pem"))
            monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TLS__CLIENT__KEY", str(ours / "key.pem"))
            remote.dask.config.refresh()
        shutil.rmtree(store)
        for options in (tls(others), [*tls(others), "--tls-ca-file", str(ours / "cert.pem")], tls(ours, others)):
            assert "no Dask scheduler answers at" in refusal(capsys, [*command, "--scheduler", address, *options])
        assert "no Dask scheduler answers at" in refusal(
            capsys, [*command, "--scheduler", address.replace("tls://", "tcp://")]
        )
    with scheduler(tmp_path) as address:
        tcp_only = [*command, "--scheduler", address.replace("tcp://", "tls://"), *tls(ours)]
        assert "no Dask scheduler answers at" in refusal(capsys, tcp_only)
    monkeypatch.undo()
    remote.dask.config.refresh()


@pytest.mark.full
def test_workers_that_are_not_like_this_machine(
    command: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    package = Path(remote.__file__).parents[1]
    (tmp_path / "without" / "overrun_hitch").mkdir(parents=True)
    gone = "raise ModuleNotFoundError(\"No module named 'overrun_hitch'\")"
    (tmp_path / "without" / "overrun_hitch" / "__init__.py").write_text(gone)
    other = shutil.copytree(package, tmp_path / "other" / "overrun_hitch", ignore=shutil.ignore_patterns("*.fmu"))
    with (other / "results.py").open("a") as file:
        file.write("# Another version.\n")
    with scheduler(tmp_path) as address:
        asked = [*command, "--scheduler", address]
        with worker(tmp_path, address, PYTHONPATH=str(tmp_path / "without")):
            assert "can't run overrun_hitch: ModuleNotFoundError" in refusal(capsys, asked)
        with worker(tmp_path, address, PYTHONPATH=str(tmp_path / "other")):
            assert "has another version of overrun_hitch; allowed: the same" in refusal(capsys, asked)
        with (
            worker(tmp_path, address),
            remote.connected(address) as client,
            pytest.raises(HitchError, match=r"the worker at tcp://.* has another version of overrun_hitch"),
        ):  # as one that comes when the others have been looked at
            client.submit(remote.run_here, "another version", len, []).result()
        monkeypatch.setattr(remote, "WORKERS_PATIENCE", 1.0)
        assert "has no workers after 1 s" in refusal(capsys, asked)
