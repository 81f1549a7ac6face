# SPDX-License-Identifier: BSD-3-Clause
"""The specimens of chapter (h): mixed-mode bending, ENF and DCB of IM7/8552, by the Python package with its default
options; their corrected beam theory (ASTM D6671); and what an analysis of one shows."""
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
          "increment_lower", "upper", "released", "popped", "defect", "crack_length", "mixity_error")


def toughness(mixity):
    return MODE_I + (MODE_II - MODE_I) * mixity ** EXPONENT


@dataclasses.dataclass(frozen=True)
class Specimen:
    """kind: "mmb", "enf" or "dcb"; lever: the arm c of the MMB; end: displacement at the end of its analysis; reach: the
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
    problem.options["kinematics"] = "linear"
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


def zone(places, adhesion, jump):
    """The softening zone of a state: adhesions and mixities of the pairs between the last broken and the first intact
    one; with equal stiffnesses of opening and shear. Empty before a pair has broken."""
    order = np.argsort(places)
    places, adhesion, jump = places[order], adhesion[order], jump[order]
    broken = np.flatnonzero(adhesion <= 0.0)
    if broken.size == 0 or places[broken[-1]] < NOTCH:
        return []
    found = []
    for k in range(broken[-1] + 1, len(adhesion)):
        if adhesion[k] >= 1.0:
            break
        normal, slip = max(float(jump[k, 0]), 0.0) ** 2, float(jump[k, 1]) ** 2
        found.append((float(adhesion[k]), slip / (normal + slip)))
    return found


def asked(points, shear):
    """What the law dissipates in a pair that passes through softening zones, J/m2: the integral of its threshold over
    the adhesion, from 1 to 0, at the mixity that pairs have there. points: (adhesion, mixity) in the zones of a front
    that advances, whose states lie at all distances between pairs; in the frame of the front they are the way of each
    pair in time. The law is evaluated here: g(B, zeta) = Gc (1 - zeta) Go/(Go + (Gc - Go) zeta)."""
    if not points:
        return math.nan

    def dissipated(mixity, zeta):
        onset = 0.5 * (NORMAL ** 2 + (shear ** 2 - NORMAL ** 2) * mixity ** EXPONENT) / STIFFNESS
        total = toughness(mixity)
        return total * (1.0 - zeta) * onset / (onset + (total - onset) * zeta)

    way = sorted(points, reverse=True)
    way = [(1.0, way[0][1]), *way, (0.0, way[-1][1])]
    return sum(0.5 * (dissipated(b, z) - dissipated(b, y) + dissipated(c, z) - dissipated(c, y))
               for (y, b), (z, c) in zip(way, way[1:]))


def analyse(delam, specimen, h, steps, path=None, **more):
    """An analysis of equal steps to the specimen's end, or along `path`, legs of (displacement, steps). `zones`: the
    softening zone of each state."""
    legs = path or [(specimen.end, steps)]
    problem, interface = scene(delam, specimen, h, [0.0, *(d for d, _ in legs)], **more)
    places, found = np.array(interface.places[:, 0]), [[]]

    def watch(solver):
        found.append(zone(places, np.array(solver.field("adhesion")), np.array(solver.field("jump"))))

    out = run(delam, problem, legs, watch=watch)
    out.specimen, out.h, out.shear, out.zones = specimen, h, more.get("shear", TURON), found
    return out


def run(delam, problem, legs, keys=(), watch=None):
    """An analysis of a problem with one pattern, a leg in each unit of time. `at`: lists of the values after every step,
    the initial state first; `load`, `down` (displacement), `crack`; `jumps`: recorded() ones; `open`: steps that met an
    iteration limit. watch(solver) is called after every step."""
    out = types.SimpleNamespace(steps=sum(n for _, n in legs), open=0)
    times = [0.0, *(leg + k / count for leg, (_, count) in enumerate(legs) for k in range(1, count + 1))]
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
                if watch:
                    watch(solver)
        jumps = [(j.step, j.before, j.time, j.released, *j.reaction_before, *j.reaction_after) for j in solver.jumps]
    out.at = {name: [float(v) for v in history[name]] for name in (*VALUES, *keys)}
    out.down, out.load, out.crack = (out.at[name] for name in ("load:press", "reaction:press", "crack_length"))
    out.jumps = [recorded(times, out.down, *jump) for jump in jumps]
    return out


def recorded(times, down, step, begin, end, released, before, after):
    """A jump that the library recorded; `at`: its displacement, with the loads `before` and `after` it there; None: its
    instant is not known."""
    known = begin == end
    return {"step": step, "released": released, "at": float(np.interp(end, times, down)) if known else None,
            "before": before, "after": after}


def curve(of):
    """Displacements and loads; where a jump is at a known displacement, twice, with the loads before and after it."""
    down, load = [of.down[0]], [of.load[0]]
    for k in range(1, len(of.load)):
        for jump in (j for j in of.jumps if j["step"] == k and j["at"] is not None):
            down += [jump["at"], jump["at"]]
            load += [jump["before"], jump["after"]]
        down.append(of.down[k])
        load.append(of.load[k])
    return down, load


# ---- what an analysis shows

def stored(at):
    return [a + b for a, b in zip(at["stored_bulk"], at["stored_interface"])]


def defects(at):
    """stored + dissipated + released - work after every step. `released` is that of each step."""
    total, gone, out = stored(at), 0.0, []
    for k, work in enumerate(at["work"]):
        gone += at["released"][k]
        out.append(total[k] - total[0] + at["dissipated"][k] + gone - work)
    return out


def work_of(of, due):
    """Integral of the load over the displacement by trapezia, and what it leaves open: where the load falls at once at
    an unknown instant of a step, and what trapezia of twice the length differ by (where the softening zone has few
    pairs, the load rises and falls with each of them, also within a step)."""
    down, load = curve(of)

    def trapezia(of_every):
        jumped = [i for i in range(len(down)) if 0 < i and down[i] == down[i - 1] or
                  i + 1 < len(down) and down[i] == down[i + 1]]
        kept = sorted({*range(0, len(down), of_every), *jumped, len(down) - 1})
        return sum(0.5 * (load[i] + load[j]) * (down[j] - down[i]) for i, j in zip(kept, kept[1:]))

    known = {j["step"] for j in of.jumps if j["at"] is not None}
    fallen = sum(0.5 * (of.load[k - 1] - of.load[k]) * (of.down[k] - of.down[k - 1]) for k in due if k not in known)
    return trapezia(1), fallen + abs(trapezia(2) - trapezia(1))


def drops(load, least=0.02):
    """Steps in which the load falls by more than this part of it."""
    return [k for k in range(1, len(load)) if load[k] < (1.0 - least) * load[k - 1]]


def fall(of, k):
    return 1.0 - of.load[k] / of.load[k - 1]


def at_once(analyses):
    """Steps in which the load falls at once, a list for each analysis of one scene with different steps. In the analysis of
    most steps: by more than 2 %, and by half or more of the fall that the analysis of fewer steps has there; a smooth
    fall shrinks with the step. In the others: the largest fall by more than 2 % about each of these instants."""
    ordered = sorted(analyses, key=lambda m: -m.steps)
    fine, found = ordered[0], {id(m): set() for m in analyses}

    def near(of, k):
        """Steps of another analysis about a step of the finest, one more at each side."""
        length = of.down[-1] / of.steps
        return [i for i in range(1, len(of.load)) if of.down[i] - 2.0 * length < fine.down[k] < of.down[i] + length]

    for k in drops(fine.load):
        longer = [fall(ordered[1], i) for i in near(ordered[1], k)] if len(ordered) > 1 else []
        if longer and fall(fine, k) < 0.5 * max(longer):
            continue
        found[id(fine)].add(k)
        for of in ordered[1:]:
            steps = [i for i in near(of, k) if i in drops(of.load)]
            found[id(of)].update(sorted(steps, key=lambda i: -fall(of, i))[:1])
    return [sorted(found[id(m)]) for m in analyses]


def unnamed(of, steps):
    """Those of the steps for which no released energy is recorded, of a jump or of single pairs that popped."""
    named = {j["step"] for j in of.jumps if math.isfinite(j["released"])}
    named |= {k for k, popped in enumerate(of.at["popped"]) if popped > 0.0}
    return [k for k in steps if k not in named]


def apart(coarse, fine):
    """Largest relative difference of the loads at the displacements that both analyses have, and where."""
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
    """The steps between which what a new crack dissipates is judged: from the peak, where the softening zone is whole,
    to the last crack whose mixity beam theory gives; or None if it hardly grows."""
    first = max(range(len(of.load)), key=lambda k: of.load[k])
    last = max(k for k in range(first, len(of.load)) if k == first or of.crack[k] <= of.specimen.same)
    return (first, last) if of.crack[last] - of.crack[first] > 1e-3 else None


def pairs(of):
    """Mean number of pairs in the softening zone while the crack grows, 0 without growth."""
    first, last = growth(of) or (0, 0)
    counts = [len(points) for points in of.zones[first:last + 1] if points]
    return sum(counts) / len(counts) if counts else 0.0


def accounted(of):
    """Dissipated per new crack over what the softening zones on the way ask for, and over the criterion at the
    mixities of beam theory; NaN without growth."""
    steps = growth(of)
    if steps is None:
        return math.nan, math.nan
    first, last = steps
    a, b = of.crack[first], of.crack[last]
    spent = (of.at["dissipated"][last] - of.at["dissipated"][first]) / (b - a)
    points = [point for zone in of.zones[first:last + 1] for point in zone]
    return spent / asked(points, of.shear), spent / of.specimen.mean_criterion(a, b)
