# SPDX-License-Identifier: BSD-3-Clause
#
# The end-notched flexure test with a ductile interface (Zeman, Kruzik, Gruber, PANM 15, 2010), from Julia.
#
#     julia --project=bindings/julia enf.jl [history.csv]     without an argument the history goes to standard output
#
# The scene of enf.c. What fails throws, with the library's message.
using Delam

const SPAN = 120e-3   # m
const HEIGHT = 3e-3   # of an arm, m
const NOTCH = 30e-3   # m
const STEPS = 40

const VALUES = ["step", "time", "load:load", "reaction:load", "stored_bulk", "stored_interface", "dissipated",
    "stored_interface_slides", "dissipated_slides", "work", "lower", "increment", "upper", "increment_lower",
    "am_iterations", "linear_iterations", "contact_pairs", "debonded_length", "backtracks"]

function make_problem()
    mesh = Mesh(lengths=SPAN, divisions=240, thickness=[HEIGHT, HEIGHT], layer_divisions=[6, 6])
    glue = add_interface!(mesh, 0, 1)
    law = Law("piecewise-linear"; normal_stiffness=125e9, tangential_stiffness=125e9, normal_onset=100.0,
        tangential_onset=100.0, normal_toughness=250.0, tangential_toughness=250.0, onset_exponent_1=2.0,
        onset_exponent_2=2.0, toughness_exponent_1=2.0, toughness_exponent_2=2.0)

    problem = Problem(mesh; plane="plane-strain")
    set_elastic!(problem, 75e9, 0.3)
    set_law!(problem, glue, law)
    # The notch has no adhesion from the start; the pair at its tip, on the side of the box, is bonded.
    set_adhesion_box!(problem, glue, (0.0, 0.0), (NOTCH, 2.0 * HEIGHT))

    load = add_pattern!(problem, "load", [0.0, 2.0], [0.0, 6e-3])
    left, right = find_node(mesh, (0.0, 0.0); body=0), find_node(mesh, (SPAN, 0.0); body=0)
    prescribe!(problem, left, "y")
    prescribe!(problem, right, "x")
    prescribe!(problem, right, "y")
    prescribe!(problem, find_node(mesh, (0.5 * SPAN, 2.0 * HEIGHT); body=1), "-y", load)
    check(problem)
    return problem
end

march() = history(Solver(make_problem()), [2.0 * step / STEPS for step in 1:STEPS]; values=VALUES)

titles = [first(split(name, ":")) for name in VALUES]
write_csv(isempty(ARGS) ? stdout : ARGS[1], march(); titles=titles)
