"""Tables by the external functions of the Modelica Standard Library, against what its own C makes of them."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

import fmpy
import numpy as np
import pytest
from scipy.interpolate import Akima1DInterpolator

from fmu_build.errors import BuildError
from fmu_build.frontend.flatten import flatten
from fmu_build.frontend.splines import akima, cubics
from fmu_build.frontend.table_calls import with_calls_in_sums
from tests.fmu_build.conftest import Build, Writer
from tests.oracles.standard_tables.cases import POINTS, REPEATED, SHIFT, START, TIMES, VALUES, names, parts

RECORDED = Path(__file__).parents[2] / "oracles" / "standard_tables" / "values.csv"
# What the library's blocks declare, as far as it matters here.
BLOCKS = """package Blocks
  package Types
    class Curve
      extends ExternalObject;
      function constructor
        input String tableName;
        input String fileName;
        input Real table[:, :];
        input Integer columns[:];
        input Integer smoothness;
        input Integer extrapolation = 2;
        input Boolean verboseRead = true;
        output Curve made;
      external "C" made = ModelicaStandardTables_CombiTable1D_init2(
          fileName, tableName, table, size(table, 1), size(table, 2), columns, size(columns, 1), smoothness,
          extrapolation, verboseRead);
      end constructor;
      function destructor
        input Curve made;
      external "C" ModelicaStandardTables_CombiTable1D_close(made);
      end destructor;
    end Curve;
    class Course
      extends ExternalObject;
      function constructor
        input String tableName;
        input String fileName;
        input Real table[:, :];
        input Real startTime;
        input Integer columns[:];
        input Integer smoothness;
        input Integer extrapolation;
        input Real shiftTime = 0.0;
        input Integer timeEvents = 1;
        input Boolean verboseRead = true;
        output Course made;
      external "C" made = ModelicaStandardTables_CombiTimeTable_init2(
          fileName, tableName, table, size(table, 1), size(table, 2), startTime, columns, size(columns, 1),
          smoothness, extrapolation, shiftTime, timeEvents, verboseRead);
      end constructor;
      function destructor
        input Course made;
      external "C" ModelicaStandardTables_CombiTimeTable_close(made);
      end destructor;
    end Course;
  end Types;
  package Internal
    function length
      input String s;
      output Integer n;
    external "C" n = ModelicaStrings_length(s);
    end length;
    function getTable1DValue
      input Types.Curve tableID;
      input Integer icol;
      input Real u;
      output Real y;
    external "C" y = ModelicaStandardTables_CombiTable1D_getValue(tableID, icol, u);
    end getTable1DValue;
    function lowest
      input Types.Curve tableID;
      output Real u;
    external "C" u = ModelicaStandardTables_CombiTable1D_minimumAbscissa(tableID);
    end lowest;
    function getTimeTableValue "With the arguments in another order"
      input Integer icol;
      input Types.Course tableID;
      input Real t;
      input Real event;
      input Real before;
      output Real y;
    external "C" y = ModelicaStandardTables_CombiTimeTable_getValue(tableID, icol, t, event, before);
    end getTimeTableValue;
    function nextEvent
      input Types.Course tableID;
      input Real t;
      output Real event;
    external "C" event = ModelicaStandardTables_CombiTimeTable_nextTimeEvent(tableID, t);
    end nextEvent;
  end Internal;
  block Curve
    parameter Boolean tableOnFile = false;
    parameter String tableName = "NoName";
    parameter Real table[:, :];
    parameter Integer columns[:] = 2:size(table, 2);
    parameter Integer smoothness = 1;
    parameter Integer extrapolation = 2;
    final parameter Boolean isLong = if tableOnFile then Internal.length(tableName) > 6 else false;
    parameter Types.Curve tableID = Types.Curve(
      if tableOnFile then if isLong then "Values" else tableName else "NoName", "NoName", table, columns,
      smoothness, extrapolation, if tableOnFile then true else false);
    final parameter Real u_min = Internal.lowest(tableID);
    Real u;
    Real y;
  equation
    y = Internal.getTable1DValue(tableID, 1, u);
  end Curve;
  block Course
    parameter Real table[:, :];
    parameter Integer columns[:] = 2:size(table, 2);
    parameter Integer smoothness = 1;
    parameter Integer extrapolation = 2;
    parameter Integer timeEvents = 1;
    parameter Real timeScale = 1;
    parameter Real startTime = 0;
    parameter Real shiftTime = startTime;
    parameter Types.Course tableID = Types.Course("NoName", "NoName", table, startTime/timeScale, columns, smoothness,
      extrapolation, shiftTime/timeScale, timeEvents, false);
    discrete Real nextTimeEvent(start = 0, fixed = true);
    discrete Real nextTimeEventScaled(start = 0, fixed = true);
    Real timeScaled;
    Real y;
  equation
    timeScaled = time/timeScale;
    y = Internal.getTimeTableValue(1, tableID, timeScaled, nextTimeEventScaled, pre(nextTimeEventScaled));
    when {time >= pre(nextTimeEvent), initial()} then
      nextTimeEventScaled = Internal.nextEvent(tableID, timeScaled);
      nextTimeEvent = if nextTimeEventScaled < 1e60 then nextTimeEventScaled*timeScale else 1e60;
    end when;
  end Course;
  block TimeTable
    parameter Real table[:, 2];
    parameter Real timeScale = 1;
    parameter Real offset = 0;
    parameter Real startTime = 0;
    parameter Real shiftTime = startTime;
    discrete Real a;
    discrete Real b;
    Integer last(start = 1);
    discrete Real nextEvent(start = 0, fixed = true);
    discrete Real nextEventScaled(start = 0, fixed = true);
    Real timeScaled;
    Real y;
    function getInterpolationCoefficients
      input Real table[:, 2];
      input Real offset;
      input Real startTimeScaled;
      input Real timeScaled;
      input Integer last;
      input Real TimeEps;
      input Real shiftTimeScaled;
      output Real a;
      output Real b;
      output Real nextEventScaled;
      output Integer next;
    algorithm
      next := last;
      while next < size(table, 1) and timeScaled >= table[next, 1] loop
        next := next + 1;
      end while;
      a := 0;
      b := 0;
      nextEventScaled := 0;
    end getInterpolationCoefficients;
  algorithm
    when {time >= pre(nextEvent), initial()} then
      (a, b, nextEventScaled, last) := getInterpolationCoefficients(table, offset, startTime/timeScale, timeScaled,
        last, 1e-13, shiftTime/timeScale);
      nextEvent := nextEventScaled*timeScale;
    end when;
  equation
    timeScaled = time/timeScale;
    y = a*timeScaled + b;
  end TimeTable;
end Blocks;
"""


def rows(points: list[float]) -> str:
    return f"[{'; '.join(f'{x}, {y}' for x, y in zip(points, VALUES, strict=True))}]"


def model(chosen: Sequence[str], scale: float) -> str:
    """Tables of cases.py; their time is the model's by ``scale``."""
    lines = [BLOCKS, "model M"]
    for name in chosen:
        kind, smoothness, extrapolation, events = parts(name)
        given = f"smoothness={smoothness}, extrapolation={extrapolation}"
        if kind == "curve":
            lines.append(f"  Blocks.Curve {name}(table={rows(POINTS)}, {given}, u=time/{scale} - 5.033);")
        else:
            points = REPEATED if smoothness in {1, 3} else POINTS
            given += f", timeEvents={events}, startTime={START * scale}, shiftTime={SHIFT * scale}, timeScale={scale}"
            lines.append(f"  Blocks.Course {name}(table={rows(points)}, {given});")
    return "\n".join([*lines, "end M;\n"])


@pytest.mark.parametrize(
    ("every", "scale", "fmi", "kind"),
    [
        (6, 1.0, 2, "CoSimulation"),
        pytest.param(1, 1.0, 2, "CoSimulation", marks=pytest.mark.full),
        pytest.param(1, 60.0, 3, "CoSimulation", marks=pytest.mark.full),
        pytest.param(1, 1.0, 2, "ModelExchange", marks=pytest.mark.full),
    ],
)
def test_as_the_library_computes_it(every: int, scale: float, fmi: int, kind: str, built: Build) -> None:
    chosen = [*names()][::every]
    with RECORDED.open(encoding="ascii") as file:
        recorded = list(csv.DictReader(file))
    times = np.array(TIMES) * scale
    result = fmpy.simulate_fmu(
        str(built(model(chosen, scale), fmi)),
        stop_time=times[-1],
        output_interval=0.01 * scale,
        fmi_type=kind,
        relative_tolerance=1e-8,
        output=[f"{name}.y" for name in chosen],
        record_events=False,
    )
    at = np.abs(result["time"][:, None] - times).argmin(axis=0)
    assert np.abs(result["time"][at] - times).max() < 1e-9 * scale
    for name in chosen:
        expected = [float(row[name]) for row in recorded]
        np.testing.assert_allclose(result[f"{name}.y"][at], expected, rtol=0, atol=1e-9, err_msg=name)


def test_akima_as_scipy_has_it() -> None:
    generator = np.random.default_rng(1)
    x = np.cumsum(generator.uniform(0.1, 2, 12))
    y = generator.normal(size=12)
    other = Akima1DInterpolator(x, y)
    for i, (a, b, c) in enumerate(cubics(x.tolist(), y.tolist(), akima(x.tolist(), y.tolist()))):
        np.testing.assert_allclose([a, b, c, y[i]], other.c[:, i], rtol=1e-9, atol=1e-12)


def test_values_of_straight_lines_can_be_set_and_jumps_are_events(built: Build) -> None:
    """The integral of a course that jumps, to rounding: no step crosses a point."""
    text = (
        f"{BLOCKS}model M\n  Blocks.Course c(table=[0, 1; 1, 1; 1, 3; 2, 5]);\n  output Real x(start=0, fixed=true);\n"
    )
    fmu = built(f"{text}equation\n  der(x) = c.y;\nend M;\n", 2)
    for top in (5.0, 7.0):
        result = fmpy.simulate_fmu(str(fmu), stop_time=2, start_values={"c.table[4,2]": top}, output=["x", "c.y"])
        assert result["x"][-1] == pytest.approx(1 + (3 + top) / 2, abs=1e-12)


def test_a_parameter_bound_to_a_value_of_a_table(modelica_file: Writer) -> None:
    """rumoca takes it for an array, as it stands."""
    text = f"""{BLOCKS}model M
  parameter Blocks.Types.Curve c = Blocks.Types.Curve("NoName", "NoName", [0, 3; 1, 4], {{2}}, 1);
  parameter Real k = Blocks.Internal.getTable1DValue(c, 1, 0)
    "Used in two equations";
  Real x(start=0, fixed=true);
  Real y;
equation
  y = k*x;
  der(x) = k*time;
end M;
"""
    model = flatten(modelica_file(text), "M")
    assert {v.name: v.binding for v in model.variables}["k"] == 3
    assert [equation.origin for equation in model.equations] == [f"M.mo:{text.count(chr(10)) - n}" for n in (2, 1)]


@pytest.mark.parametrize(
    "text",
    [
        'Real a =\n    if b then getTable1DValue(t, 1, 0)\n    else getTimeTableValue(t, 1, 0, 0, 0)\n    "x";',
        "Real a = getTable1DValueNoDer2(t, 1, u)   ;",
    ],
)
def test_places_stay_what_they_are(text: str) -> None:
    changed = with_calls_in_sums(text)
    assert changed.count(")+0") == text.count("getT")
    assert len(changed) == len(text) and changed.count("\n") == text.count("\n")
    assert changed.replace("+0", "").split() == text.split()


@pytest.mark.parametrize("scale", [1.0, 60.0])
def test_time_table(scale: float, built: Build) -> None:
    """The example of the library's documentation; later, in another unit, and shifted."""
    table = "table=[0, 0; 1, 0; 1, 1; 2, 4; 3, 9; 4, 16]"
    given = f"timeScale={scale}, offset=7, startTime={0.5 * scale}, shiftTime={-0.25 * scale}"
    text = f"{BLOCKS}model M\n  Blocks.TimeTable t({table});\n  Blocks.TimeTable u({table}, {given});\nend M;\n"
    fmu = built(text, 2)
    result = fmpy.simulate_fmu(str(fmu), stop_time=5 * scale, output_interval=0.1 * scale, output=["t.y", "u.y"])
    at, inside = result["time"], result["time"] < 5

    def line(time: float) -> float:
        found = np.interp(time, [0, 1, 1 + 1e-12, 2, 3, 4, 5], [0, 0, 1, 4, 9, 16, 23])
        return float(found)

    for time, value in zip(at[inside], result["t.y"][inside], strict=True):
        assert value == pytest.approx(line(time), abs=1e-9) or abs(time - 1) < 1e-9
    for time, value in zip(at / scale, result["u.y"], strict=True):
        right = 7 + line(time + 0.25) if time + 0.25 < 5 else 7 + 23 + 7 * (time - 4.75)
        assert value == pytest.approx(7 if time < 0.5 else right, abs=1e-9) or abs(time - 0.5) < 1e-9


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        (
            'parameter Blocks.Types.Curve c = Blocks.Types.Curve("t", "NoName", [0, 1; 1, 2], {2}, 1);'
            " Real y = Blocks.Internal.getTable1DValue(c, 1, time)",
            "a table (read )?from a file",
        ),
        ("Blocks.Curve c(table=[0, 1; 0, 2], u=time)", "the first column of a table has to increase: it is 0, 0"),
        ("Blocks.Course c(table=[0, 1; 1, 2; 1, 3], smoothness=2)", "has to increase: it is 0, 1, 1"),
        ('Integer n = Blocks.Internal.length("abc")', "Blocks.Internal.length is an external function|Literal"),
    ],
)
def test_what_is_refused(declared: str, message: str, modelica_file: Writer) -> None:
    with pytest.raises(BuildError, match=rf"M\.mo:\d+: .*{message}"):
        flatten(modelica_file(f"{BLOCKS}model M\n  {declared};\nend M;\n"), "M")
