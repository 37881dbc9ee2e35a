# SPDX-License-Identifier: BSD-3-Clause
"""What calls of the compiled module raise whose arguments do not fit, in place of what pybind11 says. Data are never shown."""
from __future__ import annotations

import difflib
import operator
from typing import Any, Dict, List, Optional, Tuple

from . import _core

_LARGE = {"seed", "n", "num_points"}  # integers of 64 bits

_HALFSPACES = "A x <= b is one array of halfspaces, numpy.c_[A, -b]"
# What callers of other programs pass, by function and argument.
_HINTS = {("HalfspaceIntersection", "A"): _HALFSPACES, ("HalfspaceIntersection", "b"): _HALFSPACES}


def explained(function: str, arguments: List[Tuple[str, str, str]], given: tuple, named: Dict[str, Any]) -> Exception:
    """`arguments`: (name, type, default) as pybind11 has them, with "*" before those that must be named."""
    names = [name for name, _, _ in arguments if name != "*"]
    star = next((i for i, (name, _, _) in enumerate(arguments) if name == "*"), len(names))
    is_method = names[:1] == ["self"]
    title = type(given[0]).__name__ if function == "__init__" and given else function
    callers = names[is_method:]
    for name in named:
        if name not in callers:
            close = difflib.get_close_matches(name, callers, 1)
            hint = _HINTS.get((title, name))
            more = hint if hint else f"did you mean {close[0]!r}?" if close else f"it has {', '.join(callers)}" if callers else "it has none"
            return TypeError(f"{title}() has no argument {_core._represented(name)}; {more}")
    if len(given) > star:
        rest = f"; {', '.join(names[star:])} only by name" if names[star:] else ""
        return TypeError(f"{title}() takes at most {star - is_method} argument{'s' * (star - is_method != 1)} by position, not {len(given) - is_method}{rest}")
    values = dict(zip(names, given))
    for name in named:
        if name in values:
            return TypeError(f"{title}(): {name!r} is given twice")
    values.update(named)
    refusals = []
    for name, kind, default in arguments:
        if name in values:
            refusals.append(_refusal(title, name, kind, values[name]))
        elif name != "*" and not default:
            return TypeError(f"{title}() needs an object that it is a method of" if name == "self" else f"{title}() needs the argument {name!r}")
    refusals = [refusal for refusal in refusals if refusal is not None]
    if refusals:  # a number may be large enough for what it is: another type cannot be right
        return next((refusal for refusal in refusals if isinstance(refusal, TypeError)), refusals[0])
    return TypeError(f"{title}({', '.join(names)}): incompatible arguments, of the types "
                     f"{', '.join(f'{name}: {type(value).__name__}' for name, value in values.items())}")


def _refusal(title: str, name: str, kind: str, value: Any) -> Optional[Exception]:
    """What is wrong with one value; None if nothing is known to be."""
    low = kind.lower()
    is_optional = "optional" in low or "none" in low
    if value is None and is_optional:
        return None
    if name == "self" or kind.startswith("delone."):
        wanted = kind.rsplit(".", 1)[-1]
        if kind == "object" or any(base.__name__ == wanted for base in type(value).__mro__):
            return None
        return TypeError(f"{title}(): of a {wanted}, not of {_shown(value)}" if name == "self" else f"{name}: a {wanted}, not {_shown(value)}")
    or_none = ", or None," if is_optional else ""
    plain = low.removeprefix("optional[").removesuffix("]")
    if plain in ("float", "supportsfloat"):
        try:
            if not isinstance(value, (str, bytes)):
                float(value)
                return None
        except (TypeError, ValueError, OverflowError):
            pass
        return TypeError(f"{name}: a number{or_none} was expected, not {_shown(value)}")
    if plain in ("int", "supportsint"):
        try:
            number = operator.index(value)
        except TypeError:
            return TypeError(f"{name}: an integer{or_none} was expected, not {_shown(value)}")
        if number < 0:
            return ValueError(f"{name}: at least 0, not {_shown(number)}")
        return ValueError(f"{name}: {_shown(number)} is too large") if number >= (2**64 if name in _LARGE else 2**31) else None
    if plain == "str" and not isinstance(value, (str, bytes)):
        return TypeError(f"{name}: a str{or_none} was expected, not {_shown(value)}")
    texts = [value] if plain == "str" else value if plain in ("list[str]", "sequence[str]") and isinstance(value, (list, tuple)) else []
    for text in texts:
        if isinstance(text, str) and any("\ud800" <= character <= "\udfff" for character in text):
            return ValueError(f"{name}: {_core._represented(text)} has half of a surrogate pair, which is not a character")
    if plain == "bool" and value is not None and not hasattr(type(value), "__bool__"):
        return TypeError(f"{name}: True or False was expected, not {_shown(value)}")
    return None


def _shown(value: Any) -> str:
    """Numbers and text as they are, of anything else its type."""
    if value is None or isinstance(value, (bool, int, float, complex, str)):
        return _core._represented(value)
    return f"a {type(value).__name__}"
