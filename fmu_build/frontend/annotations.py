"""Annotations of a class, from its Modelica text: rumoca's flat form leaves them out."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ..ir.models import Claims, Experiment
from .sources import readable


def class_text(class_name: str, texts: Iterable[str]) -> str:
    """The text of the class from its keyword to its end; "" if none of ``texts`` has it.

    Of classes with the same name the one in a file ``within`` the right package is taken.
    """
    package, _, short = class_name.rpartition(".")
    name, within = re.escape(short), re.compile(rf"\s*within\s+{re.escape(package)}\s*;")
    pattern = re.compile(rf"\b(?:model|block|class)\s+{name}\b.*?\bend\s+{name}\s*;", re.DOTALL)
    found = (pattern.search(text) for text in sorted(texts, key=lambda text: not within.match(text)))
    return next((match.group(0) for match in found if match), "")


def read_experiment(text: str) -> Experiment:
    """The experiment annotation."""
    body = _arguments("experiment", text)
    values = {key: float(value) for key, value in re.findall(r"(\w+)\s*=\s*([-+.\deE]+)", body)}
    return Experiment(*(values.get(key) for key in ("StartTime", "StopTime", "Tolerance", "Interval")))


def read_documentation(text: str) -> str:
    """The HTML of Documentation(info="..."), without its html element; links into Modelica become plain text."""
    found = re.search(r'\bDocumentation\s*\(\s*info\s*=\s*"((?:\\.|[^"\\])*)"', text, re.DOTALL)
    html = re.sub(r"\\(.)", r"\1", found.group(1)) if found else ""
    html = re.sub(r"</?html>", "", html)
    return re.sub(r'<a href="modelica:[^"]*">(.*?)</a>', r"\1", html, flags=re.DOTALL).strip()


def read_icon(text: str) -> str:
    """The arguments of the Icon annotation."""
    return _arguments("Icon", text)


def read_examples(text: str) -> tuple[str, ...]:
    """The classes in our own annotation ``__fmu_build(referenceExamples={"...", "..."})``."""
    listed = re.search(r"\breferenceExamples\s*=\s*\{([^}]*)\}", _arguments("__fmu_build", text))
    return tuple(re.findall(r'"([^"]+)"', listed.group(1))) if listed else ()


def read_claims(class_name: str, texts: Iterable[str]) -> Claims:
    """``__fmu_build(author="...", copyright="...", license="...")`` of the class, or of the nearest package outside."""
    texts = list(texts)
    around = [class_text(class_name, texts)]
    *packages, _ = class_name.split(".")
    around += [_package_text(name, texts) for name in reversed(packages)]
    found: dict[str, str] = {}
    for text in around:
        for annotation in _all_arguments("__fmu_build", text):
            said = re.findall(r'\b(author|copyright|license)\s*=\s*"((?:\\.|[^"\\])*)"', annotation)
            found = {key: readable(re.sub(r"\\(.)", r"\1", value)) for key, value in said} | found
    return Claims(**found)


def _package_text(name: str, texts: Iterable[str]) -> str:
    """The text of a package."""
    pattern = re.compile(rf"\bpackage\s+{re.escape(name)}\b.*\bend\s+{re.escape(name)}\s*;", re.DOTALL)
    return next((match.group(0) for text in texts if (match := pattern.search(text))), "")


def read_couplings(text: str) -> tuple[str, ...]:
    """The arguments of each ``coupling(...)`` in ``__fmu_build``; what they mean is told in fmu/ports.py."""
    return tuple(_all_arguments("coupling", _arguments("__fmu_build", text)))


def read_terminals(text: str) -> tuple[str, ...]:
    """The arguments of each ``terminal(...)`` in ``__fmu_build``."""
    return tuple(_all_arguments("terminal", _arguments("__fmu_build", text)))


def _all_arguments(name: str, text: str) -> Iterator[str]:
    for start in re.finditer(rf"\b{name}\s*\(", text):
        yield _arguments(name, text[start.start() :])


def _arguments(name: str, text: str) -> str:
    """What stands between the parentheses of ``name(...)``, strings and inner parentheses minded."""
    start = re.search(rf"\b{name}\s*\(", text)
    if not start:
        return ""
    depth = 1
    for token in re.finditer(r'"(?:\\.|[^"\\])*"|[()]', text[start.end() :]):
        depth += {"(": 1, ")": -1}.get(token.group(0), 0)
        if depth == 0:
            return text[start.end() : start.end() + token.start()]
    return ""
