"""FMUs like ours but for what they do to their process: our library behind one that does it and then calls ours."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest

from fmu_build.fmu.compile import compiler

SOURCE = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

typedef int SetReal(void *, const unsigned *, size_t, const double *);
typedef int GetReal(void *, const unsigned *, size_t, double *);
typedef int DoStep(void *, double, double, int);
typedef void Free(void *);

int fmi2SetReal(void *unit, const unsigned *names, size_t n, const double *values)
{
    double changed[n + 1];
    for (size_t i = 0; i < n; i++) {
        double k = values[i];
        if (names[i] == {k}) {
            {set_k}
        }
        changed[i] = k;
    }
    return ((SetReal *)dlsym(RTLD_NEXT, "fmi2SetReal"))(unit, names, n, changed);
}

int fmi2DoStep(void *unit, double time, double step, int keep)
{
    double C;
    const unsigned name = {C};
    ((GetReal *)dlsym(RTLD_NEXT, "fmi2GetReal"))(unit, &name, 1, &C);
    {do_step}
    return ((DoStep *)dlsym(RTLD_NEXT, "fmi2DoStep"))(unit, time, step, keep);
}

int fmi2GetReal(void *unit, const unsigned *names, size_t n, double *values)
{
    int status = ((GetReal *)dlsym(RTLD_NEXT, "fmi2GetReal"))(unit, names, n, values);
    {get}
    return status;
}

void fmi2FreeInstance(void *unit)
{
    {free}
    ((Free *)dlsym(RTLD_NEXT, "fmi2FreeInstance"))(unit);
}
"""

HANGS, ABORTS, FAULTS, EXITS = "for (;;) { }", "abort();", "*(volatile int *)0 = 1;", "exit(3);"
ALLOCATES = """
    struct rlimit gibibyte = {1u << 30, 1u << 30};
    setrlimit(RLIMIT_AS, &gibibyte);
    for (;;)
        memset(malloc(1 << 24), 1, 1 << 24);
"""


def stranger(fmu: Path, made: Path, *, set_k: str = "", do_step: str = "", get: str = "", free: str = "") -> Path:
    """`made`, which is `fmu` with this C in its calls: set_k sees k, do_step C (parameters), get the `values`."""
    if not sys.platform.startswith("linux"):
        pytest.skip("libraries that stand in for others are made for Linux")
    description = fmpy.read_model_description(str(fmu))
    text = SOURCE
    for name in ("k", "C"):
        (reference,) = (one.valueReference for one in description.modelVariables if one.name == name)
        text = text.replace(f"{{{name}}}", str(reference))
    for name, code in {"set_k": set_k, "do_step": do_step, "get": get, "free": free}.items():
        text = text.replace(f"{{{name}}}", code)
    folder = made.parent / f"{made.stem}-binaries"
    folder.mkdir()
    library = f"binaries/{fmpy.platform}/{description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
    real, source, front = folder / "libreal.so", folder / "front.c", folder / "front.so"
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(made, "w") as new:
        real.write_bytes(old.read(library))
        source.write_text(text)
        options = ["-shared", "-fPIC", "-w", f"-L{folder}", "-Wl,--no-as-needed", "-lreal", "-Wl,-rpath,$ORIGIN"]
        subprocess.run([*compiler(), str(source), "-o", str(front), *options, "-ldl"], check=True)
        new.write(real, str(Path(library).with_name("libreal.so")))
        new.write(front, library)
        new.writestr("modelDescription.xml", old.read("modelDescription.xml"))
    return made
