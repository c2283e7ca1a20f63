"""A Dask scheduler that runs elsewhere: reached, by TLS if it is asked for, and its workers like this machine."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypeVar
from urllib.parse import urlsplit

import dask
from distributed import Client, Security, get_worker
from distributed.comm import connect
from distributed.utils import LoopRunner

from overrun_hitch.parameters import HitchError

PATIENCE = 10.0  # s, for a scheduler to answer
WORKERS_PATIENCE = 60.0  # s, for its first worker
CERTIFICATES = {  # Dask's names for what a client of a scheduler has, in its configuration and its environment
    "ca_file": "distributed.comm.tls.ca-file",
    "cert": "distributed.comm.tls.client.cert",
    "key": "distributed.comm.tls.client.key",
}
OTHER_VERSION = "has another version of overrun_hitch; allowed: the same as on this machine"

Result = TypeVar("Result")


def is_encrypted(scheduler: str) -> bool:
    """Whether the address is tls:// rather than tcp://. HitchError for one that is not possible."""
    try:
        address = urlsplit(scheduler)
        possible = address.scheme in ("tls", "tcp") and address.hostname and address.port and not address.path
    except ValueError:
        possible = False
    if not possible:
        raise HitchError(f"scheduler = {scheduler!r:.80} is not allowed; allowed: tls://host:port or tcp://host:port")
    return address.scheme == "tls"


@contextmanager
def certificates(**files: Path | None) -> Iterator[None]:
    """For a while the given of `ca_file`, `cert` and `key` (PEM) instead of those in Dask's configuration."""
    with dask.config.set({CERTIFICATES[name]: str(file) for name, file in files.items() if file}):
        yield


@contextmanager
def connected(scheduler: str) -> Iterator[Client]:
    """A client of the scheduler at this address, which has workers with this version of this package. HitchError."""
    security = _security() if is_encrypted(scheduler) else None
    try:
        # A client of Dask waits for ever for what takes its call and then says nothing.
        LoopRunner().run_sync(_call, scheduler, security, callback_timeout=PATIENCE + 1.0)
        client = Client(scheduler, timeout=PATIENCE, set_as_default=False, security=security)
    except (OSError, ValueError, TimeoutError) as error:
        raise HitchError(f"no Dask scheduler answers at {scheduler!r:.80}: {_reason(error)}") from None
    with client:
        _check_workers(client, scheduler)
        yield client


def run_here(version: str, task: Callable[..., Result], *arguments: Any) -> Result:
    """The task on a worker, which may have come late, if the worker has this version(). HitchError."""
    if version != own_version():
        raise HitchError(f"the worker at {get_worker().address} {OTHER_VERSION}")
    return task(*arguments)


@cache
def own_version() -> str:
    """The version of this package where it is called: a checksum of its sources, which change between releases too."""
    folder = Path(__file__).parents[1]
    sources = sorted((path.relative_to(folder).as_posix(), path.read_bytes()) for path in folder.rglob("*.py"))
    return hashlib.sha256(repr(sources).encode()).hexdigest()


def _security() -> Security:
    security = Security(require_encryption=True)
    found = security.get_tls_config_for_role("client")
    for name, setting in CERTIFICATES.items():
        file = found[name]
        option = f"--tls-{name.replace('_', '-')}"
        if file is None:
            variable = f"DASK_{setting.replace('.', '__').replace('-', '_').upper()}"
            raise HitchError(f"a scheduler at tls:// needs certificates: {option} FILE, or {variable}")
        if not Path(file).is_file():
            raise HitchError(f"{option}: there is no file {file}")
    return security


async def _call(scheduler: str, security: Security | None) -> None:
    arguments = security.get_connection_args("client") if security else {}
    comm = await connect(scheduler, timeout=PATIENCE, **arguments)
    await comm.close()


def _check_workers(client: Client, scheduler: str) -> None:
    try:
        client.wait_for_workers(1, timeout=WORKERS_PATIENCE)
    except TimeoutError:
        raise HitchError(f"the scheduler at {scheduler} has no workers after {WORKERS_PATIENCE:g} s") from None
    for address, found in client.run(own_version, on_error="return").items():
        if isinstance(found, Exception):
            raise HitchError(f"the worker at {address} can't run overrun_hitch: {found}")
        if found != own_version():
            raise HitchError(f"the worker at {address} {OTHER_VERSION}")


def _reason(error: BaseException | None) -> str:
    """What the first of the errors that led to this one says; Dask wraps them, and some say nothing."""
    reason = ""
    while error:
        reason = getattr(error, "strerror", None) or str(error) or reason
        error = error.__cause__
    return reason
