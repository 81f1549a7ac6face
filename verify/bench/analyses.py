#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Small analyses that meet most of the library: the scenes of the table of features (verify/cases/features), one or two
features each, those of the search (verify/cases/search), and bodies that turn.

    analyses.py [NAME ..]

Prints the values of each state and, as `cost` lines, what its steps took: constants.py compares them."""
import logging
import pathlib
import sys

import numpy as np

import delam

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(ROOT / "cases" / "features"), str(ROOT / "cases" / "search"), str(ROOT / "bench")]
import energetic  # noqa: E402
import laminates  # noqa: E402
import scene as features  # noqa: E402

BY_NAME = {feature.name: feature for feature in (*features.FEATURES, features.SPACE)}
SCENES = [("condensed",), ("iterated",), ("FETI",), ("energetic",), ("frozen",), ("variational",), ("host stiffness",),
          ("periodic cell",), ("eigenstrain",), ("gradient term",), ("control node", "FETI"), ("dead force", "iterated"),
          ("brittle law",), ("brittle law", "energetic"), ("adaptive steps",), ("located jumps", "brittle law"),
          ("sensitivities",), ("step tangent",), ("space", "iterated"), ("space", "FETI"), ("space", "gradient term")]
# What a step took; all other values are results. Errors and gaps are as small as rounding lets them be.
COSTS = ("am_iterations", "displacement_solves", "contact_iterations", "linear_iterations", "newton_solves", "search_candidates",
         "bulk_factorisations", "field_recoveries")
SKIPPED = ("contact_", "kkt_", "linear_residual", "damage_change", "defect", "debond_moves", "search_margin", "search_gap",
           "substeps", "mixity_error", "lower", "upper", "increment", "pops", "popped", "released", "refused_steps", "mesh_excess")


def tell(name, solver, costs):
    values = solver.values
    size = max(abs(values[key]) for key in ("stored_bulk", "dissipated", "work"))
    for key in values:
        if key in COSTS:
            costs[key] = costs.get(key, 0.0) + values[key]
        elif not key.startswith(SKIPPED):
            # Energies below a millionth of the largest one are rounding.
            small = key in ("load_potential", "stored_interface", "stored_interface_slides") and abs(values[key]) < 1e-6 * size
            print(f"{name}, {key}: {0.0 if small else values[key]:.7g}")


def follow(name, problem, times, probe=None):
    solver, costs = delam.Solver(problem), {}
    for time in times:
        solver.advance(time)
        if probe == "step tangent":
            print(f"{name}, tangent at {time:g}: {np.linalg.norm(solver.step_tangent()):.6g}")
        solver.commit()
        tell(f"{name} at {time:g}", solver, costs)
    for jump in solver.jumps:
        print(f"{name}, jump: at {jump.time:.5g} over {jump.debonded:.5g}")
    for key, cost in costs.items():
        print(f"cost {name}, {key}: {cost:.0f}")


def main():
    logging.disable(logging.CRITICAL)
    named = {" x ".join(names): names for names in SCENES}
    for name, names in named.items():
        if not sys.argv[1:] or name in sys.argv[1:]:
            follow(name, features.Scene([BY_NAME[one] for one in names]).problem, features.TIMES, names[0])
    for name, problem in (("followed", features.Scene([]).problem), ("search", energetic.SCENES["two fronts"]()),
                          ("turned", laminates.SCENES["turned-in-space"]())):
        if not sys.argv[1:] or name in sys.argv[1:]:
            problem.options["step_control"] = "auto"
            if name == "followed":
                problem.options["damage_tolerance"] = 1e-5
            if name == "search":
                problem.options["solution"] = "energetic"
            follow(name, problem, (0.3, 0.6, 1.0))
    return 0


if __name__ == "__main__":
    sys.exit(main())
