# SPDX-License-Identifier: BSD-3-Clause
"""Measured curves: two columns of a file of a test machine, in the units of a scene, along the way of the test."""
import numpy as np

from _pictures.input_file import quoted
from analyses import LEAST, MOST
from command import Trouble
from measured.broken import broken_at, said_of_break
from measured.columns import choose, label, rivals
from measured.loops import Way
from measured.slack import find_slack
from measured.one_test import read_test
from measured.units import kind_of, quantity


def in_units(table, column, unit, wanted, kind, said):
    """The values of a column in a unit that is wanted; as they are if one of both is not known."""
    values = table.columns[column]
    if not unit or not wanted or kind_of(unit)[0] != kind or kind_of(wanted)[0] != kind:
        return values
    factor = kind_of(unit)[1] / kind_of(wanted)[1]
    if abs(factor - 1) > 1e-12:
        said.append(f"{label(table, column)} times {factor:.6g} is in {wanted}")
    return values * factor


def left_out(rows):
    return f"{rows} row{'s' * (rows > 1)} without both {'are' if rows > 1 else 'is'} left out"


def upright(points, factors, said):
    """x and y with which a test goes up and its load grows: compression is often written with negative signs, and a
    crosshead that moves down counts down. A negative factor of an option keeps its signs. said gets what is turned."""
    points = list(points)
    if factors[1] > 0 and np.max(-points[1]) > 2 * max(np.max(points[1]), 0.0):
        points[1] = -points[1]
        said.append("y is negative, its sign is turned")
    rises = np.sum(points[0][:int(np.argmax(np.abs(points[1]))) + 1][[0, -1]] * [-1, 1])
    if factors[0] > 0 and rises < 0:
        said.append(("x is negative" if np.max(points[0]) <= 0 else
                     f"x goes down while the load grows, from {points[0][0]:.4g} on") + ", its sign is turned")
        points[0] = -points[0]
    return points


def scale_of(given, length):
    """The factor on the y of the data that options give: --scale, and 1 over --width, which is in the unit of the scene or
    in its own."""
    if not given.width:
        return given.scale
    found = quantity(given.width, "length")
    if found is None or not LEAST <= found[0] <= MOST:
        raise Trouble(f"--width {given.width[:60]}: a length > 0 is expected, such as 25mm")
    value, unit = found
    if unit and not length:
        raise Trouble(f"--width {given.width}: the scene names no units: give a number in its unit of length")
    return given.scale / (value * (kind_of(unit)[1] / kind_of(length)[1] if unit else 1.0))


def in_scene(text, option, example, kind, units):
    """What an option gives, in the units of the scene. units: of the scene, for the parts of the kind ("length/force")."""
    found = quantity(text, kind)
    if found is None or found[0] != 0 and not LEAST <= abs(found[0]) <= MOST:
        raise Trouble(f"{option} {text[:60]}: a {kind.replace('/', ' per ')} is expected, such as {example}")
    value, unit = found
    if not unit:
        return value
    if not all(units):
        raise Trouble(f"{option} {text}: the scene names no units: give a number in its own")
    return value * kind_of(unit)[1] / kind_of("/".join(units))[1]


class CurveData:
    """x is what the scene calls load, y what the model shall meet there, times `scale`; `at` is where along the way."""

    def __init__(self, path, given, units=None, scale=1.0, specimen=""):
        """given: columns, x_scale, loops ("cut" or "follow") and x, the column of the history. units: of length and
        force of the scene, "" where it names none. specimen: which test of the file."""
        self.path = path
        length, force = units or ("", "")
        table = read_test(path, specimen)
        x, y = choose(table, given.columns, "time" if given.x == "time" else "displacement")
        self.names = [label(table, x), label(table, y)]
        said = [f"x is {self.names[0]}, y is {self.names[1]}", *table.said]
        said[1:1] = [] if given.columns else rivals(table, (x, y))
        self.force_unit = table.units[y]
        self.named_units = [unit for unit in (table.units[x], table.units[y]) if kind_of(unit)[0]]
        nameless = [name for name, k in zip("xy", (x, y)) if not table.units[k]]
        if nameless and all((length, force)):
            said.append(f"the file names no unit of {' and '.join(nameless)}: numbers count in those of the scene ({length}, {force})")
        kind = "time" if given.x == "time" else "length"
        self._require_kinds(table, x, y, given)
        # A scene in the plane has loads per width, and so may a table.
        per_width = kind_of(table.units[y])[0] == "force/length"
        if per_width and given.width:
            raise Trouble(f"{path}: {self.names[1]} is a load per width already: --width would divide it again")
        of_load = (f"{force}/{length}" if force and length else "", "force/length") if per_width else (force, "force")
        there = np.isfinite(table.columns[x]) & np.isfinite(table.columns[y]) | np.isinf(table.columns[x] + table.columns[y])
        points = [in_units(table, x, table.units[x], "" if kind == "time" else length, kind, said)[there],
                  in_units(table, y, table.units[y], *of_load, said)[there]]
        if not there.all():
            said.append(left_out(int((~there).sum())))
        if len(points[0]) < 2:
            raise Trouble(f"{path}: at least 2 points are expected")
        for which, name, factor in ((0, "--x-scale", given.x_scale), (1, "--scale", scale)):
            self._require_numbers(self.names[which], points[which], "")
            points[which] = points[which] * factor
            self._require_numbers(self.names[which], points[which], f" times {name} {factor:g}")
        points = upright(points, (given.x_scale, scale), said)
        broken = broken_at(*points) if given.x.startswith("load") and given.y.startswith("reaction") else None
        if broken is not None:
            said.append(said_of_break(points[0][broken - 1], len(points[0]) - broken, length))
            points = [column[:broken] for column in points]
        # The compliance of the machine counts for the whole load, before it is divided by the width.
        points = self._of_specimen(points, given, (length, force), given.scale / scale, said)
        self.rows = len(points[0])
        self._follow(points, given.loops == "follow", said)
        self.said = f"{path}: {'; '.join(said)}"

    @staticmethod
    def _require_kinds(table, x, y, given):
        """A column in mm is no force, also where --columns takes it. The load of a scene is a displacement or a dead force."""
        allowed = {"load": ("length", "force"), "time": ("time",), "reaction": ("force", "force/length")}
        for option, column, name in (("x", x, given.x), ("y", y, given.y)):
            kind, expected = kind_of(table.units[column])[0], allowed.get(name.split(":")[0])
            if kind and expected and kind not in expected:
                raise Trouble(f"{table.path}: {label(table, column)} is no {option} to compare with {quoted(name)} of the scene: "
                              f"a {' or a '.join(one.replace('/', ' per ') for one in expected)} is expected (--columns X Y)")

    def _of_specimen(self, points, given, units, per, said):
        """The points without what machine and fixture add to the displacement: their compliance, and the slack before the
        load begins. per: by which factor the load of the machine is larger than y."""
        x, y = points
        if given.compliance:
            x = x - in_scene(given.compliance, "--compliance", "2e-5mm/N", "length/force", units) * per * y
            said.append(f"--compliance {given.compliance} takes {np.max(points[0] - x):.4g}{' ' * bool(units[0])}{units[0]} off "
                        "at the largest load")
        measured = given.x.startswith("load") and given.y.startswith("reaction")
        if given.slack == "none" or given.slack == "find" and not measured:
            return [x, y]
        slack = (find_slack(x, y) if given.slack == "find"
                 else in_scene(given.slack, "--slack", "0.3mm, find or none", "length", units[:1]))
        if not slack:
            return [x, y]
        kept = x >= slack
        if kept.sum() < 2:
            raise Trouble(f"{self.path}: --slack {given.slack} leaves no points: x ends at {np.max(x):g}")
        text = f"{abs(slack):.4g}{' ' * bool(units[0])}{units[0]}"
        said.append((f"slack: the load begins at {text}, which is taken off" if slack > 0 else
                     f"preload: the line of the load begins {text} before 0, which is added") +
                    ("" if kept.all() else ", and the point before it is left out" if (~kept).sum() == 1 else
                     f", and {int((~kept).sum())} points before it are left out") +
                    ("; --slack none keeps it, --slack LENGTH gives another one" if given.slack == "find" else ""))
        return [x[kept] - slack, y[kept]]

    def _follow(self, points, follow, said):
        way = Way(*points, follow)
        self.x, self.y, self.at, self.turns = way.x, way.y, way.at, way.turns
        span = np.ptp(points[0])
        if way.averaged:
            said.append(f"x jitters: {way.averaged + len(self.x)} points are averaged to {len(self.x)}"
                        if not way.loops else f"x jitters: {way.averaged} points are merged with their neighbours")
        if way.loops:
            sizes = ", ".join(f"{100 * fall / span:.0f} %" for fall in way.loops[:4])
            said.append(f"{len(way.loops)} unloading{'s' if len(way.loops) > 1 else ''} by {sizes} of the range of x "
                        + ("followed" if follow else f"cut, {len(self.x)} points remain; --loops follow follows them"))
        if len(self.x) < 2:
            raise Trouble(f"{self.path}: {self.names[0]} must increase: of {self.rows} points 1 lies beyond all before it")

    def _require_numbers(self, name, column, times):
        """Finite, and with squares that are numbers too: the fit adds them up."""
        size = np.abs(column)
        wrong = np.flatnonzero(~((size == 0) | (size >= LEAST) & (size <= MOST)))
        if wrong.size:
            k = int(wrong[0])
            raise Trouble(f"{self.path}: row {k + 1} of the numbers: {name}{times} is {column[k]:g}: 0, or a finite "
                          f"number from {LEAST:g} to {MOST:g}, is expected")

    def drop_outside(self, low, high, slack):
        """Leaves out points before the scene begins and behind its end, if they lie no farther away than the slack: how
        many they are."""
        outside = (self.x < low) | (self.x > high)
        if np.min(self.x) < low - slack or np.max(self.x) > high + slack or outside.sum() > len(self.x) - 2:
            return 0
        self.x, self.y, self.at = self.x[~outside], self.y[~outside], self.at[~outside]
        return int(outside.sum())

    def _rising(self, y, most):
        """The points until y first reaches a part of its largest value."""
        top = most * np.max(np.abs(y))
        beyond = np.flatnonzero(np.abs(y) >= top)
        return int(beyond[0]) + 1 if beyond.size else len(y)

    def slope_over(self, curve):
        """How much more steeply the data begin to rise than a curve at their x: the ratio of the slopes of straight
        lines through the points before both reach half of their largest value. None: these are too few."""
        count = min(self._rising(self.y, 0.5), self._rising(curve, 0.5))
        if count < 2 or not np.ptp(self.x[:count]) > 0:
            return None
        lines = [np.polyfit(self.x[:count], y[:count], 1)[0] for y in (self.y, curve)]
        return lines[0] / lines[1] if lines[0] * lines[1] > 0 else None

    def opposes(self, curve):
        """Whether most of the data have the other sign than a curve at their x; noise does not decide it."""
        return np.dot(self.y, curve) < 0
