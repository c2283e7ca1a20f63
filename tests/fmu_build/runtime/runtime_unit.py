"""Compile the runtime with a hand-written model and drive it through its FMI 2.0 functions."""

from __future__ import annotations

import ctypes as ct
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fmu_build.fmu.compile import HEADERS, OPTIONS, RUNTIME, SHARED, compiler
from tests.fmu_build.runtime.hand_written import TOKEN, Model
from tests.kept import kept

HERE = Path(__file__).parent
FLAGS = [*OPTIONS, *SHARED, "-O1", "-Werror"]
OK, WARNING, DISCARD, ERROR = range(4)

LOGGER = ct.CFUNCTYPE(None, ct.c_void_p, ct.c_char_p, ct.c_int, ct.c_char_p, ct.c_char_p, ct.c_char_p)
ALLOCATE = ct.CFUNCTYPE(ct.c_void_p, ct.c_size_t, ct.c_size_t)
FREE = ct.CFUNCTYPE(None, ct.c_void_p)


class Callbacks(ct.Structure):
    _fields_ = [
        ("logger", LOGGER),
        ("allocate", ALLOCATE),
        ("free", FREE),
        ("step_finished", ct.c_void_p),
        ("environment", ct.c_void_p),
    ]


@dataclass(frozen=True)
class Library:
    """A compiled model."""

    model: Model
    path: Path
    dll: ct.CDLL


@dataclass(frozen=True)
class Counters:
    steps: int
    rejected: int
    repeated: int
    evaluations: int
    jacobians: int
    events: int


class Unit:
    """An instance. Its methods return the FMI status; `log` collects (category, message)."""

    def __init__(
        self,
        library: Library,
        *,
        logging: bool = False,
        name: bytes = b"unit",
        token: str = TOKEN,
        exchange: bool = False,
    ) -> None:
        self.library = library
        self.dll = library.dll
        self.references = library.model.references()
        self.log: list[tuple[str, str]] = []
        self.time = 0.0

        def log(_env: object, _name: bytes, _status: int, category: bytes, form: bytes, text: bytes) -> None:
            assert form == b"%s"
            self.log.append((category.decode(), text.decode()))

        self.callbacks = Callbacks(LOGGER(log))
        self.component = self.dll.fmi2Instantiate(
            name, 0 if exchange else 1, token.encode(), None, ct.byref(self.callbacks), 0, int(logging)
        )

    def call(self, function: str, *arguments: object) -> int:
        return int(getattr(self.dll, function)(ct.c_void_p(self.component), *arguments))

    def setup(self, tolerance: float | None = None, start: float = 0.0, stop: float | None = None) -> int:
        self.time = start
        return self.call(
            "fmi2SetupExperiment",
            int(tolerance is not None),
            ct.c_double(tolerance or 0.0),
            ct.c_double(start),
            int(stop is not None),
            ct.c_double(stop or 0.0),
        )

    def initialize(self) -> int:
        return max(self.call("fmi2EnterInitializationMode"), self.call("fmi2ExitInitializationMode"))

    def set(self, **values: float) -> int:
        n = len(values)
        return self.call(
            "fmi2SetReal",
            (ct.c_uint * max(n, 1))(*[self.references[name] for name in values]),
            ct.c_size_t(n),
            (ct.c_double * max(n, 1))(*values.values()),
        )

    def get_status(self, *names: str) -> tuple[int, np.ndarray]:
        n = len(names)
        values = (ct.c_double * max(n, 1))()
        status = self.call(
            "fmi2GetReal", (ct.c_uint * max(n, 1))(*[self.references[name] for name in names]), ct.c_size_t(n), values
        )
        return status, np.array(values[:n])

    def get(self, *names: str) -> np.ndarray:
        status, values = self.get_status(*names)
        assert status == OK, self.log
        return values

    def directional(self, unknown: list[str], known: list[str], seed: np.ndarray) -> tuple[int, np.ndarray]:
        to, of = ((ct.c_uint * len(names))(*[self.references[n] for n in names]) for names in (unknown, known))
        result = (ct.c_double * len(unknown))()
        sizes = [ct.c_size_t(len(names)) for names in (unknown, known)]
        status = self.call(
            "fmi2GetDirectionalDerivative", to, sizes[0], of, sizes[1], (ct.c_double * len(known))(*seed), result
        )
        return status, np.array(result)

    def slopes(self, order: int = 1, **values: float) -> int:
        n = len(values)
        return self.call(
            "fmi2SetRealInputDerivatives",
            (ct.c_uint * n)(*[self.references[name] for name in values]),
            ct.c_size_t(n),
            (ct.c_int * n)(*[order] * n),
            (ct.c_double * n)(*values.values()),
        )

    def output_slopes(self, *names: str, order: int = 1) -> tuple[int, np.ndarray]:
        n = len(names)
        values = (ct.c_double * n)()
        references = (ct.c_uint * n)(*[self.references[name] for name in names])
        orders = (ct.c_int * n)(*[order] * n)
        status = self.call("fmi2GetRealOutputDerivatives", references, ct.c_size_t(n), orders, values)
        return status, np.array(values)

    def save(self, snapshot: ct.c_void_p | None = None) -> ct.c_void_p:
        snapshot = ct.c_void_p() if snapshot is None else snapshot
        assert self.call("fmi2GetFMUstate", ct.byref(snapshot)) == OK
        return snapshot

    def restore(self, snapshot: ct.c_void_p) -> int:
        status = self.call("fmi2SetFMUstate", snapshot)
        if status == OK and self.call("fmi2GetRealStatus", 2, ct.byref(value := ct.c_double())) == OK:
            self.time = value.value
        return status

    def drop(self, snapshot: ct.c_void_p) -> None:
        assert self.call("fmi2FreeFMUstate", ct.byref(snapshot)) == OK
        assert not snapshot

    def serialize(self, snapshot: ct.c_void_p) -> bytes:
        size = ct.c_size_t()
        assert self.call("fmi2SerializedFMUstateSize", snapshot, ct.byref(size)) == OK
        buffer = ct.create_string_buffer(size.value)
        assert self.call("fmi2SerializeFMUstate", snapshot, buffer, size) == OK
        return buffer.raw

    def deserialize(self, data: bytes) -> tuple[int, ct.c_void_p]:
        snapshot = ct.c_void_p()
        status = self.call("fmi2DeSerializeFMUstate", data, ct.c_size_t(len(data)), ct.byref(snapshot))
        return status, snapshot

    def step(self, size: float, time: float | None = None) -> int:
        start = self.time if time is None else time
        status = self.call("fmi2DoStep", ct.c_double(start), ct.c_double(size), 1)
        if status == OK:
            self.time = start + size
        return status

    def run(self, end: float, size: float, names: list[str]) -> np.ndarray:
        """Rows of values at the communication points; from the current time to end in equal steps."""
        n = round((end - self.time) / size)
        start = self.time
        rows = [self.get(*names)]
        for i in range(n):
            begin = start + i * size
            assert self.step(start + (i + 1) * size - begin, begin) == OK, self.log
            rows.append(self.get(*names))
        return np.array(rows)

    def counters(self) -> Counters:
        numbers = (ct.c_int64 * 6)()
        self.dll.probe_counters(ct.c_void_p(self.component), numbers)
        return Counters(*numbers)

    def state(self) -> bytes:
        buffer = ct.create_string_buffer(self.dll.probe_state_size())
        self.dll.probe_state(ct.c_void_p(self.component), buffer)
        return buffer.raw

    def messages(self, category: str = "logStatusError") -> list[str]:
        return [text for c, text in self.log if c == category]

    def event_times(self) -> list[tuple[str, float]]:
        return [
            (text.split(" at t = ")[0], float(text.split(" at t = ")[1].split()[0]))
            for text in self.messages("logEvents")
        ]

    def free(self) -> None:
        if self.component:
            self.dll.fmi2FreeInstance(self.component)
            self.component = None


def compile_sources(model: Model, fmi: int, flags: Sequence[str], extra: str) -> Path:
    """The runtime with one facade and the model, as one unit, and one more file of this folder."""
    other = {2: "fmi3", 3: "fmi2"}[fmi]
    runtime = [file for file in sorted(RUNTIME.rglob("*.c")) if file.parent.name != other]
    files = model.files()

    def make(folder: Path) -> None:
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        sources = [*runtime, *sorted(folder.glob("*.c"))]
        (folder / "unit.c").write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
        folders = [f"-I{part}" for part in (folder, HERE, RUNTIME, *RUNTIME.iterdir()) if part.is_dir()]
        command = [
            *compiler(),
            *flags,
            *folders,
            f"-isystem{HEADERS / f'fmi{fmi}'}",
            str(folder / "unit.c"),
            str(HERE / extra),
        ]
        subprocess.run([*command, "-o", str(folder / model.name), "-lm"], check=True)

    drivers = [path.read_text(encoding="utf-8") for path in sorted(HERE.glob("*.[ch]"))]
    inputs = (extra, str(fmi), *flags, model.name, *drivers, *map(str, sorted(files.items())))
    return kept(make, "model with the runtime", *inputs) / model.name


def load(path: Path) -> ct.CDLL:
    """A library with the FMI 2.0 facade."""
    dll = ct.CDLL(str(path))
    dll.fmi2Instantiate.restype = ct.c_void_p
    dll.fmi2Instantiate.argtypes = [ct.c_char_p, ct.c_int, ct.c_char_p, ct.c_char_p, ct.c_void_p, ct.c_int, ct.c_int]
    dll.probe_state_size.restype = ct.c_size_t
    dll.fmi2FreeInstance.argtypes = [ct.c_void_p]
    dll.fmi2FreeInstance.restype = None
    return dll


def compile_model(model: Model, fmi: int = 2) -> Library:
    path = compile_sources(model, fmi, FLAGS, "probe.c")
    return Library(model, path, load(path) if fmi == 2 else ct.CDLL(str(path)))
