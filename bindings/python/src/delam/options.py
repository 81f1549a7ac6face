# SPDX-License-Identifier: BSD-3-Clause
"""Options by key, as a mapping that describes its entries."""
from __future__ import annotations

import collections.abc
import ctypes
import functools
from collections.abc import Iterable, Iterator
from typing import Any

from ._base.call import number, text
from ._base.library import library
from ._base.protocols import Problem
from ._base.records import Bounds, Parameter
from ._base.words import listing, meant
from .law import described

# The value of an option.
Value = str | int | float


def options() -> dict[str, Parameter]:
    """All options of the library: {key: Parameter}."""
    items = (described(library.delam_option_info, i) for i in range(library.delam_option_count()))
    return {item.key: item for item in items}


@functools.cache
def known() -> dict[str, Parameter]:
    """options(), asked for once."""
    return options()


@functools.cache
def aliases() -> dict[str, str]:
    """Alternative keys: {alias: key}."""
    found = {}
    for index, key in enumerate(known()):
        alias = ctypes.c_char_p()
        library.delam_option_alias(index, ctypes.byref(alias))
        if alias.value:
            found[alias.value.decode()] = key
    return found


@functools.cache
def bounds() -> dict[str, Bounds]:
    """Bounds of the options that are numbers: {key: Bounds}."""
    found = {}
    for index, parameter in enumerate(known().values()):
        if parameter.type == "text":
            continue
        lower, upper, lower_open, upper_open = ctypes.c_double(), ctypes.c_double(), ctypes.c_int32(), ctypes.c_int32()
        library.delam_option_bounds(index, lower, upper, lower_open, upper_open)
        found[parameter.key] = Bounds(lower.value, upper.value, bool(lower_open), bool(upper_open))
    return found


def key_of(key: str) -> str:
    """The key for a key or an alias."""
    key = aliases().get(key, key)
    if key not in known():
        raise unknown(key, [*known(), *aliases()], "option")
    return key


def initial_values() -> dict[str, Value]:
    """{key: value} without any setting."""
    return {key: _value(parameter, parameter.initial) for key, parameter in known().items()}


def unknown(key: object, known: Iterable[str], what: str) -> KeyError:
    """KeyError with the nearest names, or with some that there are."""
    names = list(known)
    return KeyError(f"{what} {key!r} is not known" + (meant(key, names) or f"; there are {listing(names)}"))


def _value(parameter: Parameter, words: Any) -> Value:
    return str(words) if parameter.type == "text" else int(words) if parameter.type == "integer" else float(words)


class Options(collections.abc.MutableMapping[str, Value]):
    """problem.options["solution"] = "energetic"; del resets an option to its initial value. Iterates over all options;
    describe() explains them. An alias works like its key. KeyError: there is no such option; ArgumentError: the value
    is out of range. Solvers that exist keep the options that they were made with."""

    def __init__(self, problem: Problem, values: dict[str, Value]) -> None:
        self._call = problem._call
        self._known = known()
        self._values = values

    def __getitem__(self, key: str) -> Value:
        return self._values[key_of(key)]

    def __setitem__(self, key: str, value: Value) -> None:
        key = key_of(key)
        parameter = self._known[key]
        if parameter.type == "text":
            self._call(library.delam_problem_set_text, key.encode(), text(key, value))
        else:
            value = number(key, value)
            self._call(library.delam_problem_set_number, key.encode(), value)
        self._values[key] = _value(parameter, value)

    def __delitem__(self, key: str) -> None:
        key = key_of(key)
        self[key] = _value(self._known[key], self._known[key].initial)

    def __iter__(self) -> Iterator[str]:
        return iter(self._known)

    def __len__(self) -> int:
        return len(self._known)

    def __repr__(self) -> str:
        return f"Options({self._values})"

    def info(self, key: str) -> Parameter:
        """Type, unit, range and meaning of an option. KeyError: there is none of this key."""
        return self._known[key_of(key)]

    def bounds(self, key: str) -> Bounds | None:
        """Bounds of a number; None for a text. KeyError: there is no option of this key."""
        return bounds().get(key_of(key))

    def describe(self) -> str:
        """A line for each option: value, range, meaning."""
        return "\n".join(f"{key} = {self._values[key]}  ({item.range}; initially {item.initial})  {item.meaning}"
                         for key, item in self._known.items())
