# SPDX-License-Identifier: BSD-3-Clause
"""What a sweep varies: `KEY=200:400:5`, `KEY=1:1000:4:log`, `KEY=100,250,400`, `KEY=local,energetic`."""
import itertools
import tomllib

import numpy as np

from marches import Trouble, path_of
from packages import require


class Variation:
    """A key and its values; of a range without a number of values, its ends alone (for --latin)."""

    def __init__(self, text):
        key, sign, values = text.partition("=")
        if not sign or not key or not values:
            raise Trouble(f"--vary {text}: KEY=FROM:TO:NUMBER or KEY=A,B,C is expected")
        self.path, self.text = path_of(key), text
        parts = values.split(":")
        self.log = parts[-1] == "log"
        if self.log:
            parts.pop()
        self.ends, self.values, self.whole = None, None, False
        if len(parts) == 1 and not self.log:
            self.values = [self._value(word) for word in parts[0].split(",")]
        elif len(parts) in (2, 3):
            self._range(parts)
        else:
            raise Trouble(f"--vary {text}: FROM:TO:NUMBER, FROM:TO:NUMBER:log, or FROM:TO with --latin")

    def _value(self, word):
        if not word:
            raise Trouble(f"--vary {self.text}: a value is empty")
        try:
            return float(word) if any(c in word for c in ".eE") else int(word)
        except ValueError:
            pass
        # As --set reads it: a word that is no TOML value and begins with a letter is a text.
        try:
            tomllib.loads(f"value = {word}")
        except tomllib.TOMLDecodeError as error:
            if not word[0].isalpha():
                raise Trouble(f"--vary {self.text}: \"{word}\" is no value: a grid is written FROM:TO:NUMBER, like 0.3:0.7:5, "
                              "and a list A,B,C, like 0.3,0.5,0.7") from error
        return word

    def _range(self, parts):
        try:
            low, high = float(parts[0]), float(parts[1])
            count = int(parts[2]) if len(parts) == 3 else None
        except ValueError as error:
            raise Trouble(f"--vary {self.text}: numbers are expected, {error}") from error
        if not np.isfinite([low, high]).all() or low >= high or (self.log and low <= 0):
            raise Trouble(f"--vary {self.text}: the first number must be less than the second"
                          + (", and more than 0 for log" if self.log else ""))
        if count is not None and count < 2:
            raise Trouble(f"--vary {self.text}: at least 2 values are expected")
        self.ends = (low, high)
        # Numbers of cells or steps stay whole.
        self.whole = not any(c in word for word in parts[:2] for c in ".eE") and not self.log
        if count is not None:
            self.whole = self.whole and (int(parts[1]) - int(parts[0])) % (count - 1) == 0
            self.values = [self.at(k / (count - 1)) for k in range(count)]

    def at(self, share):
        """The value at a share of the way, 0 to 1; the ends exactly."""
        low, high = self.ends
        if self.whole:
            return round(low + (high - low) * share)
        if share in (0.0, 1.0):
            return (low, high)[int(share)]
        return low * (high / low) ** share if self.log else low + (high - low) * share


def grid(variations):
    """Every combination, the last key fastest."""
    for variation in variations:
        if variation.values is None:
            raise Trouble(f"--vary {variation.text}: give a number of values, FROM:TO:NUMBER, or --latin")
    return list(itertools.product(*(variation.values for variation in variations)))


def latin(variations, count, seed):
    """Latin hypercube: of `count` equal parts of each range, each holds one point."""
    require("delam: sweep", "scipy")
    from scipy.stats import qmc  # here alone, for it takes half a second to load
    if count < 1:
        raise Trouble(f"--latin {count}: at least 1 is expected")
    for variation in variations:
        if variation.ends is None:
            raise Trouble(f"--vary {variation.text}: --latin takes ranges, FROM:TO")
    points = qmc.LatinHypercube(d=len(variations), seed=seed).random(count)
    return [tuple(variation.at(float(share)) for variation, share in zip(variations, point)) for point in points]
