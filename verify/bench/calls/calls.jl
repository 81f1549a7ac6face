# SPDX-License-Identifier: BSD-3-Clause
#
# calls.jl CALLS STEPS: as calls.c, through the package Delam. By the wall clock: Julia has no other. What is
# timed is compiled before.
using Delam

function make_solver()
    mesh = Mesh(lengths=0.1, divisions=20, thickness=[2e-3, 2e-3], layer_divisions=[1, 1])
    glue = add_interface!(mesh, 0, 1)
    law = Law("piecewise-linear"; normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0,
        tangential_onset=50.0, normal_toughness=250.0, tangential_toughness=250.0)
    problem = Problem(mesh)
    set_elastic!(problem, 70e9, 0.3)
    set_law!(problem, glue, law)
    pull = add_pattern!(problem, "pull", [0.0, 1.0, 2.0], [0.0, 1e-6, 4e-3])
    prescribe!(problem, find_node(mesh, (0.0, 0.0)), "x")
    prescribe!(problem, find_node(mesh, (0.0, 0.0)), "y")
    prescribe!(problem, find_node(mesh, (0.1, 0.0)), "y")
    prescribe!(problem, find_node(mesh, (0.05, 4e-3)), "-y", pull)
    return Solver(problem)
end

function timed(calls, steps)
    solver, total = make_solver(), 0.0
    begun = time_ns()
    for _ in 1:calls
        total += solver["time"]
    end
    per_call = (time_ns() - begun) / calls
    begun = time_ns()
    for i in 1:steps
        advance!(solver, i / steps)
        commit!(solver)
    end
    per_step = (time_ns() - begun) / steps
    for i in 1:10
        advance!(solver, 1.0 + i / 10.0)
        commit!(solver)
    end
    state = [solver[key] for key in ("reaction:pull", "stored_bulk", "stored_interface", "dissipated", "work")]
    return [per_call; per_step; total; state; field(solver, "adhesion")]
end

timed(1, 1)
println(join(timed(parse(Int64, ARGS[1]), parse(Int64, ARGS[2])), " "))
