# SPDX-License-Identifier: BSD-3-Clause
#
# A double cantilever beam in space whose interface obeys a law of the host's own, from Julia.
#
#     julia --project=bindings/julia dcb_host_law.jl [history.csv]     without an argument to standard output
#
# The scene of dcb_host_law.c. What fails throws, with the library's message.
using Delam

const SPAN = 60e-3      # m
const WIDTH = 8e-3      # m
const HEIGHT = 1.5e-3   # of an arm, m
const NOTCH = 20e-3     # m
const STEPS = 16
const ONSET = 5.0       # energy at which the traction begins to fall, J/m2
const TOUGHNESS = 250.0 # J/m2

const VALUES = ["step", "time", "load:opening", "reaction:opening", "stored_bulk", "stored_interface", "dissipated",
    "work", "front"]

# The minimiser of adhesion * driving + dissipated, and its slope by the driving energy.
function adhesion(mixity, driving)
    r = TOUGHNESS / ONSET
    driving >= ONSET * r * r && return 0.0, 0.0
    driving <= ONSET && return 1.0, 0.0
    root = sqrt(ONSET / driving)
    return (r * root - 1.0) / (r - 1.0), -0.5 * r / (r - 1.0) * root / driving
end

# The energy spent down to an adhesion, and its slopes by adhesion and mixity.
function dissipation(mixity, zeta)
    r = TOUGHNESS / ONSET
    below = 1.0 + zeta * (r - 1.0)
    return TOUGHNESS - ONSET * r * r * zeta / below, -ONSET * (r / below) * (r / below), 0.0
end

function make_problem()
    mesh = Mesh(lengths=[SPAN, WIDTH], divisions=[60, 4], thickness=[HEIGHT, HEIGHT], layer_divisions=[2, 2])
    glue = add_interface!(mesh, 0, 1)
    law = host_law("bilinear by hand", adhesion, dissipation; normal_stiffness=1e13, tangential_stiffness=1e13)

    problem = Problem(mesh)
    set_elastic!(problem, 120e9, 0.3)
    set_formulation!(problem, "incompatible")
    set_law!(problem, glue, law)
    # The notch has no adhesion from the start; the pairs at its tip, on the side of the box, are bonded.
    set_adhesion_box!(problem, glue, (0.0, 0.0, 0.0), (NOTCH, WIDTH, 2.0 * HEIGHT))

    opening = add_pattern!(problem, "opening", [0.0, 1.0], [0.0, 1.6e-3])
    right = find_nodes(mesh, (SPAN, 0.0, 0.0), (SPAN, WIDTH, 2.0 * HEIGHT))
    for axis in ("x", "y", "z")
        prescribe!(problem, right, axis)
    end
    top = find_nodes(mesh, (0.0, 0.0, 2.0 * HEIGHT), (0.0, WIDTH, 2.0 * HEIGHT))
    prescribe!(problem, top, "z", opening => 0.5)
    prescribe!(problem, find_nodes(mesh, (0.0, 0.0, 0.0), (0.0, WIDTH, 0.0)), "-z", opening => 0.5)
    check(problem)
    return problem
end

march() = history(Solver(make_problem()), [step / STEPS for step in 1:STEPS]; values=VALUES)

titles = [first(split(name, ":")) for name in VALUES]
write_csv(isempty(ARGS) ? stdout : ARGS[1], march(); titles=titles)
