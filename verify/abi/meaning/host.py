# SPDX-License-Identifier: BSD-3-Clause
"""A host in Python: calls by name, with the types of the header; lists in, lists out.

host("mesh_nodes", mesh, 8, Out(8)) is delam_mesh_nodes with an array of eight doubles; it returns the list. What a call
writes comes back in the order of its parameters, alone if there is one: Out() a single number or text, Out(n) an array
of n numbers, None a NULL. Handles are destroyed by close().

A Twist exchanges two neighbours of an array on its way through, or changes a single output: the tests of the table use
it (../meanings.py --exchange).
"""
import ctypes
import math
from ctypes import c_char, c_char_p, c_double, c_int32, c_int64, c_uint8, c_void_p

SCALARS = {"int32_t": c_int32, "int64_t": c_int64, "double": c_double, "uint8_t": c_uint8, "char": c_char}


class Refused(Exception):
    """A status that was not expected."""

    def __init__(self, name, status, message):
        super().__init__(f"{name}: status {status}: {message}")
        self.status = status


class Missing(Exception):
    """A function that this library does not have."""


class Out:
    def __init__(self, count=None):
        self.count = count


class Twist:
    """Exchanges entries `index` and `index` + 1 of the array `parameter` of `function`; in an array without order gives
    both the value of the second. key: the text argument that the call must have, None for any."""

    def __init__(self, function, parameter, key, index, ordered=True):
        self.function, self.parameter, self.key, self.index = function, parameter, key, index
        self.ordered = ordered
        self.done = False

    def fits(self, function, parameter, key):
        return function == self.function and parameter == self.parameter and (self.key is None or key == self.key)

    def turn(self, numbers):
        if self.index + 1 >= len(numbers):
            return
        one, other = numbers[self.index:self.index + 2]
        size = max((abs(n) for n in numbers if math.isfinite(n)), default=0.0)
        if one != other and not abs(one - other) <= 1e-13 * size:  # rounding is no difference
            numbers[self.index:self.index + 2] = [other, one if self.ordered else other]
            self.done = True


class Host:
    def __init__(self, header, library):
        """library: of ctypes, with the types of what describes keys (../keys.py)."""
        self.header, self.library = header, library
        self.functions, self.made, self.kept = {}, [], []
        self.context = None
        self.twist = None
        self.used = {}  # (function, parameter, key) -> length of the longest array that went through
        self.shapes = {name: self._kinds(function) for name, function in header.functions.items()}

    # ---- types ----
    def _kinds(self, function):
        """(name, kind, type) of each parameter; kind: scalar, text, text out, handle, handle out, in, out, callback."""
        kinds = []
        for p in function.parameters:
            base = p.type.replace("const ", "").rstrip("*")
            if p.type in self.header.callbacks or p.type == "void*":
                kinds.append((p.name, "callback", None))
            elif base in self.header.handles:
                kinds.append((p.name, "handle" if p.type.count("*") == 1 else "handle out", base))
            elif base == "char" and p.type.startswith("const "):
                kinds.append((p.name, "text" if p.type.count("*") == 1 else "text out", None))
            elif p.type.endswith("*"):
                kinds.append((p.name, "in" if p.type.startswith("const ") else "out", SCALARS[base]))
            else:
                kinds.append((p.name, "scalar", SCALARS[p.type]))
        return kinds

    def _function(self, name):
        if name not in self.functions:
            try:
                found = self.library[name]
            except AttributeError:
                raise Missing(name) from None
            declared = self.header.functions[name]
            found.argtypes = [kind[2] if kind[1] == "scalar" else c_void_p for kind in self.shapes[name]]
            found.restype = c_char_p if "*" in declared.result else SCALARS.get(declared.result)
            self.functions[name] = found
        return self.functions[name]

    # ---- calls ----
    def call(self, short, *arguments):
        """(result of the function, outputs)."""
        name = "delam_" + short
        function, kinds = self._function(name), self.shapes[name]
        if len(kinds) != len(arguments):
            raise TypeError(f"{name} takes {len(kinds)} arguments, {len(arguments)} given")
        key = next((a for a, kind in zip(arguments, kinds) if kind[1] == "text"), None)
        passed, results = [], []
        for value, (parameter, kind, type_) in zip(arguments, kinds):
            if value is None:
                passed.append(None)
                if kind in ("out", "text out", "handle out"):
                    results.append(lambda: None)
            elif kind in ("scalar", "handle", "callback"):
                passed.append(value)
            elif kind == "text":
                passed.append(c_char_p(value.encode()))
            elif kind == "in":
                numbers = list(value)
                self._seen(name, parameter, key, len(numbers))
                if self.twist is not None and self.twist.fits(name, parameter, key):
                    self.twist.turn(numbers)
                passed.append((type_ * max(len(numbers), 1))(*numbers))
            elif kind == "text out":
                text = c_char_p()
                passed.append(ctypes.pointer(text))
                results.append(lambda text=text: text.value.decode() if text.value is not None else None)
            elif kind == "handle out":
                handle = c_void_p()
                passed.append(ctypes.pointer(handle))
                results.append(lambda handle=handle, base=type_: self._keep(handle, base))
            else:
                count = value.count
                room = (type_ * max(count or 1, 1))()
                passed.append(room)
                results.append(lambda room=room, count=count, parameter=parameter: self._given(name, parameter, key,
                                                                                              room, count))
        result = function(*passed)
        return result, [read() for read in results]

    def __call__(self, short, *arguments):
        result, outputs = self.call(short, *arguments)
        declared = self.header.functions["delam_" + short].result
        if declared == "int32_t" and result != 0 and short not in ("abi", "blas_threads"):
            raise Refused("delam_" + short, result, self.message())
        if declared not in ("int32_t", "void"):
            return result.decode() if isinstance(result, bytes) else result
        return outputs[0] if len(outputs) == 1 else tuple(outputs)

    def status(self, short, *arguments):
        return self.call(short, *arguments)[0]

    def message(self):
        text = self._function("delam_context_message")(self.context)
        return (text or b"").decode()

    def has(self, short):
        return hasattr(self.library, "delam_" + short)

    # ---- what goes through ----
    def _seen(self, name, parameter, key, count):
        for own in (None, key) if key is not None else (None,):
            place = (name, parameter, own)
            self.used[place] = max(self.used.get(place, 0), count)

    def _given(self, name, parameter, key, room, count):
        if isinstance(room, ctypes.Array) and room._type_ is c_char:
            self._seen(name, parameter, key, count)
            return room.value.decode()
        numbers = list(room)[:count if count is not None else 1]
        self._seen(name, parameter, key, len(numbers))
        if self.twist is not None and self.twist.fits(name, parameter, key):
            if count is None:
                if self.twist.index == 0:
                    numbers[0], self.twist.done = numbers[0] + 1, True
            else:
                self.twist.turn(numbers)
        return numbers[0] if count is None else numbers

    # ---- objects ----
    def _keep(self, handle, base):
        if handle.value is None:
            return None
        self.made.append((base, handle))
        return handle.value

    def open(self):
        self.context = self("context_create", Out())

    def close(self):
        for base, handle in reversed(self.made):
            self._function(base + "_destroy")(ctypes.pointer(handle))
        self.made, self.kept, self.context = [], [], None
