# SPDX-License-Identifier: BSD-3-Clause
"""What a fit holds without being asked about it: the numbers of laws and the elastic constants that are not among its
parameters. Intervals take them as right, so an analysis with each of them somewhat larger says how far an error there
moves the parameters."""
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from fit_model import Infeasible, numbers_of_laws
from analyses import path_of, value_at

ELASTIC = r"young|poisson|E[123]|G\d\d|nu\d\d"
# Changes of a parameter below this part of it are listed together: three digits are what people know of a toughness. Half
# and twice of it list fewer and more in one line, and change no number.
LITTLE = 1e-3


@dataclass
class Held:
    """A number that is held: its value, and by which part each parameter moves where it is larger (NaN: a parameter that
    is held, too); moves is None where the scene has no answer there."""
    key: str
    value: float
    moves: object


def keys_of(scene, common, parameters):
    """The numbers of laws and the elastic constants of a scene that are not among the parameters and are not 0, with their
    values."""
    materials = scene.get("materials", [])
    keys = numbers_of_laws(scene) + [f"materials.{k}.{key}" for k, one in enumerate(materials if isinstance(materials, list) else [])
                                     if isinstance(one, dict) for key in one if re.fullmatch(ELASTIC, key)]
    given = dict(word.partition("=")[::2] for word in common)
    found = {}
    for key in map(path_of, keys):
        value = value_at({"x": _number(given[key])}, "x") if key in given else value_at(scene, key)
        if value and key not in parameters:
            found[key] = value
    return found


def _number(text):
    try:
        return float(text)
    except ValueError:
        return None


def moved_by_held(model, misfit, outcome, kept, part):
    """A Held for each number: an analysis with the number larger by this part, to which the kept parameters follow by the
    derivatives of the fit. Scenes that have the number move together."""
    values, names = misfit.values(outcome.point.at), [p.path for p in model.parameters]
    scenes = [keys_of(scene, model.common, names) for scene in model.scenes]
    keys = list(dict.fromkeys(key for scene in scenes for key in scene))
    inverse = np.linalg.pinv(outcome.jacobian[:, kept])
    before = outcome.point.answer.curves

    def moves(which, key):
        moved = np.full(len(names), np.nan)
        try:
            curves = [model.curve_with(k, f"held{which + 1}", values, {key: (1 + part) * scene[key]}) if key in scene else curve
                      for k, (scene, curve) in enumerate(zip(scenes, before))]
        except Infeasible:
            return None
        change = (np.concatenate(curves) - np.concatenate(before)) / misfit.size
        moved[kept] = np.expm1(-inverse @ change)
        return moved

    with ThreadPoolExecutor(model.jobs) as pool:
        found = list(pool.map(moves, range(len(keys)), keys))
    first = {key: scene[key] for scene in reversed(scenes) for key in scene}
    return [Held(key, first[key], moved) for key, moved in zip(keys, found)]


def widened(held, low, high, k):
    """The interval of parameter k about its value, as two factors, where each number that is held may be off by the part:
    independent errors, whose squares add up."""
    square = sum(np.log1p(one.moves[k]) ** 2 for one in held if one.moves is not None)
    return float(np.exp(-np.hypot(np.log(low), np.sqrt(square)))), float(np.exp(np.hypot(np.log(high), np.sqrt(square))))


def lines_of(held, part, names, units_of):
    """What is said of it, the largest moves first. units_of(key): the unit after a blank."""
    def size(one):
        return float(np.nanmax(np.abs(one.moves)))

    moving = sorted((one for one in held if one.moves is not None and size(one) >= LITTLE), key=size, reverse=True)
    idle = [one.key for one in held if one.moves is not None and size(one) < LITTLE]
    failed = [one.key for one in held if one.moves is None]
    out = [f"held, and taken as right by the intervals from the curve alone; {100 * part:g} % more of"] if held else []
    for one in moving:
        changes = ", ".join(f"{name} by {100 * move:+.2g} %" for name, move in zip(names, one.moves) if not np.isnan(move))
        out.append(f"    {one.key} (of {one.value:.6g}{units_of(one.key)}) changes {changes}")
    if idle:
        out.append(f"    {', '.join(idle)}: by less than {100 * LITTLE:g} %")
    if failed:
        out.append(f"    {', '.join(failed)}: the scene has no answer there")
    return out
