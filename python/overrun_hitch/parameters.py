"""What a run is made of: Sharp's parameters, his nine cases and the step brakes of his figures.

Every quantity is in SI units and carries its unit, its meaning and its range, so that tables, messages and files
written elsewhere can take them from here, and so whose it is and what linear theory makes of it. The ranges are those
of the FMU.

R. S. Sharp, "Longitudinal Oscillations of Vehicle/Trailer Combinations Induced by Overrun Braking", Vehicle System
Dynamics 11:1 (1982) 43-61, doi 10.1080/00423118208968687. Called "the paper" throughout the package.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Iterable, Mapping
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

# Whose a parameter is: of Car.fmu, of Trailer.fmu, of both, or of Trailer.fmu and making what passes between car and
# trailer, so that with all of these at 0 the car runs as if alone.
Owner = Literal["car", "trailer", "both", "link"]
# What linear theory makes of it (docs/theory.md). exact: takes the value, of stiffnesses that where the drawbar rests.
# small: exact for motions so small that they stay clear of the limit. large: for those so large that it hardly counts.
# approximate: takes a linear equivalent. neutral: holds at the default alone. outside: the value counts only out of
# compression, backward or at the start.
InTheory = Literal["exact", "small", "large", "approximate", "neutral", "outside"]


class HitchError(ValueError):
    """Something the user can mend. The message is one line that names the thing and says what is allowed."""


class Quantities(BaseModel):
    """A frozen record of finite numbers, each declared by `quantity`. Wrong values raise HitchError."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def __init__(self, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ValidationError as error:
            raise HitchError(self._explain(error.errors()[0])) from None

    @field_validator("*", mode="before")
    @classmethod
    def _is_a_number(cls, value: Any) -> Any:
        """True is 1 to Python, and to nobody who asks for a damper; durations and dates of NumPy are floats to it."""
        kind = getattr(getattr(value, "dtype", None), "kind", "f")
        if isinstance(value, bool) or kind in "bmM":
            raise ValueError("no number")
        return value

    @classmethod
    def unit(cls, name: str) -> str:
        """Unit of the quantity `name`, as the FMU writes it ("N.s/m")."""
        return cls._said(name, "unit")

    @classmethod
    def typical(cls, name: str) -> str:
        """Values of the quantity `name` on the road, in its unit, in words; "" where none are said."""
        return cls._said(name, "typical")

    @classmethod
    def source(cls, name: str) -> str:
        """Whose the default and what is typical are; "" where it is not said."""
        return cls._said(name, "source")

    @classmethod
    def _said(cls, name: str, what: str) -> str:
        extra = cls.model_fields[name].json_schema_extra
        return str(extra[what]) if isinstance(extra, dict) else ""

    @classmethod
    def having(cls, role: Literal["of", "theory"], *values: Owner | InTheory) -> tuple[str, ...]:
        """The quantities whose `role` is one of `values`, in the order in which they are declared."""
        extras = {name: field.json_schema_extra for name, field in cls.model_fields.items()}
        return tuple(name for name, extra in extras.items() if isinstance(extra, dict) and extra.get(role) in values)

    @classmethod
    def description(cls, name: str) -> str:
        """Meaning of the quantity `name`, a noun phrase."""
        return cls.model_fields[name].description or name

    @classmethod
    def allowed(cls, name: str) -> str:
        """The allowed range of `name` in words: "a finite number, at least 1 kg"."""
        words = {"ge": "at least", "gt": "greater than", "le": "at most", "lt": "less than"}
        limits = [
            f"{words[kind]} {with_unit(getattr(limit, kind), cls.unit(name))}"
            for limit in cls.model_fields[name].metadata
            for kind in words
            if hasattr(limit, kind)
        ]
        return ", ".join(["a finite number", *limits])

    @classmethod
    def limits(cls, name: str) -> tuple[float, float]:
        """The ends of the allowed range of `name`, in its unit; infinite where there is none."""
        declared = cls.model_fields[name].metadata
        low = [getattr(limit, kind) for limit in declared for kind in ("ge", "gt") if hasattr(limit, kind)]
        high = [getattr(limit, kind) for limit in declared for kind in ("le", "lt") if hasattr(limit, kind)]
        return max(low, default=-math.inf), min(high, default=math.inf)

    @classmethod
    def _explain(cls, error: Any) -> str:
        """One line for the first thing that pydantic found wrong."""
        name = str(error["loc"][0])
        if error["type"] == "extra_forbidden":
            return unknown("parameter", name, cls.model_fields)
        if error["type"] == "missing":
            return f"{name} is missing: {cls.description(name)} must be {cls.allowed(name)}"
        try:
            if error["type"] == "value_error":  # of `_is_a_number`
                raise TypeError
            shown = with_unit(float(error["input"]), cls.unit(name))
        except (TypeError, ValueError, OverflowError):
            shown = f"{error['input']!r:.40}"
        return f"{name} = {shown} is not allowed: {cls.description(name)} must be {cls.allowed(name)}"


def quantity(
    default: Any,
    unit: str,
    description: str,
    of: Owner | None = None,
    theory: InTheory | None = None,
    typical: str = "",
    source: str = "",
    **limits: float,
) -> Any:
    """Declare a quantity: default (... if there is none), unit, meaning, limits as pydantic spells them (ge, le).

    Each of Parameters also says whose it is, what linear theory makes of it, what is typical and who says so.
    """
    extra = {"unit": unit, "of": of, "theory": theory, "typical": typical, "source": source}
    return Field(default, description=description, json_schema_extra=extra, **limits)  # type: ignore[call-overload]


def with_unit(value: float, unit: str) -> str:
    """ "500 N.s/m"; a number alone where the unit is none or 1."""
    return f"{value:g} {unit}".removesuffix(" 1").rstrip()


def unknown(kind: str, name: str, names: Iterable[str]) -> str:
    """One line saying that there is no such `kind`, which was hardly meant otherwise, and which are allowed."""
    allowed = list(names)
    close = _alike(str(name), allowed)
    meant = f" did you mean {' or '.join(close)}?" if close else ""
    return f"there is no {kind} {name!r:.40};{meant} allowed: {', '.join(allowed)}"


def _alike(name: str, names: list[str]) -> list[str]:
    """Those which differ in case and signs alone; if there are none, up to three like it, the closest first."""
    plain = {other: re.sub(r"[\W_]", "", other).casefold() for other in names}
    asked = re.sub(r"[\W_]", "", name).casefold()
    close = difflib.get_close_matches(asked, set(plain.values()), n=3, cutoff=0.6)
    wanted = [asked] if asked in close else sorted(close, key=lambda spelling: _distance(asked, spelling))
    return [other for spelling in wanted for other in names if plain[other] == spelling]


def _distance(one: str, other: str) -> tuple[float, str]:
    return -difflib.SequenceMatcher(None, other, one).ratio(), other


# Far beyond any vehicle. From there on double precision loses what forces follow from, a slip or a compression, and a
# run would be wrong without a word.
MOST = 1e9  # in SI units
GREATEST = 1e12  # in SI units: inertias, and limits that by default are out of reach
LONGEST = 1e4  # m
WIDEST = 1e3  # m, of what is turned or displaced
FASTEST = 1e3  # m/s
STRONGEST = 1e6  # N, of friction, which is stiff where it sticks
SLOWEST = 1e3  # s


# Whose numbers they are; docs/parameters.md says where to find them.
SECTION_7 = "the paper, section 7"
SECTION_8 = "the paper, section 8"
CHRONO = "tyres of Project Chrono"
UN_R13 = "UN Regulation No. 13, from memory"


class Parameters(Quantities):
    """The car, the trailer, the drawbar and the start, in the paper's symbols. The defaults are figure 8."""

    # One argument a line, as the formatter has it, would make this table four hundred lines long.
    # fmt: off
    M_c: float = quantity(1000.0, "kg", "mass of the car", "car", "exact", ge=1.0, le=MOST, source=SECTION_7)
    M_t: float = quantity(500.0, "kg", "mass of the trailer", "trailer", "exact", ge=1.0, le=MOST, source=SECTION_7)
    I_c: float = quantity(5.0, "kg.m2", "lumped wheel inertia of the car", "car", "exact", ge=0.001, le=GREATEST,
        source=SECTION_7)
    I_t: float = quantity(2.5, "kg.m2", "lumped wheel inertia of the trailer", "trailer", "exact", ge=0.001,
        le=GREATEST, source=SECTION_7)
    R_c: float = quantity(0.35, "m", "wheel radius of the car", "car", "exact", ge=0.01, le=WIDEST, source=SECTION_7)
    R_t: float = quantity(0.35, "m", "wheel radius of the trailer", "trailer", "exact", ge=0.01, le=WIDEST,
        source=SECTION_7)
    C_kc: float = quantity(400e3, "N", "braking force per unit slip of the car", "car", "exact", ge=1.0, le=MOST,
        source=SECTION_7)
    C_kt: float = quantity(200e3, "N", "braking force per unit slip of the trailer", "trailer", "exact", ge=1.0,
        le=MOST, source=SECTION_7)
    k: float = quantity(5480.0, "N/m", "drawbar stiffness in compression", "link", "exact", ge=0.0, le=MOST,
        source=SECTION_8)
    k_t: float = quantity(548e3, "N/m", "drawbar stiffness in tension", "link", "exact", ge=0.0, le=MOST,
        source=SECTION_8)
    C: float = quantity(500.0, "N.s/m", "drawbar damper coefficient", "link", "exact", ge=0.0, le=MOST,
        source=SECTION_8)
    r: float = quantity(2.975 * 5480.0, "N.m/m", "trailer brake torque per unit of drawbar compression", "link",
        "exact", ge=0.0, le=MOST, source=SECTION_8)
    eps: float = quantity(0.0, "m", "drawbar clearance", "trailer", "exact", ge=0.0, le=LONGEST, source=SECTION_8)
    F_pull_max: float = quantity(1e9, "N", "largest pull of the damper in a drawbar that is pushed in", "trailer",
        "small", ge=0.0, le=GREATEST,
        typical="0 for a damper that only pushes and returns by a spring or gas",
        source="manuals of Hobby's and AL-KO's")
    rebound: float = quantity(1.0, "1", "damper coefficient while the drawbar springs back, over C", "trailer",
        "approximate", ge=0.0, le=MOST,
        typical="1 to 5", source=f"estimated; {UN_R13}")
    F_f: float = quantity(0.0, "N", "dry friction of the drawbar's guide", "link", "large", ge=0.0, le=STRONGEST,
        typical="20 to 150", source="estimated")
    tau_b: float = quantity(0.0, "s", "lag of the trailer's brake torque behind the drawbar compression", "trailer",
        "exact", ge=0.0, le=SLOWEST,
        typical="0.01 to 0.1", source="estimated")
    F_0: float = quantity(0.0, "N", "push up to which the drawbar gives by k_t alone", "link", "exact", ge=0.0,
        le=GREATEST,
        typical="0.02 to 0.04 of the trailer's weight: 98 to 196 N", source=f"a manual of Hobby's; {UN_R13}")
    x_2: float = quantity(1e3, "m", "drawbar compression beyond the clearance from which its stiffness is k_2",
        "trailer", "exact", ge=0.0, le=LONGEST,
        typical="0.02 to 0.08, within the travel", source="estimated")
    k_2: float = quantity(5480.0, "N/m", "drawbar stiffness from x_2 on", "link", "exact", ge=0.0, le=MOST,
        typical="1 to 3 times k", source="estimated")
    x_3: float = quantity(1e3, "m", "drawbar compression beyond the clearance from which its stiffness is k_3",
        "trailer", "exact", ge=0.0, le=LONGEST,
        typical="0.02 to 0.08, within the travel", source="estimated")
    k_3: float = quantity(5480.0, "N/m", "drawbar stiffness from x_3 on", "link", "exact", ge=0.0, le=MOST,
        typical="1 to 3 times k", source="estimated")
    travel: float = quantity(1e3, "m", "drawbar compression at which it meets the buffer", "trailer", "exact", ge=0.0,
        le=LONGEST,
        typical="0.085 to 0.1", source="a manual of Hobby's; one of AL-KO's, from memory")
    k_buffer: float = quantity(548e3, "N/m", "drawbar stiffness from there on", "link", "exact", ge=0.0, le=MOST,
        typical="200e3 to 1e6", source="estimated")
    mu: float = quantity(1e9, "1", "friction between tyres and road", "both", "small", ge=0.01, le=GREATEST,
        typical="1.0 dry asphalt, 0.3 packed snow", source=f"{CHRONO}; snow from memory")
    mu_slide: float = quantity(0.75, "1", "friction of wheels that slide, over mu", "both", "small", ge=0.5, le=0.95,
        typical="0.63 to 0.76 on dry road", source=CHRONO)
    sigma: float = quantity(0.0, "m", "relaxation length of the tyres", "both", "exact", ge=0.0, le=LONGEST,
        typical="0.3 to 0.8", source=CHRONO)
    CdA_c: float = quantity(0.0, "m2", "drag area of the car", "car", "neutral", ge=0.0, le=MOST,
        typical="0.45 to 0.8", source="a handbook's drag coefficients, an estimated area")
    CdA_t: float = quantity(0.0, "m2", "drag area of the trailer", "trailer", "neutral", ge=0.0, le=MOST,
        typical="0.3 for a flat trailer in the car's wake to 3 for a caravan",
        source="estimated; wind tunnel data of a caravan, second hand")
    C_rr: float = quantity(0.0, "1", "rolling resistance over load", "both", "neutral", ge=0.0, le=MOST,
        typical="0.008 to 0.02 on asphalt", source=f"{CHRONO}; Carvill's handbook")
    reverse_braking: float = quantity(1.0, "1", "share of the trailer's brake torque that acts backward", "trailer",
        "outside", ge=0.0, le=1.0,
        typical="0; at most about 0.16", source=f"a manual of Hobby's; {UN_R13}")
    V_0: float = quantity(40.0, "m/s", "speed at the start", "both", "outside", ge=-FASTEST, le=FASTEST,
        typical="10 to 40", source=SECTION_8)
    compression_start: float = quantity(0.0, "m", "drawbar compression at the start", "trailer", "outside", ge=-WIDEST,
        le=WIDEST)
    # fmt: on

    def __init__(self, **values: Any) -> None:
        super().__init__(**values)
        if self.F_0 > 0.0 and self.k_t == 0.0:
            raise HitchError(f"F_0 = {self.F_0:g} N is not allowed with k_t = 0 N/m: the frame must hold the threshold")

    @property
    def gives_from(self) -> float:
        """Compression (m) from which the spring gives and the trailer is braked: clearance, and F_0 on the frame."""
        return self.eps + self.F_0 / self.k_t if self.F_0 > 0.0 else self.eps

    @property
    def linear_until(self) -> float:
        """Compression (m) up to which, from `gives_from` on, the stiffness is k."""
        return max(self.gives_from, min(self.eps + self.x_2, self.travel))

    def off_default(self, *values: InTheory) -> tuple[str, ...]:
        """The parameters that have another value than the default and of which theory makes one of `values`."""
        return tuple(name for name in self.having("theory", *values) if getattr(self, name) != getattr(DATUM, name))

    def at_default(self, *values: InTheory) -> Parameters:
        """A copy in which the parameters of which theory makes one of `values` have their defaults."""
        return self.changed({name: getattr(DATUM, name) for name in self.off_default(*values)})

    def changed(self, changes: Mapping[str, Any]) -> Parameters:
        """A copy with `changes` (name: value); HitchError for an unknown name or a value out of range."""
        return Parameters(**{**self.model_dump(), **changes})


class Scenario(Quantities):
    """A step brake: from steady running at V_0, brake torque on the car's wheels from t = 0 on."""

    name: str
    parameters: Parameters
    brake_torque: float = quantity(1000.0, "N.m", "brake torque on the car's lumped wheels", ge=0.0)
    duration: float = quantity(6.0, "s", "length of the run", gt=0.0)

    def changed(self, **changes: Any) -> Scenario:
        """A copy with `changes`; HitchError for a value out of range."""
        return Scenario(**{"name": self.name, "parameters": self.parameters, "brake_torque": self.brake_torque,
                           "duration": self.duration, **changes})  # fmt: skip


PIECES = ("F_0", "x_2", "x_3", "travel")  # where the spring's stiffness changes, beside the clearance
# What does not count while the other, which says from where on, has its default: that is out of reach.
COUNTS_FROM: Mapping[str, str] = {"k_2": "x_2", "k_3": "x_3", "k_buffer": "travel", "mu_slide": "mu"}

# Section 7 of the paper fixes car and trailer; k, r, C are its free choices, here those of case ii in figure 8.
DATUM = Parameters()


def _case(k: float, r_over_k: float, **changes: float) -> Parameters:
    return DATUM.changed({"k": k, "r": r_over_k * k, **changes})


# Sections 8.1 and 8.2 of the paper: k (N/m), r/k (m) and the one datum that is reduced to 80 %.
CASES: Mapping[str, Parameters] = {
    "i": _case(11550.0, 1.225),
    "ii": _case(5480.0, 2.975),
    "iii": _case(2125.0, 8.23),
    "iv": _case(5480.0, 2.975, C_kt=160e3),
    "v": _case(5358.0, 3.0, I_c=4.0),
    "vi": _case(5317.0, 2.95, I_t=2.0),
    "vii": _case(4224.0, 3.77, M_c=800.0),
    "viii": _case(5158.0, 2.335, M_t=400.0),
    "ix": _case(5081.0, 2.44, R_t=0.28),
}


def _figure(number: str, C: float, k_t: float = 548e3, eps: float = 0.0) -> Scenario:
    parameters = CASES["ii"].changed({"C": C, "k_t": k_t, "eps": eps})
    return Scenario(name=f"figure {number}", parameters=parameters)


# Section 8.3 of the paper: case ii at 40 m/s, 1000 N.m for 6 s.
FIGURES: Mapping[str, Scenario] = {
    "6a": _figure("6a", C=20.0),
    "6b": _figure("6b", C=20.0, k_t=5480.0),
    "7": _figure("7", C=100.0),
    "8": _figure("8", C=500.0),
    "9": _figure("9", C=100.0, eps=0.1),
    "10": _figure("10", C=500.0, eps=0.1),
    "11": _figure("11", C=2500.0, eps=0.1),
}


def named(kind: str, name: str, table: Mapping[str, Any]) -> Any:
    """table[name], or a HitchError that lists the allowed names ("figure", "case")."""
    if name not in table:
        raise HitchError(unknown(kind, name, table))
    return table[name]
