# SPDX-License-Identifier: BSD-3-Clause
"""What a fit compares with the data: marches at given parameters, with the derivatives by them.

Numbers of laws get the derivatives of the march itself ([output] sensitivities); any other number of the scene central
differences of two more marches.
"""
import os
import re
import tomllib
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from _pictures.input_file import MOST_SCENE, quoted, read_text
from command import complain
from marches import (DONE, INTERRUPTED, NOT_CONVERGED, NUMERICAL, WRONG, Check, Trouble, finish, last_words, number_in,
                     path_of, read_history, setting, start, value_at)

SMALL_PART = 0.05  # of the range of a scene: less is covered by curves in metres, centimetres, inches for millimetres
DIFFERENCE = 1e-3  # of a parameter without derivatives; far above what an unconverged digit moves


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
            raise Trouble(f"--parameters {said.pop().removeprefix('--set: ')}")


def range_of(x_name, scene, times):
    """From where to where a column of the history grows at least, as far as the scene tells; None: it does not."""
    begin, end = times["from"], times["to"]
    if x_name == "time":
        return begin, end
    patterns = scene.get("patterns", [])
    names = ["load"] if len(patterns) == 1 else [f"load_{pattern['name']}" for pattern in patterns]
    if x_name not in names:
        return None
    pattern = patterns[names.index(x_name)]
    at = np.array([begin, *(t for t in pattern["times"] if begin < t < end), end])
    values = np.interp(at, pattern["times"], pattern["values"])
    falls = np.flatnonzero(np.diff(values) <= 0)
    return values[0], values[falls[0] if falls.size else -1]


class Infeasible(Exception):
    """The scene is none, or has no end, at these parameters; with the exit code of the march."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


class Model:
    """All scenes with their data."""

    def __init__(self, scenes, data, parameters, given):
        self.files, self.data, self.parameters = scenes, data, parameters
        self.common, self.work, self.jobs = given.set, os.path.join(given.out, "work"), given.jobs
        self.x_name, self.y_name = given.x, given.y
        self.marches = 0
        self.jumps = [np.zeros(0)] * len(scenes)
        self.unknown = [0.0] * len(scenes)  # pairs that the derivatives leave out
        parsed = []
        for path in scenes:
            try:
                parsed.append(tomllib.loads(read_text(path, MOST_SCENE)))
            except FileNotFoundError as error:
                raise Trouble(f"{path}: cannot be read: {error.strerror}") from error
            except RecursionError:
                raise Trouble(f"{path}: tables and lists lie within each other too deeply") from None
            except ValueError as error:  # of TOML, or a number of thousands of digits
                raise Trouble(f"{path}: {error}") from error
        for parameter in parameters:
            parameter.begin(scenes, parsed, self.common)
        starts = self._settings([p.start for p in parameters])
        for which, path in enumerate(scenes):
            answer = Check(path, starts)
            if answer.errors:
                raise Trouble(answer.words)
            # Settings may change patterns.
            if "time" in answer.found and not any(word.startswith("patterns") for word in starts):
                self._compare_ranges(which, range_of(self.x_name, parsed[which], answer.found["time"]))

    def _settings(self, values):
        return self.common + [setting(p.path, float(v)) for p, v in zip(self.parameters, values)]

    def _compare_ranges(self, which, known):
        """Before a march: data in other units are noticed by their x."""
        if known is None:
            return
        data = self.data[which].x
        self._require_within(which, *known)
        if data[-1] - known[0] < SMALL_PART * (known[1] - known[0]):
            complain(f"warning: {self.data[which].path}: {self.x_name} ends at {data[-1]:g}, that of {self.files[which]} at "
                     f"{known[1]:g}: other units?")

    def _require_within(self, which, low, high):
        data = self.data[which].x
        slack = 1e-9 * (high - low)
        if data[0] < low - slack or data[-1] > high + slack:
            raise Trouble(f"{self.data[which].path}: {self.x_name} goes from {data[0]:g} to {data[-1]:g}, that of "
                          f"{self.files[which]} from {low:g} to {high:g}: other units? Else give the scene a longer time, or "
                          "less data")

    def _march(self, which, name, settings):
        out = os.path.join(self.work, f"{which + 1}-{name}")
        code = finish(start(self.files[which], out, settings))
        self.marches += 1
        if code == INTERRUPTED:
            raise KeyboardInterrupt
        if code < 0:
            raise Trouble(f"{self.files[which]}: the march was ended by signal {-code}", NUMERICAL)
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
        x = self._column(history, self.x_name, which)
        rising = np.flatnonzero(np.diff(x) <= 0)
        x, y = (x[:rising[0] + 1], y[:rising[0] + 1]) if rising.size else (x, y)
        self._require_within(which, x[0], x[-1])
        return np.interp(self.data[which].x, x, y)

    def _curve(self, job):
        """The model and its derivatives at the data of one scene."""
        which, values = job
        settings = self._settings(values)
        followed = [p.path for p in self.parameters if p.of_law]
        asked = [f"output.sensitivities={followed}"] if followed and self.y_name.startswith("reaction") else []
        history = self._march(which, "at", settings + asked)
        y = self._at_data(which, history, self._column(history, self.y_name, which))
        self.jumps[which] = self._column(history, self.x_name, which)[history["jumps"] > 0]
        self.unknown[which] = float(history["sensitivities_unknown"][-1]) if asked else 0.0
        slopes = []
        for k, parameter in enumerate(self.parameters):
            if parameter.of_law and asked:
                slope = history[f"{self.y_name}/{parameter.path}"]
                slopes.append(self._at_data(which, history, slope))
                continue
            step = DIFFERENCE * values[k]
            ends = []
            for sign in (1, -1):
                moved = [v + (sign * step if p is parameter else 0.0) for p, v in zip(self.parameters, values)]
                there = self._march(which, "near", self._settings(moved))
                ends.append(self._at_data(which, there, self._column(there, self.y_name, which)))
            slopes.append((ends[0] - ends[1]) / (2 * step))
        return y, np.array(slopes).T

    def evaluate(self, values):
        """Model and Jacobian at all data; Infeasible where a scene has none."""
        with ThreadPoolExecutor(self.jobs) as pool:
            curves = list(pool.map(self._curve, [(which, values) for which in range(len(self.files))]))
        return [y for y, _ in curves], np.vstack([slopes for _, slopes in curves])
