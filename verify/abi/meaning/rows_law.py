# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and defaults of laws."""
import ctypes
import math

import forms
import scenes
from host import Out
from table import row

STIFFNESS, ONSET, TOUGHNESS = (200.0, 50.0), (0.3, 0.5), (1.2, 3.0)  # normal, tangential
MIXITIES = [0.0, 0.15, 0.4, 0.7, 1.0]


def see_toughness(host, see, law, expected):
    """expected(normal, tangential, mixity)."""
    onset, total = host("law_toughness", law, len(MIXITIES), MIXITIES, Out(len(MIXITIES)), Out(len(MIXITIES)))
    see.near("onset", onset, [expected(*ONSET, b) for b in MIXITIES], "F/L")
    see.near("toughness", total, [expected(*TOUGHNESS, b) for b in MIXITIES], "F/L")


@row("default criterion and exponents",
     tells=["law_toughness mixity", "law_toughness onset", "law_toughness toughness"],
     says=["law_create: valoroso-champaney (default)", "law_create: default 2"])
def criterion(host, see):
    law = scenes.bilinear(host, STIFFNESS, ONSET, TOUGHNESS)
    see_toughness(host, see, law, forms.toughness)
    for k, key in enumerate(("onset_exponent_1", "onset_exponent_2", "toughness_exponent_1", "toughness_exponent_2")):
        own = scenes.bilinear(host, STIFFNESS, ONSET, TOUGHNESS)
        host("law_set", own, key, 3.0)
        exponents = [3.0 if i == k else 2.0 for i in range(4)]
        onset, total = host("law_toughness", own, 5, MIXITIES, Out(5), Out(5))
        see.near(f"{key} = 3", [onset, total],
                 [[forms.toughness(*ONSET, b, *exponents[:2]) for b in MIXITIES],
                  [forms.toughness(*TOUGHNESS, b, *exponents[2:]) for b in MIXITIES]], "F/L")


@row("default exponents of the power criterion")
def power(host, see):
    law = scenes.bilinear(host, STIFFNESS, ONSET, TOUGHNESS)
    host("law_set", law, "onset_exponent_1", 3.0)
    host("law_set_text", law, "criterion", "power")
    see_toughness(host, see, law, forms.toughness)


@row("default exponents of Benzeggagh and Kenane")
def benzeggagh_kenane(host, see):
    law = scenes.bilinear(host, STIFFNESS, ONSET, TOUGHNESS)
    host("law_set_text", law, "criterion", "benzeggagh-kenane")
    see_toughness(host, see, law, lambda n, t, b: n + (t - n) * b * b)


def responses(dimension):
    count = 5
    jumps = [[0.05 + 0.01 * k] + [c * 0.1 for c in forms.numbers(dimension - 1, 70 + k)] for k in range(count)]
    old = [1.0, 0.95, 0.2, 0.9, 0.3]
    mixities = [0.1, 0.6, 0.3, 0.9, 0.45]
    expected, pulls = [], []
    for jump, zeta_old, b in zip(jumps, old, mixities):
        driving = 0.5 * STIFFNESS[0] * jump[0] ** 2 + 0.5 * STIFFNESS[1] * forms.dot(jump[1:], jump[1:])
        zeta = min(zeta_old, forms.bilinear(forms.toughness(*ONSET, b), forms.toughness(*TOUGHNESS, b), driving))
        expected.append(zeta)
        pulls.append([zeta * STIFFNESS[0] * jump[0]] + [zeta * STIFFNESS[1] * c for c in jump[1:]])
    return jumps, mixities, old, expected, pulls


@row("response of a law", tells=["law_respond jump", "law_respond mixity", "law_respond adhesion_old",
                                 "law_respond adhesion", "law_respond traction"])
def respond(host, see):
    law = scenes.bilinear(host, STIFFNESS, ONSET, TOUGHNESS)
    for dimension in (2, 3):
        jumps, mixities, old, expected, pulls = responses(dimension)
        adhesion, traction = host("law_respond", law, dimension, 5, [c for j in jumps for c in j], mixities, old,
                                  Out(5), Out(5 * dimension))
        see.near(f"adhesion in {dimension}D", adhesion, expected)
        see.near(f"traction in {dimension}D", traction, pulls, "F/L2")


@row("softening table", tells=["law_set_table xi", "law_set_table s"])
def softening(host, see):
    """The traction is the peak times s, the area Gc."""
    xi, s = [0.0, 0.2, 0.7, 1.0], [1.0, 0.5, 0.2, 0.0]
    law = scenes.bilinear(host, STIFFNESS, ONSET, TOUGHNESS, "tabulated")
    host("law_set_table", law, 4, xi, s)
    first = math.sqrt(2 * ONSET[0] / STIFFNESS[0])
    peak = STIFFNESS[0] * first
    area = sum((b - a) * (p + q) / 2 for a, b, p, q in zip(xi, xi[1:], s, s[1:]))
    longest = (TOUGHNESS[0] / peak - first / 2) / area
    places = [0.1, 0.35, 0.5, 0.9]
    jumps = [first + p * longest for p in places]
    wanted = [1 - 0.5 * p / 0.2 if p <= 0.2 else 0.5 - 0.3 * (p - 0.2) / 0.5 if p <= 0.7 else 0.2 * (1 - p) / 0.3
              for p in places]
    traction = host("law_respond", law, 2, 4, [c for j in jumps for c in (j, 0.0)], [0.0] * 4, [1.0] * 4, Out(4),
                    Out(8))[1]
    see.near("traction", traction[::2], [peak * w for w in wanted], "F/L2")


@row("gradient of a law by default", says=["law_create: default 0"])
def gradient(host, see):
    """Two pairs with adhesion 1/2 and 1 store only zeta Y: nothing for their difference."""
    law = scenes.bilinear(host, (200.0, 50.0), (0.3, 0.5), (1.2, 3.0))
    bar = scenes.Bar(host, law)
    host("solver_equilibrate", bar.solver, 0.05, [0.5, 1.0])
    jumps = scenes.field(host, bar.solver, "jump")
    driving = [0.5 * 200.0 * j[0] ** 2 for j in jumps]
    see.near("stored_interface", bar.value("stored_interface"), 0.5 * (0.5 * driving[0] + driving[1]), "F L")
    host("law_set", law, "gradient", 0.1)
    other = scenes.Bar(host, law)
    host("solver_equilibrate", other.solver, 0.05, [0.5, 1.0])
    # kappa/2 |grad zeta|^2 over the interface of length 1.
    see.near("stored_interface with gradient 0.1", other.value("stored_interface"),
             0.5 * (0.5 * driving[0] + driving[1]) + 0.5 * 0.1 * 0.25, "F L")


@row("bounds of parameters", tells=["law_parameter_bounds lower", "law_parameter_bounds upper",
                                    "law_parameter_bounds lower_open", "law_parameter_bounds upper_open",
                                    "law_kind_info hosted"])
def bounds(host, see):
    """plateau lies in [0, 1): what is refused, and what the bounds say."""
    for index in range(host("law_parameter_count", "trapezoidal")):
        if host("law_parameter_info", "trapezoidal", index, Out(), None, None, None, None, None)[0] == "plateau":
            see.near("plateau: lower, upper, lower_open, upper_open",
                     host("law_parameter_bounds", "trapezoidal", index, Out(), Out(), Out(), Out()), [0.0, 1.0, 0, 1])
    law = host("law_create", host.context, "trapezoidal", Out())
    see.equal("statuses at 0, 0.999, 1 and -0.001",
              [host.status("law_set", law, "plateau", p) for p in (0.0, 0.999, 1.0, -0.001)], [0, 0, -1, -1])
    others = [host("law_create", host.context, kind, Out()) for kind in ("piecewise-linear", "exponential", "tabulated",
                                                                         "griffith")]
    see.equal("statuses of a plateau of the other kinds",
              [host.status("law_set", own, "plateau", 0.5) for own in others], [-1] * 4)
    hosted = [host("law_kind_info", k, Out(), None, Out()) for k in range(host("law_kind_count"))]
    see.equal("kinds that take callbacks", [flag for *_, flag in hosted], [name == "host" for name, *_ in hosted])


@row("callbacks of a law", tells=["delam_adhesion_callback", "delam_dissipation_callback"])
def callbacks(host, see):
    """A bilinear law of the host, whose toughness depends on the mixity: what the callbacks get and give."""
    double = ctypes.POINTER(ctypes.c_double)
    parameters = lambda b: (forms.toughness(*ONSET, b), forms.toughness(*TOUGHNESS, b))

    def adhesion(mixity, driving, zeta, slope, _user):
        onset, total = parameters(mixity)
        zeta[0] = forms.bilinear(onset, total, driving)
        inside = 0 < zeta[0] < 1
        slope[0] = -0.5 * total * math.sqrt(onset / driving) / driving / (total - onset) if inside else 0.0
        return 0

    def dissipation(mixity, zeta, dissipated, slope, mixity_slope, _user):
        onset, total = parameters(mixity)
        dissipated[0] = forms.bilinear_dissipated(onset, total, zeta)
        slope[0] = -total * total * onset / (onset + (total - onset) * zeta) ** 2
        step = 1e-5
        low, high = max(mixity - step, 0.0), min(mixity + step, 1.0)
        ends = [forms.bilinear_dissipated(*parameters(b), zeta) for b in (low, high)]
        mixity_slope[0] = (ends[1] - ends[0]) / (high - low)
        return 0

    given, results = [ctypes.c_int32, ctypes.c_double, ctypes.c_double], [double, double]
    first = ctypes.CFUNCTYPE(*given, *results, ctypes.c_void_p)(adhesion)
    second = ctypes.CFUNCTYPE(*given, *results, double, ctypes.c_void_p)(dissipation)
    host.kept += [first, second]
    law = host("law_create_host", host.context, "bilinear of the table", first, second, None, Out())
    for direction, number in zip(("normal", "tangential"), STIFFNESS):
        host("law_set", law, f"{direction}_stiffness", number)
    jumps, mixities, old, expected, pulls = responses(3)
    found = host("law_respond", law, 3, 5, [c for j in jumps for c in j], mixities, old, Out(5), Out(15))
    see.near("adhesion", found[0], expected)
    see.near("traction", found[1], pulls, "F/L2")
    see_toughness(host, see, law, forms.toughness)
