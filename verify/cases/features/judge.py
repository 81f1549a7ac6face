# SPDX-License-Identifier: BSD-3-Clause
"""Runs the scene with some features and judges it: it works, or it is refused by name, or it fails."""
import functools

import numpy as np

import delam
import probes
from check import ENERGIES, LINEAR, SAME, Wrong, expect, expect_near, read, same
from scene import ALIKE, BRITTLE, CONDENSED, ENGINE, ITERATED, QUERIES, SPACE, TIMES, TURNED, Scene

LEDGER = 0.05  # of the work: what the trapezoidal rule leaves in long steps
FINER = 4  # where it leaves more, in so many times as many steps
ROUNDING = 1e-9  # of the work
SOUND = 1e-6  # the values kkt_...
BALANCED = 1e-5  # of the largest value: forces of bodies that rotate balance to 1e-6 of the load
WORKS, REFUSED, FAILED = "w", "r", "F"
REFUSALS = ("DELAM_ERROR_ARGUMENT", "DELAM_ERROR_PROBLEM", "DELAM_ERROR_STATE")


def analyse(scene, queries=(), times=TIMES):
    """[(values, fields)] of all steps, the initial state included, and what was asked."""
    solver = probes.new_solver(scene)
    asked = [probes.PROBES[query](scene, solver) for query in queries]
    history = [read(scene, solver)]
    for k, time in enumerate(times, 1):
        solver.advance(time)
        for probe in asked:
            probe.pending(solver, time)
        solver.commit()
        history.append(read(scene, solver))
        for probe in asked:
            probe.committed(solver, k)
    for probe in asked:
        probe.end(history)
    return history, asked


@functools.lru_cache(maxsize=None)
def plain(features, toughness=1.0, parts=1):
    """The history without questions, with each step in parts; features in the order of their names."""
    scene = Scene(features, toughness)
    times = [b - (b - a) * left / parts for a, b in zip((0.0, *TIMES), TIMES) for left in reversed(range(parts))]
    return scene.run(lambda: analyse(scene, times=times)[0])


def ordered(features):
    return tuple(sorted(features, key=lambda feature: feature.name))


def open_ledger(history):
    """The largest part of the work by which stored, dissipated and released energy differ from it."""
    return max(abs(values["defect"]) for values, _ in history) / max(abs(values["work"]) for values, _ in history)


def judge_balance(features, history):
    """stored + dissipated + released = work, in every step."""
    released = 0.0
    work = max(abs(values["work"]) for values, _ in history)
    expect(work > 0.0, "no work is done")
    first = sum(history[0][0][name] for name in ENERGIES[:3])
    for k, (values, _) in enumerate(history):
        released += values["released"]
        defect = sum(values[name] for name in ENERGIES[:4]) + released - values["work"] - first
        expect_near(values["defect"], defect, ROUNDING, work, f"step {k}: defect")
        for name in ("kkt_gap", "kkt_pressure", "kkt_complementarity", "kkt_equilibrium"):
            expect(values[name] <= SOUND, f"step {k}: {name} is {values[name]:.1e}")
    if open_ledger(history) > LEDGER:
        history = plain(features, 1.0, FINER)
    expect(open_ledger(history) <= LEDGER, f"the ledger is open by {open_ledger(history):.1e} of the work")


def judge_damage(scene, history):
    start, end = history[0][1]["adhesion"], history[-1][1]["adhesion"]
    broken = int(np.sum((start > 0.0) & (end < 1e-3)))
    partly = int(np.sum((end > 1e-3) & (end < 1.0)))
    expect(broken > 0 and (partly > 0 or BRITTLE in scene.features),
           f"{broken} pairs have broken, {partly} are partly damaged")


def judge(features):
    features = ordered(features)
    scene = Scene(features)
    history, asked = scene.run(lambda: analyse(scene, [feature for feature in features if feature in QUERIES]))
    judge_balance(features, history)
    judge_damage(scene, history)
    if asked:  # what is asked changes nothing
        for k, (one, other) in enumerate(zip(plain(features), history)):
            same(one, other, f"step {k}, with and without questions", SAME if ENGINE in features else None)
    for probe in asked:
        if isinstance(probe, probes.Sensitivity):
            probe.judge(*(plain(features, 1.0 + sign * probes.SHARE) for sign in (1.0, -1.0)))
    alike = [feature for feature in features if feature in ALIKE]
    if alike:
        other_way = ITERATED if alike == [CONDENSED] else CONDENSED
        reference = plain(ordered([*(feature for feature in features if feature not in ALIKE), other_way]))
        energies = LINEAR if scene.options.get("mixity_rule") == "variational" else ENERGIES
        for k, (one, other) in enumerate(zip(reference, history)):
            same(one, other, f"step {k}, against {other_way.name}", BALANCED if TURNED in features else SAME, energies)


def outcome(features):
    """(letter, text) of a set of features."""
    try:
        judge(features)
    except delam.DelamError as error:
        text = f"{error.name}: {error}"
        if error.name not in REFUSALS:
            return FAILED, text
        unnamed = [feature.name for feature in features if feature is not SPACE and not feature.named(str(error))]
        return (FAILED, f"{text} (does not name: {', '.join(unnamed)})") if unnamed else (REFUSED, text)
    except Wrong as wrong:
        return FAILED, str(wrong)
    return WORKS, ""
