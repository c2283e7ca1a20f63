"""What the Modelica Standard Library's own C makes of tables.

    python -m tests.oracles.standard_tables.record SOURCES            writes values.csv beside this file

SOURCES is the folder Modelica/Resources/C-Sources of the library (recorded with 4.2.0 dev, commit b756f9d). The tables
and the times are those of ``cases.py``.
"""

from __future__ import annotations

import csv
import ctypes
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from .cases import POINTS, REPEATED, SHIFT, START, TIMES, VALUES, curve, names, parts

STUBS = """
#include <stdlib.h>
#include <string.h>
int usertab(char *name, int n, int *dimensions, double **table) { return !name || !n || !dimensions || !table; }
void ModelicaError(const char *s) { (void)s; }
void ModelicaFormatError(const char *s, ...) { (void)s; }
void ModelicaMessage(const char *s) { (void)s; }
void ModelicaFormatMessage(const char *s, ...) { (void)s; }
void ModelicaWarning(const char *s) { (void)s; }
void ModelicaFormatWarning(const char *s, ...) { (void)s; }
char *ModelicaAllocateString(size_t n) { return calloc(n + 1, 1); }
char *ModelicaAllocateStringWithErrorReturn(size_t n) { return calloc(n + 1, 1); }
char *ModelicaDuplicateString(const char *s) { return strdup(s); }
char *ModelicaDuplicateStringWithErrorReturn(const char *s) { return strdup(s); }
"""


def main(sources: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        stubs, library = Path(folder) / "stubs.c", Path(folder) / "tables.so"
        stubs.write_text(STUBS, encoding="ascii")
        files = [str(sources / "ModelicaStandardTables.c"), str(stubs)]
        command = ["cc", "-shared", "-fPIC", "-DNO_FILE_SYSTEM", f"-I{sources}", *files]
        subprocess.run([*command, "-o", str(library), "-lm"], check=True)
        tables = ctypes.CDLL(str(library))
    for kind in ("CombiTimeTable", "CombiTable1D"):
        getattr(tables, f"ModelicaStandardTables_{kind}_init3").restype = ctypes.c_void_p
        getattr(tables, f"ModelicaStandardTables_{kind}_getValue").restype = ctypes.c_double
    tables.ModelicaStandardTables_CombiTimeTable_nextTimeEvent.restype = ctypes.c_double
    columns = {name: list(values(tables, name)) for name in names()}
    with (Path(__file__).parent / "values.csv").open("w", encoding="ascii", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time", *columns])
        writer.writerows([f"{x:.12g}" for x in row] for row in zip(TIMES, *columns.values(), strict=True))


def values(tables: ctypes.CDLL, name: str) -> Iterator[float]:
    """A column: the values of a table at all times."""
    kind, smoothness, extrapolation, events = parts(name)
    points = REPEATED if kind == "time" and smoothness in {1, 3} else POINTS
    data = (ctypes.c_double * (2 * len(points)))(*(x for pair in zip(points, VALUES, strict=True) for x in pair))
    column = (ctypes.c_int * 1)(2)
    size, number = ctypes.c_size_t, ctypes.c_double
    given = (b"NoName", b"NoName", data, size(len(points)), size(2))
    if kind == "curve":
        made = tables.ModelicaStandardTables_CombiTable1D_init3(
            *given, column, size(1), smoothness, extrapolation, 0, b",", 0
        )
        for time in TIMES:
            yield tables.ModelicaStandardTables_CombiTable1D_getValue(ctypes.c_void_p(made), 1, number(curve(time)))
        return
    made = tables.ModelicaStandardTables_CombiTimeTable_init3(
        *given, number(START), column, size(1), smoothness, extrapolation, number(SHIFT), events, 0, b",", 0
    )
    table = ctypes.c_void_p(made)
    event = tables.ModelicaStandardTables_CombiTimeTable_nextTimeEvent(table, number(TIMES[0]))
    for time in TIMES:
        while time >= event:
            event = tables.ModelicaStandardTables_CombiTimeTable_nextTimeEvent(table, number(event))
        yield tables.ModelicaStandardTables_CombiTimeTable_getValue(
            table, 1, number(time), number(event), number(event)
        )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
