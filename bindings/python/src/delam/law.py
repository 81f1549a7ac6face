# SPDX-License-Identifier: BSD-3-Clause
"""Interface laws."""
from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._base import raw
from ._base.arrays import FloatArray, floats, listed, pointer, spread
from ._base.call import Context, Object, keep_exception, number, stopped, text
from ._base.errors import ArgumentError, ProblemError, error_of
from ._base.library import library
from ._base.records import Bounds, Parameter
from ._base.words import in_python, meant

__all__ = ["Bounds", "Law", "Parameter", "described", "kinds"]


def kinds() -> dict[str, str]:
    """Kinds of laws, each with its meaning."""
    name, meaning = ctypes.c_char_p(), ctypes.c_char_p()
    found = {}
    for i in range(library.delam_law_kind_count()):
        library.delam_law_kind_info(i, name, meaning, None)
        found[(name.value or b"").decode()] = in_python((meaning.value or b"").decode())
    return found


# Other programs use these names for kinds.
_SYNONYMS = {"bilinear": "piecewise-linear is the bilinear law", "triangular": "piecewise-linear is the bilinear law",
             "linear": "piecewise-linear softens on a straight line", "brittle": "griffith is the brittle law"}


def _known_kind(kind: str) -> bytes:
    """A kind as the library takes it."""
    key, there = text("kind", kind), kinds()
    if kind not in there:
        hint = f" ({_SYNONYMS[kind]})" if kind in _SYNONYMS else meant(kind, there)
        raise ArgumentError(f"kind = {kind!r} is not known{hint}; known are {', '.join(there)}")
    return key


def described(function: Any, *arguments: Any) -> Parameter:
    """Returns the description of a parameter or an option by a function of the library."""
    texts = [ctypes.c_char_p() for _ in Parameter._fields]
    status = function(*arguments, *(ctypes.byref(item) for item in texts))
    if status != raw.DELAM_OK:
        raise error_of(status, f"no description {arguments}")
    return Parameter(*(in_python((item.value or b"").decode()) for item in texts))


class Law(Object):
    """A law with its parameters by name:

        Law("piecewise-linear", normal_stiffness=125e9, tangential_stiffness=125e9, normal_onset=100, ...)

    Law.parameters(kind) lists them, with units. A tabulated law takes softening=(xi, s). ArgumentError names a kind, a
    parameter or a value that is not known or out of range; ProblemError, where the law is used, the parameters that are
    missing. `kind` is the kind as given, "host" for Law.host."""

    kind: str
    _callbacks: tuple[Any, ...]
    _instead = "Keep its kind and parameters, and make the Law from them where it is needed."

    def __init__(self, kind: str, **parameters: object) -> None:
        kind_text = _known_kind(kind)
        self._create(library.delam_law_create, kind_text)
        self.kind = kind
        self.set(**parameters)

    @classmethod
    def host(cls, name: str, adhesion: Callable[[float, float], tuple[float, float]],
             dissipation: Callable[[float, float], tuple[float, float, float]], **parameters: object) -> Law:
        """A law computed by Python functions, which must always return the same results for the same arguments:

            adhesion(mixity, driving) -> (adhesion, slope)
            dissipation(mixity, adhesion) -> (dissipated, slope, mixity_slope)

        adhesion: the minimiser of adhesion * driving + dissipated over [0, 1] and its derivative by the driving energy;
        dissipation: the energy g(B, zeta) and its derivatives by adhesion and mixity. They must not call the library.
        An exception in one ends the call of the library and is raised by that call. `name` identifies them in
        Problem.hash."""
        law = cls.__new__(cls)
        on_adhesion, on_dissipation = _adhesion_callback(adhesion), _dissipation_callback(dissipation)
        law._create(library.delam_law_create_host, text("name", name), on_adhesion, on_dissipation, None,
                    keep=(on_adhesion, on_dissipation))
        law.kind = "host"
        law.context.hosted = True
        law.set(**parameters)
        return law

    def __repr__(self) -> str:
        return f"<Law {self.kind!r}>"

    def _create(self, function: Any, *arguments: Any, keep: tuple[Any, ...] = ()) -> None:
        context = Context()
        self._callbacks = keep
        self._given: set[str] = set()
        self._is_complete = False
        self._make(context, raw.delam_law, library.delam_law_destroy, function, context.handle, *arguments, keep=keep)

    def _call(self, function: Any, *arguments: Any) -> None:
        self.context.call(function, self._handle, *arguments)

    @staticmethod
    def parameters(kind: str) -> dict[str, Parameter]:
        """Parameters of a kind: {key: Parameter}. ArgumentError: there is no such kind."""
        key = _known_kind(kind)
        count = library.delam_law_parameter_count(key)
        items = (described(library.delam_law_parameter_info, key, i) for i in range(count))
        return {item.key: item for item in items}

    @staticmethod
    def kinds() -> dict[str, str]:
        """Kinds of laws, each with its meaning; "host" is made by Law.host."""
        return kinds()

    @staticmethod
    def bounds(kind: str) -> dict[str, Bounds]:
        """Bounds of the numbers that a kind takes, those of a table for each of its numbers: {key: Bounds}."""
        lower, upper, lower_open, upper_open = ctypes.c_double(), ctypes.c_double(), ctypes.c_int32(), ctypes.c_int32()
        found = {}
        for i, parameter in enumerate(Law.parameters(kind).values()):
            library.delam_law_parameter_bounds(kind.encode(), i, lower, upper, lower_open, upper_open)
            if parameter.type != "text":
                found[parameter.key] = Bounds(lower.value, upper.value, bool(lower_open), bool(upper_open))
        return found

    def set(self, **parameters: object) -> None:
        """Sets numbers, texts and the table softening=(xi, s), two arrays [points]. Texts are set first: a criterion
        resets its exponents to their initial values. ArgumentError names a key that is not known, or a value out of
        range."""
        for key, value in sorted(parameters.items(), key=lambda item: not isinstance(item[1], str)):
            if isinstance(value, str):
                self._call(library.delam_law_set_text, key.encode(), text(key, value))
            elif key == "softening":
                try:
                    pair: Any = value
                    xi, s = pair
                except (TypeError, ValueError):
                    raise ArgumentError("softening must be the two arrays (xi, s)") from None
                xi = floats("softening[0]", xi, (None,))
                s = floats("softening[1]", s, (xi.size,))
                self._call(library.delam_law_set_table, xi.size, pointer(xi), pointer(s))
            else:
                self._call(library.delam_law_set, key.encode(), number(key, value))
            self._given.add(key)

    def _complete(self) -> None:
        """ProblemError names the parameters that are missing."""
        if self._is_complete:
            return
        known = self.parameters(self.kind)
        missing = []
        for key, item in known.items():
            # A strength stands for the onset that it replaces.
            others = [other.key for other in known.values() if other.initial == f"that of {key}"]
            if not item.initial and not self._given & {key, *others}:
                missing.append(f"{' or '.join([key, *others])} ({item.range})")
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            raise ProblemError(f"law {self.kind!r}: {', '.join(missing)} {verb} missing")
        self._is_complete = True

    def check(self) -> None:
        """ProblemError names the parameters that are missing, or the first that is not admissible."""
        self._complete()
        self._call(library.delam_law_check)

    def toughness(self, mixity: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Onset and total toughness [n], energies per area, at mixities B = Y_t/Y in [0, 1], a number or [n]."""
        mixity = floats("mixity", listed(mixity), (None,))
        onset, toughness = np.empty(mixity.size), np.empty(mixity.size)
        self._call(library.delam_law_toughness, mixity.size, pointer(mixity), pointer(onset), pointer(toughness))
        return onset, toughness

    def respond(self, jump: ArrayLike, mixity: ArrayLike,
                adhesion: ArrayLike = 1.0) -> tuple[FloatArray, FloatArray]:
        """One damage step at given jumps [n][2 or 3], lengths in local directions (normal first), at frozen mixities
        and from old adhesions, both one for all or [n]: the new adhesions [n] and the tractions [n][2 or 3],
        stresses. ProblemError names the parameters that are missing."""
        self._complete()
        jump = floats("jump", jump, (None, (2, 3)))
        count, dimension = jump.shape
        mixity, old = spread("mixity", mixity, count), spread("adhesion", adhesion, count)
        new, traction = np.empty(count), np.empty((count, dimension))
        self._call(library.delam_law_respond, dimension, count, pointer(jump), pointer(mixity), pointer(old),
                   pointer(new), pointer(traction))
        return new, traction


def _adhesion_callback(function: Callable[[float, float], tuple[float, float]]) -> Any:
    def adhesion(mixity: float, driving: float, value: Any, slope: Any, _: object) -> int:
        if stopped():
            return 1
        try:
            value[0], slope[0] = function(mixity, driving)
        except BaseException as exception:
            keep_exception(exception)
            return 1
        return 0

    return raw.delam_adhesion_callback(adhesion)


def _dissipation_callback(function: Callable[[float, float], tuple[float, float, float]]) -> Any:
    def dissipation(mixity: float, adhesion: float, value: Any, slope: Any, mixity_slope: Any, _: object) -> int:
        if stopped():
            return 1
        try:
            value[0], slope[0], mixity_slope[0] = function(mixity, adhesion)
        except BaseException as exception:
            keep_exception(exception)
            return 1
        return 0

    return raw.delam_dissipation_callback(dissipation)
