# SPDX-License-Identifier: BSD-3-Clause
"""What a method says of a test: the toughness along the growth of the crack, at any point of the curve, and its numbers."""
import numpy as np

from scatter.spread import Nothing

# Numbers of methods: unit in SI, the unit in which people read them, and its size.
UNITS = {"offset": ("m", "mm", 1e-3), "n": ("", "", 1.0), "A1": ("(N/m)^(1/3)", "(N/mm)^(1/3)", 10.0),
         "A": ("m/N", "mm/N", 1e-3), "m": ("1/(N m2)", "1/(N mm2)", 1e6), "chi": ("", "", 1.0),
         "bending modulus": ("Pa", "GPa", 1e9), "mode II share": ("", "", 1.0)}


class Answer:
    """where, crack, rate: arrays in SI, the R-curve; at_any(displacement, load, crack): the rate; numbers: by the names of
    UNITS; grown: places of the marks whose crack is longer than the notch; loads: those of the R-curve, where the mean of marks
    depends on the curve; spread: how much of the toughness is chance (scatter/spread.py)."""

    def __init__(self, name, where, crack, rate, at_any, numbers, grown=(), spread=None, loads=None):
        self.name, self.where, self.crack, self.rate = name, where, crack, rate
        self._at_any, self.numbers, self._grown, self._loads = at_any, numbers, grown, loads
        self.spread = spread or Nothing()

    def at(self, point, zero):
        """The toughness at a point of the curve whose initial line begins at the displacement zero."""
        return float(self._at_any(*(np.array([x]) for x in (point.displacement - zero, point.load, point.crack)))[0])

    def propagation(self):
        """Mean, standard deviation and number of the marks of a crack that has grown; None: there are fewer than 3."""
        if len(self._grown) < 3:
            return None
        rates = self.rate[self._grown]
        return float(np.mean(rates)), float(np.std(rates, ddof=1)), len(rates)

    def mean_over(self, other):
        """The mean that this method has at the marks of the propagation of another answer."""
        return float(np.mean(self._at_any(other.where, other._loads, other.crack)[other._grown]))

    def units(self):
        """Of the numbers as they are kept."""
        return {name: UNITS[name][0] for name in self.numbers}

    def words(self):
        """The numbers with their units, as people read them."""
        return [f"{name} {value / UNITS[name][2]:.4g} {UNITS[name][1]}".rstrip() for name, value in self.numbers.items()]
