# SPDX-License-Identifier: BSD-3-Clause
# A small scene whose crack grows steadily: 100 mm x 3 mm, a notch of 30 mm, opened at the left end.

bilinear() = Law("piecewise-linear"; normal_stiffness=1e12, tangential_stiffness=1e12, normal_onset=50.0,
    tangential_onset=50.0, normal_toughness=280.0, tangential_toughness=280.0)

"The same law by Julia functions: the traction falls on a straight line."
function host_bilinear(; spy=identity)
    onset, total = 50.0, 280.0
    span = total - onset
    function adhesion(mixity, driving)
        spy(:adhesion)
        driving <= onset && return 1.0, 0.0
        root = total * sqrt(onset / driving)
        zeta = (root - onset) / span
        return zeta <= 0.0 ? (0.0, 0.0) : (zeta, -0.5 * root / (driving * span))
    end
    function dissipation(mixity, zeta)
        spy(:dissipation)
        within = onset + span * zeta
        energy = onset * total^2 / span * (1.0 / within - 1.0 / total)
        return energy, -onset * total^2 / within^2, 0.0
    end
    return host_law("bilinear by hand", adhesion, dissipation; normal_stiffness=1e12, tangential_stiffness=1e12)
end

function double_cantilever(; law=bilinear(), divisions=50, progress=nothing)
    mesh = Mesh(lengths=0.1, divisions=divisions, thickness=[1.5e-3, 1.5e-3], layer_divisions=[1, 1])
    glue = add_interface!(mesh, 0, 1)
    problem = Problem(mesh; plane="plane-strain", progress=progress)
    set_elastic!(problem, 135e9, 0.3)
    set_formulation!(problem, "incompatible")
    set_law!(problem, glue, law)
    set_adhesion!(problem, glue, places(glue)[1, :] .< 0.03)
    opening = add_pattern!(problem, "opening", [0, 1], [0, 6e-3])
    prescribe!(problem, find_node(mesh, (0, 3e-3)), "y", opening => 0.5)
    prescribe!(problem, find_node(mesh, (0, 0)), "-y", opening => 0.5)
    prescribe!(problem, find_nodes(mesh, (0.1, 0), (0.1, 3e-3)), "x")
    return problem
end
