"""Options of the commands that may run on a cluster, and what they mean."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from overrun_hitch.parameters import HitchError

SchedulerOption = Annotated[
    str | None, typer.Option(metavar="ADDRESS", help="A running Dask scheduler (tls://host:8786).")
]
CaFileOption = Annotated[
    Path | None, typer.Option("--tls-ca-file", metavar="FILE", help="For tls://, who signs its certificates (PEM).")
]
CertOption = Annotated[Path | None, typer.Option("--tls-cert", metavar="FILE", help="For tls://, our certificate.")]
KeyOption = Annotated[Path | None, typer.Option("--tls-key", metavar="FILE", help="For tls://, its key.")]
WorkersOption = Annotated[int | None, typer.Option(help="Processes on this machine (one for each core).")]


@contextmanager
def access(scheduler: str | None, ca_file: Path | None, cert: Path | None, key: Path | None) -> Iterator[None]:
    """To the scheduler with these certificates, while it lasts; says on stderr what stands open. HitchError."""
    from overrun_hitch.sweeps import remote

    encrypted = scheduler is not None and remote.is_encrypted(scheduler)
    if (ca_file or cert or key) and not encrypted:
        raise HitchError("--tls-ca-file, --tls-cert and --tls-key are for --scheduler tls://host:port")
    if scheduler is not None and not encrypted:
        print(
            f"hint: whoever reaches {scheduler} can run code there and here; docs/sweep.md says how to use tls://",
            file=sys.stderr,
        )
    with remote.certificates(ca_file=ca_file, cert=cert, key=key):
        yield
