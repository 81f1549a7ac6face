#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests what comparison.py calls the same, and what it does not: two runs of one scene, changed here or by a number
of the scene. One process."""
import copy

import numpy as np

import small_scenes
from comparison import ALLOWED, CONTACT_ROUNDING, FIELDS, Result, verdict
from launch import alone, expect, finish, folder


def run(*settings):
    scene, own = small_scenes.quick()["punch"]
    same = ("solver.damage_tolerance=1e-10", "solver.kinematics=linear", FIELDS)
    words = [word for setting in (*own, *same, *settings) for word in ("--set", setting)]
    out = folder()
    code, said = alone("run", scene, "--out", out + "/out", *words)
    expect(code == 0, f"the scene is solved: {code} {said[-200:] if code else ''}")
    return Result(out + "/out")


def main():
    first, allowed = run(), ALLOWED["tight"]

    def judged(expected, what, change=None, second=None, slender=True):
        result = second or copy.deepcopy(first)
        if change is not None:
            change(result)
        same, numbers = verdict(result, first, allowed, True, slender)
        expect(same == expected, f"{what}: {'the same' if same else 'different'}: {numbers}")

    jump, largest = first.fields["jump"], np.abs(first.fields["jump"][-1]).max()
    pressed = int(np.argmin(np.where(first.contact[-1], first.fields["traction"][-1][:, 0], 0.0)))
    softened = int(np.argmin(np.abs(first.adhesion[-1] - 0.5)))
    expect(first.fields["traction"][-1][pressed, 0] < 0.0, "a pair is pressed")
    expect(0.0 < first.adhesion[-1][softened] < 1.0, "a pair softens")
    judged(True, "nothing is changed")
    for key, value, part in (("laws[0].normal_toughness", 250.0, 1e-6), ("laws[0].normal_onset", 20.0, 1e-4),
                             ("materials[0].young", 75e9, 1e-6), ("materials[1].young", 200e9, 1e-6)):
        other = run(f"{key}={value * (1.0 + part)!r}")
        for slender in (False, True):
            judged(False, f"{key} larger by {part:g}", second=other, slender=slender)

    def opened(part):
        def change(result):
            result.contact[-1, pressed] = False
            result.fields["jump"][-1, pressed, 0] = part * largest
        return change

    judged(True, "a pair at rounding between closed and open", opened(-0.5 * CONTACT_ROUNDING))
    judged(False, "a pressed pair that is open and penetrates", opened(-3.0 * CONTACT_ROUNDING))
    judged(False, "a pressed pair that is open", opened(3.0 * CONTACT_ROUNDING))

    def unpressed(result):
        result.contact[-1, pressed] = False
        result.fields["traction"][-1, pressed, 0] = 0.0
    judged(False, "a pressed pair without its pressure", unpressed)

    def less(result):
        result.adhesion[-1, softened] -= 2.0 * allowed
    judged(False, "an adhesion that its jump does not explain", less)

    def explained(result):
        result.adhesion[-1, softened] -= 2.0 * allowed
        result.fields["jump"][-1, softened] = jump[-1, softened] * (1.0 + 2.0 * allowed)
    judged(True, "an adhesion that its jump explains, of a slender specimen", explained)
    judged(False, "an adhesion that its jump explains", explained, slender=False)

    def all_less(result):
        explained(result)
        result.adhesion[-1] = np.where(first.adhesion[-1] < 1.0, first.adhesion[-1] - 2e-7, 1.0)
        result.fields["jump"][-1] *= 1.0 + 2e-7
    judged(False, "an area that differs, though jumps explain it", all_less)
    finish()


if __name__ == "__main__":
    main()
