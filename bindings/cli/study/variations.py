# SPDX-License-Identifier: BSD-3-Clause
"""What a sweep varies: `KEY=200:400:5`, `KEY=1:1000:4:log`, `KEY=100,250,400`, `KEY=local,energetic`."""
import itertools
import math
import tomllib

from _pictures.input_file import quoted
from command import loading
from analyses import Trouble, number_in, path_of
from packages import require


MOST_VALUES = 1000000  # of all keys in all runs
LARGEST_WHOLE = 2 ** 63  # integers of TOML are smaller


def require_number_of_values(count, what):
    """Before the list is made."""
    if count > MOST_VALUES:
        raise Trouble(f"{what}: {count:.7g} values: at most {MOST_VALUES} are allowed, those of all keys in all runs")


class Variation:
    """A key and its values; of a range without a number of values, its ends alone (for --latin)."""

    def __init__(self, text):
        key, sign, values = text.partition("=")
        if not sign or not key or not values:
            raise Trouble(f"--vary {quoted(text)}: KEY=FROM:TO:NUMBER or KEY=A,B,C is expected")
        self.path, self.text = path_of(key), text
        parts = values.split(":")
        self.log = parts[-1] == "log"
        if self.log:
            parts.pop()
        self.ends, self.values, self.whole = None, None, False
        if len(parts) == 1 and not self.log:
            require_number_of_values(values.count(",") + 1, f"--vary {self.path}")
            self.values = [self._value(word) for word in parts[0].split(",")]
        elif len(parts) in (2, 3):
            self._range(parts)
        else:
            raise Trouble(f"--vary {quoted(text)}: FROM:TO:NUMBER, FROM:TO:NUMBER:log, or FROM:TO with --latin")

    def _value(self, word):
        if not word:
            raise Trouble(f"--vary {quoted(self.text)}: a value is empty")
        try:
            number = float(word)
        except ValueError:
            number = math.nan
        if not math.isnan(number):
            number_in(word, f"--vary {self.path}")
            if any(c in word for c in ".eE"):
                return number
            if abs(number) >= LARGEST_WHOLE:
                raise Trouble(f"--vary {self.path}: {quoted(word)}: a whole number below 2^63 is expected, or 1e20 for a "
                              "number with digits after the point")
            return int(word)
        # As --set reads it: a word that is no TOML value and begins with a letter is a text.
        try:
            tomllib.loads(f"value = {word}")
        except (ValueError, RecursionError) as error:
            if not word[0].isalpha():
                raise Trouble(f"--vary {self.path}: {quoted(word)} is no value: a grid is written FROM:TO:NUMBER, like 0.3:0.7:5, "
                              "and a list A,B,C, like 0.3,0.5,0.7") from error
        return word

    def _range(self, parts):
        where = f"--vary {self.path}"
        low, high = number_in(parts[0], where), number_in(parts[1], where)
        try:
            count = int(parts[2]) if len(parts) == 3 else None
        except ValueError:
            raise Trouble(f"{where}: {quoted(parts[2])}: a whole number of values is expected") from None
        if low >= high or (self.log and low <= 0):
            raise Trouble(f"--vary {quoted(self.text)}: the first number must be less than the second"
                          + (", and more than 0 for log" if self.log else ""))
        if count is not None and count < 2:
            raise Trouble(f"--vary {quoted(self.text)}: at least 2 values are expected")
        if count is not None:
            require_number_of_values(count, where)
        self.ends = (low, high)
        # Numbers of cells or steps stay whole.
        self.whole = (not any(c in word for word in parts[:2] for c in ".eE") and not self.log
                      and max(abs(low), abs(high)) < LARGEST_WHOLE)
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
    require_number_of_values(len(variations) * math.prod(len(variation.values) for variation in variations), "--vary")
    return list(itertools.product(*(variation.values for variation in variations)))


def latin(variations, count, seed):
    """Latin hypercube: of `count` equal parts of each range, each holds one point."""
    require("scipy")
    with loading():
        from scipy.stats import qmc  # here alone, for it takes half a second to load
    if count < 1:
        raise Trouble(f"--latin {count}: at least 1 is expected")
    for variation in variations:
        if variation.ends is None:
            raise Trouble(f"--vary {variation.text}: --latin takes ranges, FROM:TO")
    require_number_of_values(count * len(variations), f"--latin {count}")
    points = qmc.LatinHypercube(d=len(variations), seed=seed).random(count)
    return [tuple(variation.at(float(share)) for variation, share in zip(variations, point)) for point in points]
