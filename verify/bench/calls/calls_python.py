# SPDX-License-Identifier: BSD-3-Clause
"""calls_python.py CALLS STEPS: as calls.c, through the package delam."""
import sys
import time

import delam


def make_solver():
    mesh = delam.Mesh.layers(0.1, 20, [2e-3, 2e-3], [1, 1])
    glue = mesh.add_interface(0, 1)
    law = delam.Law("piecewise-linear", normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0,
                    tangential_onset=50.0, normal_toughness=250.0, tangential_toughness=250.0)
    problem = delam.Problem(mesh)
    problem.set_elastic(70e9, 0.3)
    problem.set_law(glue, law)
    pull = problem.add_pattern("pull", [0.0, 1.0, 2.0], [0.0, 1e-6, 4e-3])
    problem.prescribe(mesh.find_node((0.0, 0.0)), "x")
    problem.prescribe(mesh.find_node((0.0, 0.0)), "y")
    problem.prescribe(mesh.find_node((0.1, 0.0)), "y")
    problem.prescribe(mesh.find_node((0.05, 4e-3)), "-y", pull)
    return delam.Solver(problem)


def main():
    calls, steps = int(sys.argv[1]), int(sys.argv[2])
    solver = make_solver()
    values, total = solver.values, 0.0
    begin = time.process_time_ns()
    for _ in range(calls):
        total += values["time"]
    per_call = (time.process_time_ns() - begin) / calls
    begin = time.process_time_ns()
    for i in range(1, steps + 1):
        solver.advance(i / steps)
        solver.commit()
    per_step = (time.process_time_ns() - begin) / steps
    for i in range(1, 11):
        solver.advance(1.0 + i / 10.0)
        solver.commit()
    state = [values[key] for key in ("reaction:pull", "stored_bulk", "stored_interface", "dissipated", "work")]
    print(f"{per_call:.6g} {per_step:.6g}", *(f"{v:.17g}" for v in (total, *state, *solver.field("adhesion"))))


main()
