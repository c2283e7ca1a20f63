"""unit.h: names that no other unit has, so that the sources of several can be linked into one program.

The standard's functions get the prefix that FMI asks for (FMI 2.0.5 section 2.1.1, FMI 3.0.2 section 2.2.2); a shared
library is compiled without, as both say: FMI2_OVERRIDE_FUNCTION_PREFIX, FMI3_OVERRIDE_FUNCTION_PREFIX. Everything else
that the files call in each other gets one of ours.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

# A declaration begins at the start of a line; what is static, a type or a macro is none that a linker sees.
_DECLARED = re.compile(
    r"^(?!static\b|typedef\b|return\b)(?:[A-Za-z_]\w*[\s*]+)+(\w+)\s*(?:\(|\[[^;]*;|;)", re.MULTILINE
)


def unit_header(identifier: str, fmi: int, headers: Iterable[str]) -> str:
    """The text of unit.h for the unit ``identifier``, whose other ``headers`` declare what its files share."""
    names = sorted({name for text in headers for name in _DECLARED.findall(_without_comments(text))})
    renamed = "\n".join(f"#define {name} {identifier}_fmi{fmi}_{name}" for name in names)
    prefix = f"FMI{fmi}_FUNCTION_PREFIX"
    return f"""/* Names of this unit's own: the sources of several can be linked into one program. */
#ifndef UNIT_H
#define UNIT_H

#ifndef {prefix}
#define {prefix} {identifier}_
#endif

{renamed}

#endif
"""


def how_to_build(identifier: str, fmi: int) -> str:
    """The text of sources/README.txt."""
    return f"""The unit {identifier} in C11. Not C++: compile it as C; the objects may be linked into a C++ program.

A shared library, for binaries/, with the standard's own function names:

    cc -std=c11 -O3 -ffp-contract=off -fPIC -shared -fvisibility=hidden -DFMI{fmi}_OVERRIDE_FUNCTION_PREFIX *.c -lm

Static linking, also of several units into one program: without that definition the functions are named
{identifier}_fmi{fmi}Instantiate and so on, and everything else bears a name of this unit's own (unit.h):

    cc -std=c11 -O3 -ffp-contract=off -c *.c

-ffp-contract=off gives the same digits on every machine. The headers of the standard are taken from the include path if
they are there, else from the folder fmi{fmi} beside the sources.
"""


def _without_comments(text: str) -> str:
    return re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
