#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The same analysis in few and in many load steps: what it dissipates, which jumps it reports, and what its energy balance leaves
open, work less stored, dissipated and released energy.

    steps.py [--all | --outcomes]

- single-leg bending, by two laws: mixed mode, stable growth from a notch. No jump; dissipated energies within 0.5 %.
- two arms opened, then one of them turned back: loads that are not in proportion. No jump.
- two arms opened, one mode, on a mesh that lets pairs pop: no jump, and at most one and a half times the iterations of
  steps that are not followed.
- a film that comes off by a change of temperature, at an energy release rate that does not depend on its length: one
  jump through the rest of the interface, which releases next to nothing.
- the first and the second with solution = energetic: no jump either, and what the search has left out bounded closely.
- a film that comes off in one step, energetic: its contact sets are found.
With options that leave no path to follow, step_control = load is refused.

--outcomes prints what the analyses give, without judging it: what each dissipates, and its jumps. verify/bench/constants.py
compares these lines when it varies the constants."""
import argparse
import itertools
import sys

import delam

FEW, MANY = (10, 40), (10, 15, 25, 40, 100, 300)
failures = 0


def expect(condition, what):
    global failures
    print(("ok    " if condition else "FAIL  ") + what)
    failures += 0 if condition else 1


def law(normal, shear):
    return delam.Law("piecewise-linear", criterion="benzeggagh-kenane", normal_stiffness=1e14, tangential_stiffness=1e14,
                     normal_toughness=100.0, tangential_toughness=400.0, normal_onset=normal, tangential_onset=shear,
                     onset_exponent=1.5, toughness_exponent=1.5)


def arms(law_of, columns=160):
    mesh = delam.Mesh.layers(0.06, columns, [0.002, 0.002], [2, 2], "quad4")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_elastic(70e9, 0.3)
    problem.set_law(interface, law_of)
    problem.set_adhesion(interface, interface.places[:, 0] < 0.015 - 1e-6, 0.0)
    return mesh, problem


def bending(law_of):
    mesh, problem = arms(law_of)
    press = problem.add_pattern("press", [0, 1], [0, 0.003])
    problem.prescribe_mean(*mesh.find_patch(1, (0.0, 0.002), (0.0, 0.004), (-1.0, 0.0)), "y")
    for axis in "xy":
        problem.prescribe_mean(*mesh.find_patch(0, (0.0585, 0.0), (0.0595, 0.0), (0.0, -1.0)), axis)
    problem.prescribe_mean(*mesh.find_patch(1, (0.0295, 0.004), (0.0305, 0.004), (0.0, 1.0)), "-y", drive=press)
    return problem


def turned():
    mesh, problem = arms(law(2.0, 8.0))
    upper = problem.add_pattern("upper", [0, 0.5, 1], [0, 0.0025, 0.0025])
    lower = problem.add_pattern("lower", [0, 0.5, 1], [0, 0.0025, 0.001])
    for axis in "xy":
        problem.prescribe(mesh.find_nodes((0.06, 0.0), (0.06, 0.004)), axis)
    problem.prescribe_mean(*mesh.find_patch(1, (0.0, 0.002), (0.0, 0.004), (-1.0, 0.0)), "y", drive=upper)
    problem.prescribe_mean(*mesh.find_patch(0, (0.0, 0.0), (0.0, 0.002), (-1.0, 0.0)), "y", drive=lower)
    return problem


def opened():
    """The process zone has five pairs, which pop a little."""
    mesh = delam.Mesh.layers(0.1, 1000, [0.0015, 0.0015], [2, 2], "quad4")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_elastic(20e9, 0.25)
    problem.set_law(interface, delam.Law("piecewise-linear", normal_stiffness=5.7e17, tangential_stiffness=5.7e17,
                                         normal_toughness=280.0, tangential_toughness=280.0, normal_onset=0.00285,
                                         tangential_onset=0.00285))
    problem.set_adhesion(interface, interface.places[:, 0] < 0.03 - 1e-6, 0.0)
    pull = problem.add_pattern("pull", [0, 1], [0, 0.008])
    for axis in "xy":
        problem.prescribe(mesh.find_nodes((0.1, 0.0), (0.1, 0.003)), axis)
    problem.prescribe_mean(*mesh.find_patch(1, (0.0, 0.0015), (0.0, 0.003), (-1.0, 0.0)), "y", drive=pull)
    problem.prescribe_mean(*mesh.find_patch(0, (0.0, 0.0), (0.0, 0.0015), (-1.0, 0.0)), "-y", drive=pull)
    return problem


def film(notch=0.01, length=0.03, columns=150, substrate=0.001, cells=1):
    mesh = delam.Mesh.layers(length, columns, [0.0002, substrate], [cells, 2], "quad4")
    interface = mesh.add_interface(0, 1)
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_elastic(70e9, 0.33, body=0)
    problem.set_elastic(200e9, 0.3, body=1)
    problem.set_law(interface, delam.Law("piecewise-linear", normal_stiffness=1e14, tangential_stiffness=1e14,
                                         normal_toughness=10.0, tangential_toughness=10.0, normal_onset=0.5,
                                         tangential_onset=0.5))
    problem.set_adhesion(interface, interface.places[:, 0] < notch - 1e-6, 0.0)
    cool = problem.add_pattern("cool", [0, 1], [0, -150.0])
    for body, expansion in ((0, 2.3e-5), (1, 1.2e-5)):
        problem.add_eigenstrain(cool, [expansion] * 3 + [0.0] * 3, body=body)
    problem.prescribe(mesh.find_nodes((length, 0.0), (length, 0.0002 + substrate)), "x")
    problem.prescribe(mesh.find_nodes((length, 0.0), (length, 0.0), body=0), "y")
    return problem


def analyse(problem, steps):
    problem.options["step_control"] = "load"
    problem.options["path_step"] = 0.1
    solver = delam.Solver(problem)
    released = 0.0
    for step in range(1, steps + 1):
        solver.advance(step / steps)
        solver.commit()
        released += solver.values["released"]
    return solver, released


def balance(solver, released):
    """What the four energies leave open, over the dissipated one; each is read from another value."""
    values = solver.values
    stored = values["stored_bulk"] + values["stored_interface"] + values["load_potential"]
    return (values["work"] - stored - values["dissipated"] - released) / values["dissipated"]


def steady(name, make, counts, bound):
    """bound: of what the balance leaves open, over the dissipated energy."""
    dissipated, opens = [], []
    for steps in counts:
        solver, released = analyse(make(), steps)
        dissipated.append(solver.values["dissipated"])
        opens.append(balance(solver, released))
        print(f"      {name}, {steps} steps: dissipated {dissipated[-1]:.5f} J/m, released {released:.5f}, open "
              f"{100 * opens[-1]:.3f} %, {len(solver.jumps)} jumps")
        expect(not solver.jumps, f"{name}, {steps} steps: growth is no jump")
    spread = (max(dissipated) - min(dissipated)) / min(dissipated)
    expect(spread < 5e-3, f"{name}: dissipated within 0.5 % ({100 * spread:.2f} %)")
    expect(max(map(abs, opens)) < bound, f"{name}: the balance is open by {100 * max(map(abs, opens)):.2f} % at most")
    expect(max(map(abs, opens)) > 1e-7, f"{name}: what is open is measured, not defined")


def iterations(problem, control, steps):
    problem.options["step_control"] = control
    solver = delam.Solver(problem)
    count = 0
    for step in range(1, steps + 1):
        solver.advance(step / steps)
        solver.commit()
        count += solver.values["am_iterations"]
    return count


def cheap(name, make, steps):
    followed, plain = iterations(make(), "load", steps), iterations(make(), "fixed", steps)
    expect(followed <= 1.5 * plain, f"{name}, {steps} steps: {followed:.0f} iterations, {plain:.0f} without parts")


def jumping(name, make, length, counts):
    times = []
    for steps in counts:
        solver, released = analyse(make(), steps)
        jumps = list(solver.jumps)
        print(f"      {name}, {steps} steps: " + "; ".join(
            f"time {j.time:.4f}, {1e3 * j.debonded:.2f} mm, released {j.released:.4f} J/m" for j in jumps))
        expect(len(jumps) == 1, f"{name}, {steps} steps: one jump")
        if jumps:
            times.append(jumps[0].time)
            expect(abs(jumps[0].debonded - length) < 0.12 * length, f"{name}, {steps} steps: through the interface")
            expect(jumps[0].released >= 0.0, f"{name}, {steps} steps: it releases no negative energy")
        expect(abs(balance(solver, released)) < 5e-3, f"{name}, {steps} steps: the balance is closed")
    expect(max(times) - min(times) < 0.03 * max(times), f"{name}: at the same load within 3 %")


def searched(name, make, counts, bound):
    """bound: of search_gap, over the energy or the work."""
    for steps in counts:
        problem = make()
        problem.options["solution"] = "energetic"
        solver = delam.Solver(problem)
        gap = margin = 0.0
        for step in range(1, steps + 1):
            solver.advance(step / steps)
            solver.commit()
            values = solver.values
            scale = max(values["stored_bulk"] + values["stored_interface"] + values["dissipated"], values["work"])
            gap, margin = max(gap, values["search_gap"] / scale), min(margin, values["search_margin"] / scale)
        expect(not solver.jumps, f"{name}, energetic, {steps} steps: growth is no jump ({len(solver.jumps)})")
        expect(gap < bound, f"{name}, energetic, {steps} steps: gap {100 * gap:.2f} % of the energy")
        expect(margin > -1e-8, f"{name}, energetic, {steps} steps: the lowest state that was seen is kept "
               f"({-margin:.1e} of the energy)")


def comes_off(steps):
    """Energetic: the whole film comes off in one step. Its faces come apart pair by pair, unless coarse sets go first."""
    problem = film(length=0.06, columns=300, substrate=0.002, cells=2)
    problem.options["solution"] = "energetic"
    solver = delam.Solver(problem, not_converged="raise")
    try:
        for step in range(1, steps + 1):
            solver.advance(step / steps)
            solver.commit()
        failed = ""
    except delam.NotConverged as error:
        failed = str(error)
    expect(not failed, f"film, energetic, {steps} steps: each contact set is found {failed}")


def refused():
    """The option goes with others only where they leave a path to follow."""
    for key, value in (("solution", "energetic"), ("mixity_rule", "frozen"), ("minimisation", "alternate"),
                       ("backtracking", "on"), ("path_step", 1.0), ("jump_tolerance", 1e-3),
                       ("mixity_step_tolerance", 0.01)):
        problem = film()
        problem.options["step_control"] = "load"
        problem.options[key] = value
        try:
            delam.Solver(problem)
            message = ""
        except delam.ProblemError as error:
            message = str(error)
        expect("step_control = load needs" in message and key in message, f"refused with {key} = {value}: {message}")


SCENES = {"bending": lambda: bending(law(2.0, 8.0)), "bending, equal strengths": lambda: bending(law(2.0, 2.0)),
          "turned back": turned, "opened": opened, "film": film}


def outcomes():
    for (name, make), steps in itertools.product(SCENES.items(), FEW):
        solver, _ = analyse(make(), steps)
        print(f"{name}: dissipated {solver.values['dissipated']:.6g}")
        for jump in solver.jumps:
            print(f"{name}: jump at {jump.time:.4g} over {jump.debonded:.4g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--all", action="store_true", help="more numbers of steps")
    parser.add_argument("--outcomes", action="store_true", help="print results alone")
    arguments = parser.parse_args()
    if arguments.outcomes:
        outcomes()
        return
    counts = MANY if arguments.all else FEW
    steady("bending", SCENES["bending"], counts, 1.5e-3)
    steady("bending, equal strengths", SCENES["bending, equal strengths"], counts, 1.5e-3)
    steady("turned back", turned, counts, 1.5e-3)
    steady("opened", opened, counts, 5e-3)
    cheap("opened", opened, 40)
    jumping("film", film, 0.02, counts)
    searched("bending", SCENES["bending"], (15, 40), 0.02)
    searched("turned back", turned, (24,), 0.015)
    comes_off(20)
    refused()
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
