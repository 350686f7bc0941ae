"""How figures write numbers, units and parameters, and the look of each identifier, the same in all."""

from __future__ import annotations

import math
from collections.abc import Sequence

IN_PRINT = {"tau": "τ", "kv": "k_{v}", "kc": "k_{c}", "kc+": "k_{c+}", "kc-": "k_{c−}", "ks": "k_{s}", "vs": "v_{s}", "sigma0": "σ_{0}",
            "sigma1": "σ_{1}", "sigma2": "σ_{2}", "ke": "k_{e}", "te": "t_{e}"}
HUES = {"nominal-ls": "grey", "energy-als": "vermilion", "energy-ml": "blue", "rls": "green", "motor-ridge": "purple", "kalman": "sky",
        "position-ridge": "orange"}
OTHERS = ("green", "purple", "orange", "sky")
SEVERAL = ("blue", "vermilion", "green", "purple", "orange", "sky")
STROKES, MARKS = ("solid", "dashed", "dotted"), ("circle", "square", "diamond", "up")


def significant(value: float | None, digits: int = 3) -> str:
    """A number as a person writes it: true minus sign, and 5·10⁻⁵ below 0.001 or from 100 000 on."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    exponent = int(f"{value:.{digits - 1}e}".split("e")[1])
    if abs(value) < 0.99e-3 or abs(value) >= 0.99e5:
        mantissa = f"{value / 10.0**exponent:.{digits - 1}f}"
        power = "10" + "".join("⁻" if digit == "-" else "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(digit)] for digit in str(exponent))
        return (power if mantissa == "1" else f"{mantissa}·{power}").replace("-", "−")
    return f"{value:.{max(0, digits - 1 - exponent)}f}".replace("-", "−")


def plain_number(value: float, digits: int) -> str:
    """So many significant digits, never as a power of ten: for numbers that stand beside each other."""
    if not value or not math.isfinite(value):
        return significant(value)
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(abs(value))))}f}".replace("-", "−")


def to_digits_of(value: float, deviation: float | None) -> str:
    """So many digits that the deviation has two; four where it is not known."""
    if not deviation or not value or not math.isfinite(value) or not math.isfinite(deviation) or deviation < 0:
        return significant(value, 4)
    digits = math.floor(math.log10(abs(value))) - math.floor(math.log10(deviation)) + 2
    return significant(value, min(6, max(2, digits)))


def range_at_bound(value: float, interval: Sequence[float] | None) -> tuple[float, float] | None:
    """The interval of a value that rests at one of its ends, since a bound holds it: all that is known of it. None of other values."""
    if not interval:
        return None
    lower, upper = interval
    at_end = 0.01 * (upper - lower)
    if value - lower > at_end and upper - value > at_end:
        return None
    # what is 0 but for rounding
    ends = [0.0 if abs(end) < 1e-9 * (upper - lower) else end for end in (lower, upper)]
    return ends[0], ends[1]


def range_text(value: float, interval: Sequence[float] | None) -> str | None:
    """"0 to 0.41" of such a value."""
    ends = range_at_bound(value, interval)
    return " to ".join(significant(end, 2) for end in ends) if ends else None


def unit_text(unit: str) -> str:
    """A unit as set in print: "N·m·s²/rad" for "N.m.s^2/rad"."""
    return unit.replace("^2", "²").replace(".", "·")


def hue_of(method: str) -> str:
    """Of an identifier, the same in every figure: any that is none of ours has one by its letters."""
    return HUES.get(method) or OTHERS[sum(method.encode()) % len(OTHERS)]


def look_of(methods: Sequence[str], place: int) -> tuple[str, str, str]:
    """Hue, stroke and marker of a row: rows of one colour differ by stroke and marker."""
    earlier = sum(hue_of(one) == hue_of(methods[place]) for one in methods[:place])
    return hue_of(methods[place]), STROKES[earlier % 3], MARKS[earlier % 4]


def look_of_several(place: int) -> tuple[str, str]:
    """Hue and stroke of one of up to 18 lines that have no hues of their own."""
    return SEVERAL[place % len(SEVERAL)], STROKES[place // len(SEVERAL) % len(STROKES)]


class Symbols:
    """Symbols of parameters in the order that laws list them. given: [name, symbol]."""

    def __init__(self, given: Sequence[Sequence[str]]) -> None:
        self._symbols = {name: IN_PRINT.get(symbol, symbol) for name, symbol in reversed(list(given))}
        self._places = {name: place for place, name in enumerate(dict.fromkeys(name for name, _ in given))}

    def of(self, name: str) -> str:
        return self._symbols.get(name, name)

    def with_name(self, name: str) -> str:
        return f"{name}, {self.of(name)}" if self.of(name) != name else name

    def place(self, name: str) -> int:
        return self._places.get(name, len(self._places))
