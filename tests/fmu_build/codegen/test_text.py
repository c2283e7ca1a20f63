"""Whatever a text of a model contains, C reads it as that text, in a comment as nothing, and a name as a name."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_build.codegen.text import comment, function, identifiers, string
from fmu_build.fmu.compile import compiler

NASTY = [
    "*/",
    "/*",
    "??/",
    "??!",
    "\\",
    '"',
    "\n",
    "%s",
    "%n",
    "//",
    "\a",
    "\r",
    "\u202e",
    "NULL",
    "NAN",
    "1a",
    "int",
    "\t",
]
texts = (
    st.lists(st.one_of(st.sampled_from(NASTY), st.text(max_size=6)))
    .map("".join)
    .map(lambda text: text.encode("utf-8", "replace").decode().replace("\0", ""))
)
MACROS = [
    "NULL",
    "NAN",
    "INFINITY",
    "HUGE_VAL",
    "EOF",
    "errno",
    "assert",
    "true",
    "bool",
    "int",
    "while",
    "time",
    "at",
    "v",
    "d",
]


@settings(
    max_examples=6, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)
@given(st.lists(texts, min_size=30, max_size=60), st.lists(st.one_of(st.sampled_from(MACROS), texts), max_size=40))
def test_texts_and_names(tmp_path: Path, found: list[str], names: list[str]) -> None:
    found = [*NASTY, *found]
    fields = identifiers(dict.fromkeys(["time", *MACROS, *names]))
    members = "\n".join(f"    double {c}; {comment(name)}" for name, c in fields.items())
    prints = "\n".join(
        f"    fwrite({string(text)}, 1, sizeof {string(text)}, stdout); {comment(text)}" for text in found
    )
    program = f"""#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <windows_or_not.h>
typedef struct {{
{members}
}} Variables;
int main(void)
{{
{prints}
    return 0;
}}
"""
    (tmp_path / "windows_or_not.h").write_text(
        "#define min(a, b) 1\n#define near\n#define far\n#define interface struct\n"
    )
    (tmp_path / "texts.c").write_text(program, encoding="ascii")
    command = [*compiler(), "-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I.", "texts.c", "-o", "texts"]
    subprocess.run(command, cwd=tmp_path, check=True)
    output = subprocess.run([tmp_path / "texts"], capture_output=True, check=True).stdout
    assert output == b"".join(text.encode() + b"\0" for text in found)
    assert len(set(fields.values())) == len(fields)


@pytest.mark.parametrize("text", ["k */ double shift; /* x", "*/*/", "/*/", "**//", "a\n*/\nint x;"])
def test_a_comment_ends_where_it_should(text: str) -> None:
    assert comment(text).count("*/") == 1 and comment(text).endswith("*/") and "\n" not in comment(text)


@pytest.mark.parametrize("statement", ['say("v is 1");', "/* of v */", "w->v = 1.0;", r'say("\" v");'])
def test_a_parameter_that_is_but_mentioned_is_unused(statement: str) -> None:
    assert "(void)v;" in function("void f(const Variables *v, Variables *w)", [statement])
    assert "(void)v;" not in function("void f(const Variables *v, Variables *w)", [statement, "g(v);"])
