# SPDX-License-Identifier: BSD-3-Clause
"""Reads states and compares them."""
import math

import numpy as np

ENERGIES = ("stored_bulk", "stored_interface", "load_potential", "dissipated", "work")
# With mixity_rule = variational, what is called dissipated depends on the way of the minimisation within a step; the
# split of PANM 15 (2010) does not.
LINEAR = ("stored_bulk", "stored_interface_linear", "load_potential", "dissipated_linear", "work")
FIELDS = ("adhesion", "jump", "traction", "mixity", "contact", "displacement", "stress", "reaction")
SAME = 1e-7  # of the largest value: two ways to solve the same equations
# By how much more fields may differ: a pair's adhesion follows from its jump, a small difference of displacements.
MORE = {"adhesion": 100.0, "jump": 10.0, "traction": 100.0, "displacement": 1.0, "stress": 10.0}


class Wrong(Exception):
    """An answer that a check refutes."""


def expect(condition, what):
    if not condition:
        raise Wrong(what)


def expect_near(found, expected, tolerance, size, what):
    off = float(np.max(np.abs(np.asarray(found) - np.asarray(expected)), initial=0.0))
    if not off <= tolerance * size:
        raise Wrong(f"{what}: off by {off / size:.1e}, allowed {tolerance:.0e}")


# NaN where they are not known: without a search, where nothing is stored, and of bodies in an engine.
UNKNOWN = {"search_gap", "mesh_error", "mesh_error_fronts", "mesh_excess", "buckling_ratio"}


def read(scene, solver):
    """All values and fields of the state described, which are finite."""
    values = {name: solver.values[name] for name in (*solver.values, "stored_interface_linear", "dissipated_linear")}
    for name, value in values.items():
        expect(math.isfinite(value) or name in UNKNOWN, f"{name} is {value}")
    fields = {name: solver.field(name) for name in FIELDS}
    for name, field in fields.items():
        expect(np.isfinite(field).all(), f"field {name} is not finite")
    fields["displacement"] = fields["displacement"][scene.mesh.node_bodies >= 0]
    fields["traction"] = scene.shared(fields["traction"])
    return values, fields


def same(one, other, what, tolerance=None, energies=ENERGIES):
    """Reactions, energies and fields of two states; without a tolerance bit for bit."""
    for names in ([name for name in one[0] if name.startswith("reaction:")], energies):
        size = max(abs(one[0][name]) for name in names)
        for name in names:
            if tolerance is None:
                expect(one[0][name] == other[0][name], f"{what}: {name} has other bits")
            else:
                expect_near(other[0][name], one[0][name], tolerance, size, f"{what}: {name}")
    for name in FIELDS:
        if tolerance is None:
            expect(one[1][name].tobytes() == other[1][name].tobytes(), f"{what}: field {name} has other bits")
        elif name in MORE:
            size = float(np.max(np.abs(one[1][name])))
            expect_near(other[1][name], one[1][name], MORE[name] * tolerance, size, f"{what}: field {name}")
