# SPDX-License-Identifier: BSD-3-Clause
"""What a fit compares with the data: analyses at given parameters, with the derivatives by those that are numbers of
laws, which the analysis itself has ([output] sensitivities)."""
import difflib
import os
import re
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from _pictures.input_file import MOST_SCENE, quoted, read_text
from command import complain
from analyses import (DONE, INTERRUPTED, NOT_CONVERGED, NUMERICAL, WRONG, Check, Trouble, analyse, last_words, number_in,
                     path_of, read_history, setting, value_at)
from measured.units import kind_of

SMALL_PART = 0.05  # of the range of a scene: less is covered by curves in metres, centimetres, inches for millimetres
# Data may lie so far before and behind the scene, as a part of its range: machines start with a preload or some slack,
# and x jitters.
SLACK = 0.02
# By this factor the initial slope of the data may differ from the model's before the first step; a kilonewton, a pound
# and a width of 20 or 25 mm differ by more. A parameter that starts at a quarter of its value changes it by less.
STIFFER = 4.0
DIFFERS = 1.25  # from here on it is said
# Load steps with which a fit begins, and into how many one of the scene goes then: with fewer than 40 the curve has
# corners where the data have none (test_studies.py, fits: 20 give a start 9 % off, 80 the same one as 40).
BEGIN_STEPS, COARSER = 40, 4
OF_NEW = "# delam new "  # a scene that begins so can be written again


class Parameter:
    """`KEY`, `KEY=LOWER:UPPER` or `KEY=LOWER:UPPER@START`."""

    def __init__(self, text):
        match = re.fullmatch(r"([^=@]+)(?:=([^:@]*):([^@]*))?(?:@(.+))?", text)
        if match is None:
            raise Trouble(f"--parameters {quoted(text)}: KEY, KEY=LOWER:UPPER or KEY=LOWER:UPPER@START is expected")
        self.path = path_of(match.group(1))
        where = f"--parameters {self.path}"
        self.lower = number_in(match.group(2), where) if match.group(2) else 0.0
        self.upper = number_in(match.group(3), where) if match.group(3) else np.inf
        self.start = number_in(match.group(4), where) if match.group(4) else None
        if not self.lower < self.upper:
            raise Trouble(f"--parameters {text}: the lower bound must be less than the upper one")

    @property
    def of_law(self):
        return self.path.startswith("laws[")

    def begin(self, files, scenes, common):
        """The value of the scenes, unless a start is given; inside of the bounds."""
        known = {value_at(scene, self.path) for scene in scenes} - {None}
        if self.start is None:
            if not known:
                self._require_key(files[0], common)
            if len(known) != 1:
                raise Trouble(f"{self.path}: the scenes give " + (f"different values, {sorted(known)}" if known
                                                                  else "no number") + ": add @START")
            self.start = known.pop()
        if not self.start > 0:
            raise Trouble(f"{self.path} starts at {self.start:g}: > 0 is expected")
        if not self.lower < self.start < self.upper:
            raise Trouble(f"{self.path} starts at {self.start:g}, which is not between {self.lower:g} and {self.upper:g}")

    def _require_key(self, file, common):
        """What `delam check` says of two values alike is of the key: it is unknown, or its list has no such entry."""
        said = {answer.words for answer in (Check(file, common + [f"{self.path}={value}"]) for value in (1.0, 2.0))
                if answer.errors and answer.errors[0]["key"] == self.path}
        if len(said) == 1:
            text = said.pop().removeprefix("--set: ")
            raise Trouble(f"--parameters {with_hint(text, self.path, file)}")


def numbers_of_laws(scene):
    """The keys of the numbers of the laws, those of toughness first."""
    laws = scene.get("laws", [])
    keys = [f"laws.{k}.{key}" for k, law in enumerate(laws if isinstance(laws, list) else []) if isinstance(law, dict)
            for key in law if value_at(law, key) is not None]
    return sorted(keys, key=lambda key: not key.endswith("toughness"))


def with_hint(text, path, file):
    """What is said of a key that is none, with the number of a law of the scene that is meant, or all of them."""
    numbers = numbers_of_laws(read_scene(file))
    near = difflib.get_close_matches(word_of(path), numbers, 1, 0.8)
    if near:
        return f"{text.partition(';')[0]} (did you mean {near[0]}?)"
    return f"{text.partition(';')[0]}; numbers of the laws of {file}: {', '.join(numbers)}" if numbers and "." not in path else text


def word_of(path):
    """A key as the shell takes it without quotes: laws.0.normal_toughness."""
    return path.replace("[", ".").replace("]", "")


def read_scene(path):
    """A scene as it is written."""
    try:
        return tomllib.loads(read_text(path, MOST_SCENE))
    except FileNotFoundError as error:
        raise Trouble(f"{path}: cannot be read: {error.strerror}") from error
    except RecursionError:
        raise Trouble(f"{path}: tables and lists lie within each other too deeply") from None
    except ValueError as error:  # of TOML, or a number of thousands of digits
        raise Trouble(f"{path}: {error}") from error


def units_of_scene(scene, common):
    """The units of length and force that a scene names, "" for those that it does not."""
    named = dict(scene["units"]) if isinstance(scene.get("units"), dict) else {}
    for word in common:
        key, _, value = word.partition("=")
        if key in ("units.length", "units.force"):
            named[key.partition(".")[2]] = value.strip("\"' ")
    return tuple(str(named.get(key, "")) for key in ("length", "force"))


def pattern_of(x_name, scene):
    """The place of the pattern that a column of the history is; None: it is none."""
    patterns = scene.get("patterns", [])
    names = ["load"] if len(patterns) == 1 else [f"load_{pattern['name']}" for pattern in patterns]
    return names.index(x_name) if x_name in names else None


def range_of(x_name, scene, times):
    """From where to where a column of the history grows at least, as far as the scene tells; None: it does not."""
    begin, end = times["from"], times["to"]
    if x_name == "time":
        return begin, end
    which = pattern_of(x_name, scene)
    if which is None:
        return None
    pattern = scene["patterns"][which]
    at = np.array([begin, *(t for t in pattern["times"] if begin < t < end), end])
    values = np.interp(at, pattern["times"], pattern["values"])
    falls = np.flatnonzero(np.diff(values) <= 0)
    return values[0], values[falls[0] if falls.size else -1]


def kind_of_new(path):
    """The test for which `delam new` has written a scene, "mmb" for example; nothing where something else has."""
    with open(path, encoding="utf-8", errors="replace") as file:
        begin = file.read(len(OF_NEW) + 16)
    return begin[len(OF_NEW):].partition(" ")[0] if begin.startswith(OF_NEW) else ""


class Infeasible(Exception):
    """The scene is none, or has no end, at these parameters; with the exit code of the analysis."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


@dataclass
class Answer:
    """All scenes at one set of values. curves: y at the data, an array for each scene; slopes[k]: its derivatives by
    parameter k at all data, or None where the analyses have none; rough[k]: how much of them is teeth, from 0 to 1."""
    curves: list
    slopes: list
    rough: list
    histories: list


def roughness(slope):
    """The part of a curve, from 0 to 1, that jumps from point to point: its deviation from the mean of both neighbours
    (Gasser, Sroka, Jennen-Steinmetz, Biometrika 73, 1986). That of a smooth curve with one corner is about 0.1."""
    active = np.flatnonzero(slope)
    part = slope[active[0]:] if active.size else slope
    if len(part) < 5 or not active.size:
        return 0.0
    jumps = part[1:-1] - 0.5 * (part[:-2] + part[2:])
    return float(min(1.0, np.sqrt(np.mean(jumps ** 2) / 1.5 / np.mean(part ** 2))))


class Model:
    """All scenes with their data."""

    def __init__(self, files, scenes, data, parameters, given):
        self.files, self.scenes, self.data, self.parameters = files, scenes, data, parameters
        self.common, self.work, self.jobs = given.set, os.path.join(given.out, "work"), given.jobs
        self.x_name, self.y_name = given.x, given.y
        self.analyses = 0
        self.fine = False
        self.jumps = [np.zeros(0)] * len(files)
        self.unknown = [0.0] * len(files)  # pairs that the derivatives leave out
        self.ways = [[] for _ in files]  # settings that follow the way of a test
        self.units = units_of_scene(scenes[0], self.common)
        for parameter in parameters:
            parameter.begin(files, scenes, self.common)
        starts = self._settings([p.start for p in parameters])
        self.times = []
        for which, path in enumerate(files):
            answer = Check(path, starts)
            if answer.errors:
                raise Trouble(answer.words)
            self.times.append(answer.found.get("time"))
            # Settings may change patterns.
            if self.times[-1] and not any(word.startswith("patterns") for word in starts):
                self._compare_ranges(which, range_of(self.x_name, scenes[which], self.times[-1]))
            if data[which].turns is not None:
                self._follow(which)

    def _settings(self, values):
        return self.common + [setting(p.path, float(v)) for p, v in zip(self.parameters, values)]

    # ---- load steps

    def _steps(self, which):
        """How many load steps the scene has; None where it names instants."""
        for word in reversed(self.common):
            if word.startswith("time"):
                return None if not word.startswith("time.steps=") else int(float(word.partition("=")[2]))
        steps = self.scenes[which].get("time", {}).get("steps")
        return steps if isinstance(steps, int) else None

    def _coarser(self, which):
        """Settings with fewer load steps, where there are many."""
        steps = self._steps(which)
        if self.ways[which] or self.fine or steps is None or steps < 2 * BEGIN_STEPS:
            return self.ways[which]
        return [f"time.steps={max(BEGIN_STEPS, steps // COARSER)}"]

    @property
    def y_unit(self):
        """The unit of the reaction after a blank, where the scene names its units."""
        length, force = self.units
        flat = self.scenes[0].get("geometry", {}).get("dimension", 2) == 2
        return f" {force}{f'/{length}' * flat}" if length and force and self.y_name.startswith("reaction") else ""

    @property
    def begins_coarse(self):
        return any(word.startswith("time.steps") for which in range(len(self.files)) for word in self._coarser(which))

    def _follow(self, which):
        """The load goes the way of the test: its turns are points of the pattern, and steps end there."""
        data, scene = self.data[which], self.scenes[which]
        place = pattern_of(self.x_name, scene)
        if place is None or len(scene["patterns"]) > 1:
            raise Trouble(f"{self.files[which]}: --loops follow needs a scene with one pattern, and --x load")
        low, high = range_of(self.x_name, scene, self.times[which])
        turns = np.concatenate([[low], data.turns[1:]])
        lengths = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(turns)))])
        data.at = data.at + np.abs(data.turns[1] - low) - np.abs(data.turns[1] - data.turns[0])
        per_step = (high - low) / (self._steps(which) or max(2, len(scene["time"].get("instants", [])) - 1))
        instants = [0.0]
        for begin, end in zip(lengths[:-1], lengths[1:]):
            count = max(1, int(np.ceil((end - begin) / per_step)))
            instants += [float(begin + (end - begin) * (k + 1) / count) for k in range(count)]
        listed = ", ".join(map(repr, instants))
        self.ways[which] = [f"patterns[{place}].times={list(map(float, lengths))!r}",
                            f"patterns[{place}].values={list(map(float, turns))!r}",
                            "time={ instants = [" + listed + "] }"]

    # ---- units

    def named_x(self, which):
        """The x of the data as people say it, and its unit after a blank."""
        if pattern_of(self.x_name, self.scenes[which]) is None:
            return self.x_name, ""
        length = units_of_scene(self.scenes[which], self.common)[0]
        return "displacement" if length else self.x_name, f" {length}" if length else ""

    def _compare_ranges(self, which, known):
        """Before an analysis: data in other units are noticed by their x."""
        if known is None:
            return
        data = self.data[which]
        name, unit = self.named_x(which)
        outside = data.drop_outside(*known, SLACK * (known[1] - known[0]))
        if outside:
            complain(f"warning: {data.path}: {outside} point{'s' * (outside > 1)} before a {name} of {known[0]:g}{unit} or behind "
                     f"{known[1]:g}{unit} {'are' if outside > 1 else 'is'} left out")
        self._require_within(which, *known)
        end = np.max(data.x)
        if end - known[0] < SMALL_PART * (known[1] - known[0]):
            complain(f"warning: {data.path}: the {name} ends at {end:g}{unit}, that of {self.files[which]} at "
                     f"{known[1]:g}{unit}: other units?")

    def _require_within(self, which, low, high):
        data = self.data[which]
        slack = 1e-9 * (high - low)
        if np.min(data.x) >= low - slack and np.max(data.x) <= high + slack:
            return
        name, unit = self.named_x(which)
        said = (f"{data.path}: the {name} ({data.names[0]}) goes from {np.min(data.x):g} to {np.max(data.x):g}{unit}, that of "
                f"{self.files[which]} from {low:g} to {high:g}{unit}: ")
        if np.max(data.x) <= high + slack:
            raise Trouble(said + "leave out the points before it, or --slack and --x-scale move and scale it")
        farther = ("give it a later end ([time] end)" if self.x_name == "time" else
                   "let the values of its [[patterns]] go on to there")
        if kind_of_new(self.files[which]):
            farther = ("write the scene with a larger growth of the crack (`delam new .. --growth`) or, if that is not "
                       "allowed, with a larger toughness")
        raise Trouble(said + farther + ", or leave out the points behind it; are the units the same? Else --x-scale is a "
                      "factor on it")

    def compare_slopes(self, curves):
        """After the first analysis: data of another sign are refused, and those in other units noticed by how they begin to rise."""
        for data, curve, path, scene in zip(self.data, curves, self.files, self.scenes):
            if data.opposes(curve):
                raise Trouble(f"{data.path}: its loads and the {self.y_name} of {path} have opposite signs: a --scale below 0 "
                              "makes the loads negative")
            ratio = data.slope_over(curve)
            if ratio is None or 1 / DIFFERS < ratio < DIFFERS:
                continue
            length, force = units_of_scene(scene, self.common)
            flat = scene.get("geometry", {}).get("dimension", 2) == 2
            unit = data.force_unit if kind_of(data.force_unit)[0] == "force" else ""
            said = (f"{data.path}: its loads begin to rise {ratio:.4g} times as steeply as the {self.y_name} of {path}, which is "
                    + (f"in {force}{f' per {length} of width' if flat else ''}: " if length and force else
                       f"a force{' per width' if flat else ''}: ")
                    + ("is the width of the specimen right (for example --width 25mm), " if flat else "is it a part of the specimen, ")
                    + (f"are the loads in {unit}" if unit else "are the loads in the unit of the scene (the file names none)")
                    + ", and the displacements in its unit? Else --scale and --x-scale are factors on the data")
            if not 1 / STIFFER < ratio < STIFFER:
                raise Trouble(said + "; or the parameters start too far away")
            if all(p.of_law for p in self.parameters):
                complain("warning: " + said)

    # ---- analyses

    def _analyse(self, which, name, settings):
        out = os.path.join(self.work, f"{which + 1}-{name}")
        code = analyse(self.files[which], out, settings + ["output.fields=[]", "output.brief=true"])
        self.analyses += 1
        if code == INTERRUPTED:
            raise KeyboardInterrupt
        if code < 0:
            raise Trouble(f"{self.files[which]}: the analysis was ended by signal {-code}", NUMERICAL)
        if code not in (DONE, NOT_CONVERGED, WRONG, NUMERICAL):
            raise Trouble(f"{self.files[which]}: {last_words(out)}", code)
        if code not in (DONE, NOT_CONVERGED):
            raise Infeasible(last_words(out), code)
        return read_history(out)

    def _column(self, history, name, which):
        if name not in history:
            raise Trouble(f"{self.files[which]}: the history has no column \"{name}\"; it has: {', '.join(history)}")
        return history[name]

    def _at_data(self, which, history, y):
        """Between the steps, straight lines."""
        data = self.data[which]
        if data.turns is not None:
            return np.interp(data.at, history["time"], y)
        x = self._column(history, self.x_name, which)
        rising = np.flatnonzero(np.diff(x) <= 0)
        x, y = (x[:rising[0] + 1], y[:rising[0] + 1]) if rising.size else (x, y)
        self._require_within(which, x[0], x[-1])
        return np.interp(data.x, x, y)

    def curve_with(self, which, name, values, more):
        """The curve of one scene at the parameters and with other numbers of the scene, by key; Infeasible where there is
        no answer. It is none of the points of the search, but takes steps and rotations as they do."""
        settings = self._settings(values) + [setting(key, float(value)) for key, value in more.items()] + self._coarser(which)
        history = self._analyse(which, name, settings + self._followed())
        return self._at_data(which, history, self._column(history, self.y_name, which))

    def _followed(self):
        """What asks for derivatives; with them, steps are taken whole and rotations stay small."""
        keys = [p.path for p in self.parameters if p.of_law]
        return [f"output.sensitivities={keys}"] if keys and self.y_name.startswith("reaction") else []

    def _curve(self, job):
        """One scene: its curve, derivatives and history."""
        which, values = job
        settings = self._settings(values) + self._coarser(which)
        asked = self._followed()
        history = self._analyse(which, "at", settings + asked)
        y = self._at_data(which, history, self._column(history, self.y_name, which))
        self.jumps[which] = self._column(history, self.x_name, which)[history["jumps"] > 0]
        self.unknown[which] = float(history["sensitivities_unknown"][-1]) if asked else 0.0
        slopes, rough = [], []
        for parameter in self.parameters:
            slope = history[f"{self.y_name}/{parameter.path}"] if parameter.of_law and asked else None
            slopes.append(None if slope is None else self._at_data(which, history, slope))
            rough.append(0.0 if slope is None else roughness(slope))
        return y, slopes, rough, history

    def evaluate(self, values):
        """All scenes; Infeasible where one has no answer."""
        with ThreadPoolExecutor(self.jobs) as pool:
            found = list(pool.map(self._curve, [(which, values) for which in range(len(self.files))]))
        slopes = [None if any(part is None for part in parts) else np.concatenate(parts)
                  for parts in zip(*(one[1] for one in found))]
        return Answer([one[0] for one in found], slopes, [max(parts) for parts in zip(*(one[2] for one in found))],
                      [one[3] for one in found])
