# SPDX-License-Identifier: BSD-3-Clause
"""Compares two runs of a scene: history, fields, adhesion and contact of all steps that are written.

Rounding must not decide. Two quantities amplify it, and are compared by what is known of them:

- The adhesion of a softening pair follows from its jump, which is a small difference of large displacements: a slender
  specimen that moves by millimetres has jumps of hundredths there. Where that leaves fewer digits than are asked for
  (SLENDER), a pair's adhesion may differ by what the law makes of the difference of its jump, and no more. The jumps
  are compared themselves, and all adhesions must add up to the same debonded area.
- A pair without a gap and without pressure is in contact or not. Which side is right shows in gap and pressure, and
  these are compared in all pairs; the set is compared where the gap is larger than its error.
"""
import csv
import os

import h5py
import numpy as np

from launch import expect

# A comparison may differ by so much, of the largest value of its kind; by the size of damage_tolerance.
ALLOWED = {"tight": 1e-8, "loose": 2e-3}
# A nearly incompressible body amplifies rounding. Scene: allowed of every comparison, with the serial program or with
# another number of ranks, of which kernels of the BLAS change what is seen: up to 1.3e-8 of a reaction.
ROUNDED = {"incompressible": 1e-7}
# Scenes in which rounding decides these digits of the adhesion: between its own reductions condensed and iterated the
# serial program differs by 3.2e-8 and 6.4e-8, in the former also by 2.3e-8 between kernels of the BLAS.
SLENDER = ("whole-mixed-converged", "whole-two-interfaces")
# Stresses and rotations are differences of displacements over a cell: rounding weighs more in them, by the displacement
# of a slender body over the elongation of its cells. Seen up to 3.1e-8. Tractions are stresses, of the size of which a
# difference counts.
DERIVED = {"stress": 1e-7, "rotation": 1e-7, "traction": 1e-7}
FIELDS = 'output.fields=["displacement", "stress", "rotation", "zeta", "jump", "traction", "contact"]'
# These follow from the state and its history. With the variational mixity rule, what is called dissipated depends on
# the way of the minimisation within a step, and only the split of the _slides does not.
ENERGIES = ("stored_bulk", "stored_interface", "work")
DISSIPATED = {"variational": ("stored_interface_slides", "dissipated_slides")}
# The most by which the adhesion of a pair changes with the logarithm of its jump. Piecewise-linear law:
# zeta + Go/(Gc - Go); the mixity adds its part.
SENSITIVITY = 2.0
# A violation below this part of the largest jump is none (contact_rounding of src/evolution/contact/active_set.hpp).
CONTACT_ROUNDING = 1e-11


class Result:
    def __init__(self, out):
        with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        rule = rows[-1][rows[0].index("mixity_rule")]
        self.energies = [*ENERGIES, *DISSIPATED.get(rule, ("dissipated", "released"))]
        self.rows = {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])
                     if name not in ("solution", "mixity_rule")}
        with h5py.File(os.path.join(out, "fields.h5"), "r") as file:
            self.steps = sorted(file["steps"])
            self.turned = [file["steps"][step].attrs["rotation_max"] for step in self.steps]
            # [steps][...], of nodes, of cells, and of pairs
            self.fields = {name: np.stack([file["steps"][step][name][()] for step in self.steps])
                           for name in ("displacement", "stress", "rotation")}
            interfaces = sorted(file["interfaces"])

            def of_pairs(name, missing):
                columns = []
                for interface in interfaces:
                    groups = [file["steps"][step][interface] for step in self.steps]
                    columns.append(np.stack([group[name][()] if name in group else missing(group) for group in groups]))
                return np.concatenate(columns, axis=1)

            def count(group):
                return group["displacement"].shape[0]

            self.fields["faces"] = of_pairs("displacement", None)
            self.fields["jump"] = of_pairs("jump", lambda group: np.zeros((count(group), 3)))
            self.fields["traction"] = of_pairs("traction", lambda group: np.zeros((count(group), 3)))
            self.adhesion = of_pairs("zeta", lambda group: np.ones(count(group)))
            self.contact = of_pairs("contact", lambda group: np.zeros(count(group))) != 0

    def differences(self, other, slender=False):
        """Returns, for every kind, the largest difference from the other, of the largest value of the kind; and the
        number of pairs on different sides of contact."""
        a, b = self.rows, other.rows
        energy = max(np.abs(b[name]).max() for name in self.energies)
        found = {"reaction": max(of(a[name], b[name], np.abs(b[name]).max()) for name in b
                                 if name.startswith("reaction")),
                 "energy": max(of(a[name], b[name], energy) for name in self.energies),
                 "debonded": of(a["debonded_length"], b["debonded_length"], b["debonded_length"].max()),
                 "turned": of(np.array(self.turned), np.array(other.turned), max(other.turned))}
        if self.steps != other.steps or any(self.fields[name].shape != other.fields[name].shape
                                            for name in self.fields):
            raise ValueError(f"fields of other steps or shapes: {self.steps}, {other.steps}")
        found.update({name: of(self.fields[name], other.fields[name], np.abs(other.fields[name]).max(initial=0.0))
                      for name in self.fields})
        size = max(np.abs(other.fields[name]).max(initial=0.0) for name in ("stress", "traction"))
        found["traction"] = of(self.fields["traction"], other.fields["traction"], size)
        area = (1.0 - other.adhesion).sum(axis=1).max()
        changed = np.abs(self.adhesion - other.adhesion)
        found["area"] = float(changed.sum(axis=1).max() / max(area, 1.0))
        explained = self.of_the_jumps(other) if slender else 0.0
        found["adhesion"] = float(np.maximum(changed - explained, 0.0).max(initial=0.0))
        return found, self.sides(other)

    def of_the_jumps(self, other):
        """Returns the difference of the adhesion that the difference of the jumps allows: [steps][pairs]. Only steps
        that damage a pair count, from then on."""
        size = np.linalg.norm(other.fields["jump"], axis=2)
        moved = np.linalg.norm(self.fields["jump"] - other.fields["jump"], axis=2)
        relative = np.divide(moved, size, out=np.zeros_like(moved), where=size > 0.0)
        rests = [np.diff(one.adhesion, axis=0, prepend=one.adhesion[:1]) == 0.0 for one in (self, other)]
        relative[rests[0] & rests[1]] = 0.0
        return SENSITIVITY * np.maximum.accumulate(relative, axis=0)

    def sides(self, other):
        """Pairs that are closed in one and open in the other, by more than the error of gaps: rounding, and what the
        gaps differ by where both are open."""
        gap, its = self.fields["jump"][:, :, 0], other.fields["jump"][:, :, 0]
        both = ~self.contact & ~other.contact
        error = np.abs(np.where(both, gap - its, 0.0)).max(axis=1, initial=0.0)
        error += CONTACT_ROUNDING * np.abs(other.fields["jump"]).max(axis=(1, 2), initial=0.0)
        open_gap = np.where(self.contact, its, gap)
        return int(((self.contact != other.contact) & (np.abs(open_gap) > error[:, None])).sum())


def of(a, b, size):
    return float(np.abs(a - b).max(initial=0.0) / size) if size > 0 else float(np.abs(a - b).max(initial=0.0))


def verdict(result, reference, allowed, exact, slender=False):
    """Returns whether they agree, and in how much."""
    if len(reference.rows["step"]) != len(result.rows["step"]):
        return False, "other steps"
    found, sides = result.differences(reference, slender)
    right = sides == 0 or not exact
    for kind, value in found.items():
        right = right and value <= max(allowed, DERIVED.get(kind, 0.0))
    numbers = " ".join(f"{kind} {value:.1e}" for kind, value in found.items())
    return right, f"{numbers}, {sides} pairs on the other side of contact"


def compared(name, what, result, reference, allowed, exact):
    if reference is not None:
        right, numbers = verdict(result, reference, allowed, exact, name in SLENDER)
        expect(right, f"{name}: {what}: {numbers}")
