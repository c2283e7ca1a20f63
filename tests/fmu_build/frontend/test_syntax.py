"""Declarations read from the text are those that rumoca finds."""

from __future__ import annotations

from pathlib import Path

from fmu_build.frontend.loading import load
from fmu_build.frontend.syntax import ClassText, read_classes

TRICKY = """// model No end No;
within A.B;
package P "a; model No" /* end P; */
  import C.D; import E = F.G; import H.*; import I.{J, K};
  model M "it's" extends Q(r(start=1, each s = f(a=2, b={3, 4})), final t.u=-1.5e-3);
    replaceable parameter .R.S 'x;y'[2](min=0) = {1, if true then 2 else 3} if not false constrainedby T(v=w) "text";
    input Real a, b[3](each start=0);
  protected
    replaceable model N = O(redeclare replaceable model U = V(k=1) constrainedby W(k=2), redeclare X y = z);
    type L = enumeration(one "1", two);
    record Z = U.Y;
  initial equation
    a = b[1];
  equation
    for i in 1:3 loop if i > 1 then b[i] = 1; else b[i] = 2; end if; end for;
    annotation(Icon(graphics={Text(textString="end M;")}));
  end M;
  function f input Real u; output Real y; external "C" y = g(u); end f;
  operator record Complex Real re; end Complex;
end P;
"""


def test_what_confuses_a_scanner() -> None:
    classes = {read.name.removeprefix("A.B."): read for read in read_classes(TRICKY)}
    assert list(classes) == ["P", "P.M", "P.M.N", "P.M.L", "P.M.Z", "P.f", "P.Complex"]
    model, short = classes["P.M"], classes["P.M.N"]
    assert classes["P"].imports == {"D": "C.D", "E": "F.G", "*2": "H", "J": "I.J", "K": "I.K"}
    assert (model.bases, short.bases, classes["P.M.Z"].bases) == (["Q"], ["O"], ["U.Y"])
    assert model.components == [("'x;y'", ".R.S"), ("a", "Real"), ("b", "Real")]
    assert given(model) == {
        "r.start": "1",
        "r.s": "f(a=2, b={3, 4})",
        "t.u": "-1.5e-3",
        "'x;y'.min": "0",
        "'x;y'.v": "w",
        "b.start": "0",
    }
    assert given(short) == {"=U.k": "2", "y": "z"} and short.is_short
    assert [(m.path, text_of(m.value)) for m in short.redeclared] == [(("y",), "y")]
    assert classes["P.Complex"].components == [("re", "Real")]


def given(read: ClassText) -> dict[str, str]:
    return {".".join(modifier.path): text_of(modifier.value) for modifier in read.modifiers}


def text_of(span: tuple[int, int]) -> str:
    return TRICKY.encode()[slice(*span)].decode()


def test_components_are_those_of_rumoca(modelica_library: Path) -> None:
    flat, sources = load(modelica_library, "OverrunHitch.Systems.CarTrailer")
    texts = sources.texts_by_number().values()
    read = {found.name: found for text in texts for found in read_classes(text)}["OverrunHitch.Systems.CarTrailer"]
    names = [name.partition(".")[0] for name in flat["variables"]]
    assert {name for name, _ in read.components} == set(names)
