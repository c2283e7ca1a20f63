"""The declarations of Modelica text: classes, their components, and modifiers with their places.

rumoca shows no syntax tree, and what it makes of modifiers has to be checked against the text (audit.py). Other parsers
need a later Python (modelica) or take seconds for a small library (pymoca, with ANTLR in Python). Only what stands
between a class's name and its equations is read here; expressions are spans of tokens. Modelica 3.6, appendix A.2.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

TOKEN = re.compile(
    rb'(?P<skip>\s+|\xef\xbb\xbf|//[^\n]*|/\*.*?\*/)|(?P<text>"(?:\\.|[^"\\])*")|(?P<word>[A-Za-z_]\w*|\'(?:\\.|[^\'\\])*\')'
    rb"|(?P<number>\d[\w.]*(?:(?<=[eE])[+-]\d+)?)|(?P<sign>.)",
    re.DOTALL,
)
CLASSES = {"class", "model", "block", "record", "type", "connector", "package", "function", "operator"}
PREFIXES = {"redeclare", "final", "inner", "outer", "replaceable", "encapsulated", "partial", "expandable", "pure"}
PREFIXES |= {"impure", "flow", "stream", "discrete", "parameter", "constant", "input", "output", "each"}
SECTIONS = {"equation", "algorithm", "initial"}
OPENING, CLOSING = {"(", "[", "{"}, {")", "]", "}"}
Span = tuple[int, int]  # in bytes
END = ("", (0, 0))


@dataclass(frozen=True)
class Modifier:
    """``path = value``. A part of the path that is a class, as in ``redeclare model C = D(k=1)``, begins with "="."""

    path: tuple[str, ...]
    value: Span


@dataclass
class ClassText:
    """What a class declares. Names of types are as they are written. Names in a short class mean what is around it."""

    name: str  # the whole one
    kind: str = ""
    is_short: bool = False
    bases: list[str] = field(default_factory=list)
    imports: dict[str, str] = field(default_factory=dict)  # "*" and a number for all that is in a package
    components: list[tuple[str, str]] = field(default_factory=list)  # name and type, those that are redeclared too
    modifiers: list[Modifier] = field(default_factory=list)
    replaced: list[Modifier] = field(default_factory=list)  # those that end with a redeclaration, for its constraint
    redeclared: list[Modifier] = field(default_factory=list)  # components, with the place of their names
    values: list[Modifier] = field(default_factory=list)  # those that its own declarations give
    roots: list[Modifier] = field(default_factory=list)  # first parts of types that begin with a dot
    mentioned: set[str] = field(default_factory=set)  # all types, and packages inside


def read_classes(text: str) -> list[ClassText]:
    """All classes of a text, nested ones too. Of text that is no Modelica, as far as it looks like it."""
    scanner = _Scanner(text.encode())
    package = ClassText(scanner.within())
    while scanner.word:
        if scanner.word in CLASSES | PREFIXES:
            scanner.element(package)
        else:
            scanner.skip_statement()
    return scanner.found


class _Scanner:
    def __init__(self, data: bytes) -> None:
        self._tokens = [
            (match.group().decode(errors="replace"), match.span())
            for match in TOKEN.finditer(data)
            if match.lastgroup != "skip"
        ]
        self._at = 0
        self.found: list[ClassText] = []

    @property
    def word(self) -> str:
        """The next token; "" at the end."""
        return self._ahead()[0]

    def _ahead(self, count: int = 0) -> tuple[str, Span]:
        at = self._at + count
        return self._tokens[at] if at < len(self._tokens) else END

    def _take(self, *words: str) -> bool:
        taken = self.word in words
        self._at += taken
        return taken

    def _next(self) -> str:
        word = self.word
        self._at += 1
        return word

    def within(self) -> str:
        """The package that a file says it is within; "" for none."""
        parts = []
        if self._take("within"):
            while self.word not in {";", ""}:
                parts.append(self._next())
        return "".join(parts)

    def element(self, owner: ClassText) -> None:
        """A declaration, of a class or of components."""
        is_redeclared = False
        while self.word in PREFIXES:
            is_redeclared |= self._next() == "redeclare"
        if self.word in CLASSES:
            self._class(owner)
        else:
            self._components(owner, is_redeclared)
        self.skip_statement()

    def _class(self, owner: ClassText) -> None:
        kind = self._kind()
        is_extension = self._take("extends")
        name = self._next()
        new = ClassText(f"{owner.name}.{name}".lstrip("."), kind)
        self.found.append(new)
        if kind == "package":  # its constants are used by their names alone
            owner.mentioned.add(name)
        if is_extension:
            new.modifiers += self._modification(new, ())
        if self._take("="):
            self._short(new)
            owner.mentioned |= new.mentioned
        else:
            self._body(new)

    def _kind(self) -> str:
        """The keyword of a class, the last one of ``operator record``."""
        kind = ""
        while self.word in CLASSES:
            kind = self._next()
        return kind

    def _short(self, new: ClassText) -> None:
        new.is_short = True
        while self.word in PREFIXES:
            self._at += 1
        if self.word in {"enumeration", "der"}:
            return
        new.bases.append(self._type(new))
        new.modifiers += self._modification(new, ())
        new.modifiers += self._constraint(new, ())

    def _body(self, new: ClassText) -> None:
        name = new.name.rpartition(".")[2]
        while self.word and not (self.word == "end" and self._ahead(1)[0] == name):
            if self.word in SECTIONS:
                self._skip_section(name)
            elif self._take("extends"):
                new.bases.append(self._type(new))
                new.modifiers += self._modification(new, ())
                self.skip_statement()
            elif self._take("import"):
                self._import(new)
            elif self.word in {"annotation", "external", ";"}:
                self.skip_statement()
            elif self.word.startswith('"'):
                self._at += 1
            elif not self._take("public", "protected"):
                self.element(new)
        self._at += 2

    def _import(self, owner: ClassText) -> None:
        """``A.B``, ``C = A.B``, ``A.*`` or ``A.{B, C}``."""
        words = []
        while self.word not in {";", ""} and not self.word.startswith('"'):
            words.append(self._next())
        alias, _, whole = "".join(words).rpartition("=")
        package, _, last = whole.partition("{")[0].rpartition(".")
        if "{" in whole:
            names = whole.partition("{")[2].rstrip("}").split(",")
            owner.imports.update({name: f"{package}.{name}" for name in names})
        elif last == "*":
            owner.imports[f"*{len(owner.imports)}"] = package
        else:
            owner.imports[alias or last] = whole

    def _components(self, owner: ClassText, is_redeclared: bool) -> None:
        kind = self._type(owner)
        names, modifiers = [], []
        while re.match(r"[\w']", self.word):
            place = self._ahead()[1]
            names.append(self._next())
            if is_redeclared:
                owner.redeclared.append(Modifier((names[-1],), place))
            self._subscripts()
            modifiers += self._modification(owner, (names[-1],))
            if self._take("="):
                owner.values.append(Modifier((names[-1],), self._expression()))
            self._skip_to(",", ";", "constrainedby", ")")
            if not self._take(","):
                break
        owner.components += [(name, kind) for name in names]
        owner.modifiers += modifiers
        if self.word == "constrainedby":
            owner.replaced += modifiers
            start = self._at
            for name in names:
                self._at = start
                owner.modifiers += self._constraint(owner, (name,))

    def _type(self, owner: ClassText) -> str:
        """A name of a type."""
        name = "." if self.word == "." else ""
        if self._take("."):
            owner.roots.append(Modifier((self.word,), self._ahead()[1]))
        name += self._next()
        while self._take("."):
            name += f".{self._next()}"
        owner.mentioned.add(name)
        self._subscripts()
        return name

    def _subscripts(self) -> None:
        if self.word == "[":
            self._skip_group()

    def _constraint(self, owner: ClassText, path: tuple[str, ...]) -> list[Modifier]:
        if not self._take("constrainedby"):
            return []
        self._type(owner)
        return self._modification(owner, path)

    def _modification(self, owner: ClassText, path: tuple[str, ...]) -> list[Modifier]:
        """The modifiers in parentheses, if there are some."""
        found: list[Modifier] = []
        if not self._take("("):
            return found
        while self.word and not self._take(")"):
            found += self._argument(owner, path)
            self._skip_to(",", ")")
            self._take(",")
        return found

    def _argument(self, owner: ClassText, path: tuple[str, ...]) -> Iterator[Modifier]:
        is_element = False
        while self.word in PREFIXES:
            is_element |= self._next() in {"redeclare", "replaceable"}
        if is_element and self.word in CLASSES:
            self._kind()
            inner = (*path, f"={self._next()}")
            self._take("=")
            self._type(owner)
            yield from self._modification(owner, inner)
        else:
            kind = self._type(owner) if is_element else ""
            place = self._ahead()[1]
            inner = (*path, self._next())
            if kind:
                owner.components.append((inner[-1], kind))
                owner.redeclared.append(Modifier(inner, place))
            while self._take("."):
                inner = (*inner, self._next())
            self._subscripts()
            yield from self._modification(owner, inner)
            if self._take("="):
                yield Modifier(inner, self._expression())
        yield from self._constraint(owner, inner)

    def _expression(self) -> Span:
        start = self._ahead()[1][0]
        self._skip_to(",", ")", ";", "constrainedby")
        return start, self._ahead(-1)[1][1]

    def _skip_to(self, *words: str) -> None:
        while self.word and self.word not in words:
            self._skip_group()

    def _skip_group(self) -> None:
        """One token, or all from an opening bracket to its closing one."""
        depth = 0
        while self.word:
            word = self._next()
            depth += (word in OPENING) - (word in CLOSING)
            if depth <= 0:
                return

    def skip_statement(self) -> None:
        """All up to the next semicolon."""
        self._skip_to(";")
        self._take(";")

    def _skip_section(self, name: str) -> None:
        """Equations or statements: up to the next section or the end of the class."""
        while self._take(*SECTIONS):
            pass
        while self.word and self.word not in {"public", "protected", *SECTIONS}:
            if self.word == "end" and self._ahead(1)[0] == name:
                return
            self.skip_statement()
