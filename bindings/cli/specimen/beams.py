# SPDX-License-Identifier: BSD-3-Clause
"""Corrected beam theory of the tests: loads per width and displacements while the crack grows, in N and mm.

E is the modulus along the arm, G the shear modulus, h the thickness of an arm, a the crack. The lengths chi h and 0.42
chi h account for the rotation and the shear at the crack tip (J. G. Williams, J. Strain Anal. 24, 1989; Y. Wang, J. G.
Williams, Compos. Sci. Technol. 43, 1992), as ISO 15024 and ASTM D6671 have them. Each test returns G_I and G_II at the
load 1, and the displacement of the load at the load 1."""
import math

SHEAR = 5 / 6  # of the area of a rectangle


def chi(of):
    gamma = 1.18 * math.sqrt(of.e1 * of.e2) / of.g13
    return math.sqrt(of.e1 / (11 * of.g13) * (3 - 2 * (gamma / (1 + gamma)) ** 2))


def dcb(of, a):
    """Opened by the load at the end of each arm; the displacement is that of the arms from each other."""
    return adcb(of, a, (of.arm, of.arm))


def adcb(of, a, arms=None):
    """Arms of two thicknesses. The bending of each releases its own energy; how much of it is mode II depends on how the
    modes are told apart, so that all is taken as mode I here."""
    arms = arms or (of.arm, of.lower_arm)
    long = [a + chi(of) * h for h in arms]
    return (sum(6 * x ** 2 / (of.e1 * h ** 3) for x, h in zip(long, arms)), 0.0,
            sum(4 * x ** 3 / (of.e1 * h ** 3) for x, h in zip(long, arms)))


def _bending(of, a):
    """Of a beam on two supports, of which the crack takes a from one: displacement under the load in its middle."""
    span, h = of.half_span, of.arm
    return (2 * span ** 3 + 3 * a ** 3) / (8 * of.e1 * h ** 3) + span / (4 * SHEAR * of.g13 * h)


def enf(of, a):
    long = a + 0.42 * chi(of) * of.arm
    return 0.0, 9 * long ** 2 / (16 * of.e1 * of.arm ** 3), _bending(of, long)


def four_point(of, a):
    """The moment between the noses is constant, and so is the energy release rate (Martin and Davidson 1999)."""
    h, arm = of.arm, (of.span - of.inner_span) / 2
    whole = arm ** 2 * (3 * of.span - 4 * arm) / (8 * of.e1 * h ** 3) + arm / (4 * SHEAR * of.g13 * h)
    return (0.0, 9 * arm ** 2 / (16 * of.e1 * h ** 3),
            whole + 3 * arm ** 3 / (8 * of.e1 * h ** 3) + 9 * arm ** 2 * (a - arm) / (8 * of.e1 * h ** 3))


def mmb(of, a):
    """ASTM D6671: the lever splits its load into that of a DCB and that of an ENF."""
    h, half, c, x = of.arm, of.half_span, of.lever, chi(of)
    one, two = (3 * c - half) / (4 * half), (c + half) / half
    long = a + 0.42 * x * h
    return (12 * (one * (a + x * h)) ** 2 / (of.e1 * h ** 3) if one > 0 else 0.0,
            9 * (two * long) ** 2 / (16 * of.e1 * h ** 3),
            8 * one ** 2 * (a + x * h) ** 3 / (of.e1 * h ** 3) + two ** 2 * _bending(of, long))


def slb(of, a):
    """Single leg bending (B. D. Davidson, V. Sundararaman, Int. J. Fract. 78, 1996), arms of one thickness."""
    h, x = of.arm, chi(of)
    one, two = a + x * h, a + 0.42 * x * h
    bend = of.half_span ** 3 / (4 * of.e1 * h ** 3) + of.half_span / (4 * SHEAR * of.g13 * h)
    return (12 * one ** 2 / (16 * of.e1 * h ** 3), 9 * two ** 2 / (16 * of.e1 * h ** 3),
            bend + (4 * one ** 3 + 3 * two ** 3) / (8 * of.e1 * h ** 3))


THEORY = {"dcb": dcb, "adcb": adcb, "enf": enf, "4enf": four_point, "mmb": mmb, "slb": slb}


def toughness(of, mixity):
    """Benzeggagh and Kenane: at the share of mode II in the energy release rate."""
    return of.gic + (of.giic - of.gic) * mixity ** of.eta


def growth(of, a):
    """(load per width, displacement of the load, share of mode II) with which the crack grows at the length a."""
    one, two, compliance = THEORY[of.kind](of, a)
    mixity = two / (one + two)
    load = math.sqrt(toughness(of, mixity) / (one + two))
    return load, load * compliance, mixity
