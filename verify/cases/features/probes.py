# SPDX-License-Identifier: BSD-3-Clause
"""What is asked of an analysis while it goes on: derivatives, which are compared with difference quotients, and saved
states, which are loaded and continued."""
import ctypes

import numpy as np

import delam
from check import SAME, expect, expect_near, read, same
from delam._base.library import library
from scene import BRITTLE, ENDS, ENGINE, LAW, LOAD_TANGENT, SAVED, SENSITIVITY, STEP_TANGENT, TIMES, TURNED

QUOTIENT = 2e-4  # of the largest entry: a derivative and a difference quotient
TURNED_QUOTIENT = 5e-3  # the tangent of bodies that rotate leaves out how couples of tractions change
SHARE = 1e-5  # of the toughness, by which it changes for a quotient
AT = 2  # the step whose state is saved


def new_solver(scene):
    return delam.Solver(scene.problem, not_converged="raise")


class Probe:
    """Asks one thing of an analysis; a twin takes the same steps, and others beside them."""

    def __init__(self, scene, solver):
        self.scene, self.twin = scene, new_solver(scene)
        self.ends = np.array([ENDS[name] for name in scene.patterns])
        self.compared = 0

    def pending(self, solver, time):
        """A step is pending."""

    def committed(self, solver, k):
        """Step k is committed."""

    def end(self, history):
        """After the last step."""

    def factors(self, time, factors):
        for name, factor in zip(self.scene.patterns, factors):
            self.twin.set_history(name, [time], [factor])

    def reactions(self):
        return np.array([self.twin.values[f"reaction:{name}"] for name in self.scene.patterns])

    def quotient(self, step, time, factors, share):
        """[patterns][patterns]: how the reactions at the end of step(time) change with the factors there."""
        columns = []
        for change in np.diag(share * self.ends):
            ends = []
            for sign in (1.0, -1.0):
                self.factors(time, factors + sign * change)
                step(time)
                ends.append(self.reactions())
                self.twin.rollback()
            columns.append((ends[0] - ends[1]) / (2.0 * np.sum(change)))
        return np.array(columns).T

    def compare(self, found, quotient, what):
        """As energies: entries times the factors of their row and column at the end."""
        scale = np.outer(self.ends, self.ends)
        allowed = TURNED_QUOTIENT if TURNED in self.scene.features else QUOTIENT
        expect_near(found * scale, quotient * scale, allowed, np.max(np.abs(quotient * scale)), what)
        self.compared += 1

    def follow(self, time):
        self.factors(time, self.ends * time)
        self.twin.advance(time)
        self.twin.commit()


class LoadTangent(Probe):
    """Against displacement steps beside the state, at its adhesion."""

    def committed(self, solver, k):
        time = TIMES[k - 1]
        self.follow(time)
        beside = self.quotient(self.twin.equilibrate, time + 1e-3, self.ends * time, 1e-5)
        self.compare(solver.tangent(), beside, f"load tangent, step {k}")


class StepTangent(Probe):
    """Against whole steps to other factors."""

    def pending(self, solver, time):
        tangent = solver.step_tangent()
        if solver.values["dissipated"] > 0.0:
            share = 2e-5 if TURNED in self.scene.features else 2e-7
            self.compare(tangent, self.quotient(self.twin.advance, time, self.ends * time, share),
                         f"step tangent at {time}")
        self.follow(time)

    def end(self, history):
        expect(self.compared >= 2, "no step tangent was compared")


class Saved(Probe):
    """Another solver that loads the state goes on to the same bits; with an engine, as far as its solves agree."""

    def committed(self, solver, k):
        if k == AT:
            self.state = solver.save()

    def end(self, history):
        followed = SENSITIVITY in self.scene.features
        if followed:
            follow(self.twin)
        self.twin.load(self.state)
        for k, time in enumerate(TIMES[AT:], AT + 1):
            self.twin.advance(time)
            self.twin.commit()
            same(history[k], read(self.scene, self.twin), f"step {k}, after loading",
                 SAME if ENGINE in self.scene.features else None)
        if followed:
            sensitivity(self.twin)


class Sensitivity(Probe):
    """Against analyses with another toughness."""

    def __init__(self, scene, solver):
        super().__init__(scene, solver)
        follow(solver)
        self.found = []

    def committed(self, solver, k):
        self.found.append(sensitivity(solver))

    def judge(self, more, less):
        """more, less: analyses with a toughness that is larger and smaller."""
        change = 2.0 * SHARE * LAW["normal_toughness"]
        quotients = [self.ends * [(a[0][f"reaction:{name}"] - b[0][f"reaction:{name}"]) / change
                                  for name in self.scene.patterns] for a, b in zip(more[1:], less[1:])]
        # Where nothing depends on the toughness, quotients are rounding.
        least = 1e-3 * max(abs(end * more[-1][0][f"reaction:{name}"])
                           for name, end in zip(self.scene.patterns, self.ends)) / LAW["normal_toughness"]
        size = max(least, *(np.max(np.abs(quotient)) for quotient in quotients))
        for k, ((derivative, unknown), quotient) in enumerate(zip(self.found, quotients), 1):
            if unknown == 0:
                expect_near(self.ends * derivative, quotient, QUOTIENT, size, f"sensitivity, step {k}")
                self.compared += bool(np.max(np.abs(quotient)) > QUOTIENT * size)
        expect(self.compared >= 2 or BRITTLE in self.scene.features, f"{self.compared} sensitivities were compared")


PROBES = {SENSITIVITY: Sensitivity, LOAD_TANGENT: LoadTangent, STEP_TANGENT: StepTangent, SAVED: Saved}

# ---- of delam/experimental.h, for which the package has no methods

library.delam_experimental_solver_follow.argtypes = (
    ctypes.c_void_p, ctypes.c_int64, ctypes.POINTER(ctypes.c_int64), ctypes.c_char_p, ctypes.POINTER(ctypes.c_int64))
library.delam_experimental_solver_sensitivity.argtypes = (
    ctypes.c_void_p, ctypes.c_int64, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_int64))


def follow(solver):
    solver.context.call(library.delam_experimental_solver_follow, solver._handle, 1,
                        ctypes.byref(ctypes.c_int64(0)), b"normal_toughness", None)


def sensitivity(solver):
    """The derivatives of all reactions by the toughness, and the number of pairs whose derivative is unknown."""
    count = len(solver.problem.patterns)
    matrix, unknown = (ctypes.c_double * count)(), ctypes.c_int64()
    solver.context.call(library.delam_experimental_solver_sensitivity, solver._handle, count, matrix,
                        ctypes.byref(unknown))
    return np.array(matrix), unknown.value
