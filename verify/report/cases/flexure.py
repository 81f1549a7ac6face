# SPDX-License-Identifier: BSD-3-Clause
"""The flexure specimens of chapter (b) by the Python package: end-notched (ENF) and mixed-mode (MMF), ductile and
brittle, and their analyses."""
import types

import numpy as np

from case import reference

LENGTH, ARM, NOTCH, LOAD, END = 120e-3, 3e-3, 30e-3, 6e-3, 2.0  # m; LOAD at time END
LAWS = {"ductile": (125e9, 100.0, 250.0), "brittle": (125e15, 0.01, 25.0)}  # stiffness, N/m3; onset and toughness, J/m2
ENERGIES = ("stored_bulk", "stored_interface", "dissipated", "work")
VALUES = (*ENERGIES, "lower", "upper", "increment", "increment_lower", "mixity_error", "reaction:load")

ENF = dict(geometry="two arms 120 mm x 3 mm, notch 30 mm, 4-node cells, plane strain",
           supports="bottom corners (ENF), the notched end at the "
           "interface (MMF); midspan pressed by 6 mm", units="energies in J per metre of width; loads in mm")
DUCTILE = "E = 75 GPa, nu = 0.3; k = 125e9 N/m3, Go = 100, Gc = 250 J/m2"
BRITTLE = "E = 75 GPa, nu = 0.3; k = 125e15 N/m3, Go = 0.01, Gc = 25 J/m2"
BALANCE = reference("physics", "stored + dissipated = work of the loads for a continuous evolution; the discrete "
                               "defect is O(tau)",
                    "none: an identity; the work inside a step is the trapezoid of the reactions, with an error of "
                    "the order of the band")
RULES = {"frozen": {"mixity_rule": "frozen"}, "converged": {"mixity_rule": "converged"}, "variational": {"mixity_rule": "variational"}}
ETA = 1e-3  # tolerance of the two-sided estimate
ROUNDING = 1e-12  # of a defect, over the work


def scene(delam, specimen, h, patch=0.0, element="quad4", **options):
    """Problem and interface; patch: length over which supports and load are spread as means, 0: points."""
    stiffness, onset, toughness = LAWS[specimen[4:]]
    quadratic, margin = element == "quad8", 0.25 * h / (2.0 if element == "quad8" else 1.0)
    mesh = delam.Mesh.layers(LENGTH, round(LENGTH / h), [ARM, ARM], [max(1, round(ARM / h))] * 2,
                             "quad8" if quadratic else "quad4")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_elastic(75e9, 0.3)
    problem.set_formulation("incompatible" if element == "quad4-incompatible" else "standard")
    problem.options["step_control"] = "fixed"  # whole steps, like the tables of PANM 15
    problem.set_law(interface, delam.Law("piecewise-linear", normal_stiffness=stiffness, tangential_stiffness=stiffness,
                                         normal_onset=onset, tangential_onset=onset,
                                         normal_toughness=toughness, tangential_toughness=toughness))
    problem.set_adhesion(interface, interface.places[:, 0] < NOTCH - margin, 0.0)
    load = problem.add_pattern("load", [0.0, END], [0.0, LOAD])

    def prescribe(body, x, y, directions, **drive):
        x = min(max(x, 0.5 * patch), LENGTH - 0.5 * patch)
        outward = 1.0 if y > (0.5 + body) * ARM else -1.0
        for direction in directions:
            if patch:
                nodes, weights = mesh.find_patch(body, (x - 0.5 * patch, y), (x + 0.5 * patch, y), (0.0, outward))
                problem.prescribe_mean(nodes, weights, direction, **drive)
            else:
                problem.prescribe(mesh.find_node((x, y), body=body), direction, **drive)

    prescribe(*((1, 0.0, ARM) if specimen.startswith("mmf") else (0, 0.0, 0.0)), ("y",))
    prescribe(0, LENGTH, 0.0, ("x", "y"))
    prescribe(1, 0.5 * LENGTH, 2.0 * ARM, ("-y",), drive=load)
    for key, value in options.items():
        problem.options[key] = value
    return problem, interface


def dofs(delam, specimen, h, element="quad4"):
    return scene(delam, specimen, h, element=element)[0].dofs[0]


def analyse(delam, specimen, h, steps, patch=0.0, element="quad4", adhesion=False, **options):
    """An analysis of equal steps: `at`, lists of the values after every step, the initial state first; `open`, the steps
    that met an iteration limit; `adhesion`, that of all pairs after every step, where asked for; `x`, their places."""
    problem, interface = scene(delam, specimen, h, patch, element, **options)
    out = types.SimpleNamespace(h=h, steps=steps, dofs=problem.dofs[0], open=0, x=interface.places[:, 0], adhesion=[])
    with delam.Solver(problem) as solver:
        solver.not_converged = "raise"
        history = delam.History(solver, VALUES)
        for k in range(steps + 1):
            if k > 0:
                try:
                    solver.advance(END * k / steps)
                except delam.NotConverged:
                    out.open += 1
                solver.commit()
                history.record()
            if adhesion:
                out.adhesion.append(np.array(solver.field("adhesion")))
    out.at = {name: [float(v) for v in history[name]] for name in VALUES}
    return out


def total(at):
    return [a + b + c for a, b, c in zip(at["stored_bulk"], at["stored_interface"], at["dissipated"])]


def defect(at):
    """Largest |stored + dissipated - work| over the final work."""
    return max(abs(a - b) for a, b in zip(total(at), at["work"])) / at["work"][-1]


def violations(at):
    """Of every step: how far below the lower and above the upper bound, over the larger of stored energy and work."""
    out = []
    for k in range(1, len(at["work"])):
        size = max(abs(at["stored_bulk"][k] + at["stored_interface"][k]), abs(at["work"][k]))
        out.append(((at["lower"][k] - at["increment_lower"][k]) / size, (at["increment"][k] - at["upper"][k]) / size))
    return out
