# SPDX-License-Identifier: BSD-3-Clause
"""The specimens of chapter (h): mixed-mode bending, ENF and DCB of IM7/8552, by the Python package with its default
options; their corrected beam theory (ASTM D6671); and what a march of one shows."""
import dataclasses
import math
import types

import numpy as np

E1, E2, G12, NU12, NU23 = 161e9, 11.38e9, 5.17e9, 0.32, 0.44
ARM, SPAN, LENGTH, NOTCH = 2.25e-3, 50.4e-3, 126.6e-3, 25.4e-3  # m; SPAN: half of the distance of the rollers
MODE_I, MODE_II, EXPONENT = 212.0, 774.0, 2.1                   # J/m2; Benzeggagh and Kenane
STIFFNESS, NORMAL = 1e15, 60e6                                  # N/m3, Pa
TURON = NORMAL * math.sqrt(MODE_II / MODE_I)                    # the strength in shear that keeps the mixity
PATCH = 1e-3                                                    # m, of rollers and noses
VALUES = ("load:press", "reaction:press", "stored_bulk", "stored_interface", "dissipated", "work", "lower", "increment",
          "increment_lower", "upper", "released", "defect", "crack_length", "mixity_error")


def toughness(mixity):
    return MODE_I + (MODE_II - MODE_I) * mixity ** EXPONENT


@dataclasses.dataclass(frozen=True)
class Specimen:
    """kind: "mmb", "enf" or "dcb"; lever: the arm c of the MMB; end: displacement at the end of its march; reach: the
    crack length up to which its beam theory holds; same: up to which its mixity does. All in metres."""

    kind: str
    end: float
    reach: float
    same: float
    lever: float = 0.0

    def rates(self, a):
        """G_I and G_II for a unit load per width: ASTM D6671, (12) and (13), E1f = E1; ENF and DCB as its parts."""
        gamma = 1.18 * math.sqrt(E1 * E2) / G12
        chi = math.sqrt(E1 / (11 * G12) * (3 - 2 * (gamma / (1 + gamma)) ** 2))
        first, second = (a + chi * ARM) ** 2, (a + 0.42 * chi * ARM) ** 2
        size = 16 * ARM ** 3 * E1
        if self.kind == "dcb":
            return 192 * first / size, 0.0
        if self.kind == "enf":
            return 0.0, 9 * second / size
        c = self.lever
        return 12 * ((3 * c - SPAN) / SPAN) ** 2 * first / size, 9 * ((c + SPAN) / SPAN) ** 2 * second / size

    def mixity(self, a):
        one, two = self.rates(a)
        return two / (one + two)

    def criterion(self, a):
        return toughness(self.mixity(a))

    def mean_criterion(self, first, last, points=200):
        """Of a crack that grows from `first` to `last`."""
        return sum(self.criterion(first + (last - first) * (k + 0.5) / points) for k in range(points)) / points

    def critical(self, a, factor=1.0):
        """Load per width at which the crack grows; factor: on the toughness."""
        return math.sqrt(factor * self.criterion(a) / sum(self.rates(a)))

    def envelope(self, elastic, points=120):
        """Displacements and loads at which cracks from the notch to `reach` grow. `elastic`: displacement over load
        with the crack at the notch, which holds what beam theory leaves out where the crack is not (shear, the
        load's own indentation, as the compliance of a test rig in the standard); the crack adds the integral of
        2 G/P^2."""
        a, compliance, out = NOTCH, elastic, ([], [], [])
        step = (self.reach - NOTCH) / points
        for k in range(points + 1):
            load = self.critical(a)
            for into, value in zip(out, (compliance * load, load, a)):
                into.append(value)
            compliance += 2.0 * step * sum(self.rates(a + 0.5 * step))
            a += step
        return out

    def energetic_jump(self, elastic, points=3000):
        """The displacement at which the notch's energy crosses that of another crack (or where growth begins, if it
        is stable), and the length of that crack: E + D = u^2/(2 C(a)) + integral of the criterion."""
        step = (self.reach - NOTCH) / points
        compliance, spent, best = elastic, 0.0, (math.inf, NOTCH)
        for k in range(points):
            middle = NOTCH + (k + 0.5) * step
            compliance += 2.0 * step * sum(self.rates(middle))
            spent += step * self.criterion(middle)
            best = min(best, (math.sqrt(spent / (0.5 / elastic - 0.5 / compliance)), NOTCH + (k + 1) * step))
        return best


# Beyond the middle the ENF stays in mode II; the others end, or are left, before the load or the far end is near.
SPECIMENS = {"0.2": Specimen("mmb", 8e-3, 45e-3, 45e-3, 92.9e-3), "0.5": Specimen("mmb", 4e-3, 45e-3, 45e-3, 41.3e-3),
             "0.8": Specimen("mmb", 4e-3, 45e-3, 45e-3, 27.3e-3), "enf": Specimen("enf", 2.5e-3, 45e-3, 80e-3),
             "dcb": Specimen("dcb", 3e-3, 80e-3, 80e-3)}


def scene(delam, specimen, h, path, shear=TURON, second=MODE_II, **options):
    """path: displacements at times 0, 1, 2, ... second: toughness in mode II. Options: only those given."""
    mesh = delam.Mesh.layers(LENGTH, round(LENGTH / h), [ARM, ARM], [4, 4], "quad4")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.set_orthotropic([E1, E2, E2, NU12, NU12, NU23, G12, G12, E2 / (2 * (1 + NU23))])
    problem.set_formulation("incompatible")
    problem.set_law(interface, delam.Law(
        "piecewise-linear", criterion="benzeggagh-kenane", normal_stiffness=STIFFNESS, tangential_stiffness=STIFFNESS,
        normal_onset=0.5 * NORMAL ** 2 / STIFFNESS, tangential_onset=0.5 * shear ** 2 / STIFFNESS,
        normal_toughness=MODE_I, tangential_toughness=second, onset_exponent=EXPONENT, toughness_exponent=EXPONENT))
    problem.set_adhesion(interface, interface.places[:, 0] < NOTCH - 1e-3 * h, 0.0)
    press = problem.add_pattern("press", list(range(len(path))), list(path))

    def face(body, centre, length, normal):
        half = np.array([0.0, 0.5 * length] if normal[1] == 0.0 else [0.5 * length, 0.0])
        return mesh.find_patch(body, np.array(centre) - half, np.array(centre) + half, normal)

    lower, upper = (face(body, (0.0, (0.5 + body) * ARM), ARM, (-1.0, 0.0)) for body in (0, 1))
    if specimen.kind == "dcb":
        end = mesh.find_nodes((LENGTH, 0.0), (LENGTH, 2.0 * ARM))
        for direction in ("x", "y"):
            problem.prescribe(end, direction)
        problem.prescribe_mean(*upper, "y", drive={press: 0.5})
        problem.prescribe_mean(*lower, "-y", drive={press: 0.5})
        return problem, interface
    for direction in ("x", "y"):
        problem.prescribe_mean(*lower, direction)
    problem.prescribe_mean(*face(0, (2.0 * SPAN, 0.0), PATCH, (0.0, -1.0)), "y")
    middle = face(1, (SPAN, 2.0 * ARM), PATCH, (0.0, 1.0))
    if specimen.kind == "enf":
        problem.prescribe_mean(*middle, "-y", drive=press)
    else:  # the lever turns on the middle; its load sinks by c/L u_end - (1 + c/L) u_middle
        share = specimen.lever / SPAN
        means = [weights / weights.sum() for _, weights in (middle, upper)]
        weights = np.concatenate([(1.0 + share) * means[0], -share * means[1]])
        problem.add_equation(np.concatenate([middle[0], upper[0]]), np.column_stack([0.0 * weights, weights]),
                             drive={press: -1.0})
    for key, value in options.items():
        problem.options[key] = value
    return problem, interface


def march(delam, specimen, h, steps, path=None, **more):
    """A march of equal steps to the specimen's end, or along `path`, legs of (displacement, steps)."""
    legs = path or [(specimen.end, steps)]
    problem, _ = scene(delam, specimen, h, [0.0, *(d for d, _ in legs)], **more)
    out = run(delam, problem, legs)
    out.specimen, out.h, out.shear = specimen, h, more.get("shear", TURON)
    return out


def run(delam, problem, legs, keys=()):
    """A march of a problem with one pattern, a leg in each unit of time. `at`: lists of the values after every step,
    the initial state first; `load`, `down` (displacement), `crack`; `jumps` as the library recorded them; `open`: steps
    that met an iteration limit."""
    out = types.SimpleNamespace(steps=sum(n for _, n in legs), open=0)
    with delam.Solver(problem) as solver:
        solver.not_converged = "raise"
        history = delam.History(solver, (*VALUES, *keys))
        for leg, (_, count) in enumerate(legs):
            for k in range(1, count + 1):
                try:
                    solver.advance(leg + k / count)
                except delam.NotConverged:
                    out.open += 1
                solver.commit()
                history.record()
        out.jumps = [jump._asdict() for jump in solver.jumps]
    out.at = {name: [float(v) for v in history[name]] for name in (*VALUES, *keys)}
    out.down, out.load, out.crack = (out.at[name] for name in ("load:press", "reaction:press", "crack_length"))
    return out


# ---- what a march shows

def stored(at):
    return [a + b for a, b in zip(at["stored_bulk"], at["stored_interface"])]


def defects(at):
    """stored + dissipated + released - work after every step. `released` is that of each step."""
    total, gone, out = stored(at), 0.0, []
    for k, work in enumerate(at["work"]):
        gone += at["released"][k]
        out.append(total[k] - total[0] + at["dissipated"][k] + gone - work)
    return out


def drops(load, least=0.02):
    """Steps in which the load falls by more than this part of it."""
    return [k for k in range(1, len(load)) if load[k] < (1.0 - least) * load[k - 1]]


def jumps_due(of, fine):
    """Steps of a march that a jump must be recorded for. In the march of most steps, `fine`: all in which the load
    falls by more than 2 %. In one of fewer steps, where a smooth fall may be as large: the largest such fall about
    each of the instants at which the fine march has one."""
    steps = drops(of.load)
    if of.steps >= fine.steps:
        return steps
    length, due = of.down[-1] / of.steps, set()
    for k in drops(fine.load):
        near = [i for i in steps if of.down[i] - 2.0 * length < fine.down[k] < of.down[i] + length]
        due.update(sorted(near, key=lambda i: of.load[i] / of.load[i - 1])[:1])
    return sorted(due)


def unnamed(of, steps):
    """Those of the steps for which no jump with a released energy is recorded."""
    named = {j["step"] for j in of.jumps if math.isfinite(j["released"])}
    return [k for k in steps if k not in named]


def apart(coarse, fine):
    """Largest relative difference of the loads at the displacements that both marches have, and where."""
    there = {round(d, 9): p for d, p in zip(fine.down, fine.load)}
    worst, place, met = 0.0, 0.0, 0
    for d, p in zip(coarse.down, coarse.load):
        other = there.get(round(d, 9))
        if other is None or not d > 0.0:
            continue
        met += 1
        off = abs(p - other) / max(abs(p), abs(other))
        if off > worst:
            worst, place = off, d
    return worst, place, met


def growth(of):
    """Dissipated per new crack, over the criterion at the mixities of beam theory on the way: from the peak, where the
    softening zone is whole, to the last crack that beam theory describes."""
    first = max(range(len(of.load)), key=lambda k: of.load[k])
    within = [k for k in range(first, len(of.load)) if of.crack[k] <= of.specimen.same]
    last = within[-1]
    return booked(of, first, last), first, last


def booked(of, first, last):
    a, b = of.crack[first], of.crack[last]
    if not b - a > 1e-3:
        return math.nan
    spent = of.at["dissipated"][last] - of.at["dissipated"][first]
    return spent / (b - a) / of.specimen.mean_criterion(a, b)
