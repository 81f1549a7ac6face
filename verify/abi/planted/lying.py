# SPDX-License-Identifier: BSD-3-Clause
"""lying.py [LIE ...] -- ARGUMENTS: ../keys.py with a library that says something else of its keys.

fewer FUNCTION                            one less of what it counts
turn FUNCTION PARAMETER KEY PLACE VALUE   VALUE in PLACE where PARAMETER is KEY
refuse FUNCTION KEY [DIMENSION]           an error for the key, in the plane or in space alone
"""
import ctypes
import os
import sys

sys.path[:0] = [os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
import keys  # noqa: E402


def read(argument):
    value = getattr(argument, "_obj", argument)
    return value[0] if isinstance(value, ctypes.Array) else getattr(value, "value", value)


def put(argument, text):
    old = read(argument)
    value = text.encode() if isinstance(old, bytes) else type(old)(text)
    if isinstance(argument, ctypes.Array):
        argument[0] = value
    else:
        argument._obj.value = value


class Lying:
    def __init__(self, library, header, kind, function, *words):
        self.library, self.kind, self.function, self.words = library, kind, "delam_" + function, words
        self.names = [parameter.name for parameter in header.functions[self.function].parameters]

    def __getattr__(self, name):
        return self.call if name == self.function else getattr(self.library, name)

    def call(self, *arguments):
        given, words = dict(zip(self.names, arguments)), self.words
        if self.kind == "refuse" and read(given["key"]) == words[0].encode() and self.dimension(given) in words[1:]:
            return -1
        result = getattr(self.library, self.function)(*arguments)
        if self.kind == "fewer" and "count" not in given:
            return result - 1
        if self.kind == "fewer":
            put(given["count"], str(read(given["count"]) - 1))
        if self.kind == "turn" and read(given[words[0]]) == words[1].encode():
            put(given[words[2]], words[3])
        return result

    def dimension(self, given):
        rows, dimension = ctypes.c_int64(), ctypes.c_int64()
        self.library.delam_solver_field_shape(given["solver"], b"displacement", -1, ctypes.byref(rows),
                                              ctypes.byref(dimension))
        return str(dimension.value)


def main():
    middle = sys.argv.index("--")
    lie, sys.argv[1:] = sys.argv[1:middle], sys.argv[middle + 1:]
    honest = keys.library_of
    if lie:
        keys.library_of = lambda path, header: Lying(honest(path, header), header, *lie)
    keys.main()


if __name__ == "__main__":
    main()
