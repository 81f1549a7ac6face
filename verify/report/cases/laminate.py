# SPDX-License-Identifier: BSD-3-Clause
"""A double cantilever of 24 plies of HTA913 with five interfaces that may break; the plies between them are bonded,
i.e. one body. Four inner cracks lie staggered before the one at mid-plane. After Robinson, Besant and Hitchings (ESIS
27, 2000), who had one of them."""

import bending

PLY, LENGTH = 0.1325e-3, 0.120                    # m
PLIES = (8, 2, 2, 2, 2, 8)                        # of each body, from the bottom up; a row of cells for each ply
# Where each interface is open at first, m.
OPEN = ((0.055, 0.065), (0.040, 0.050), (0.0, 0.030), (0.045, 0.055), (0.060, 0.070))
END = 0.016                                       # m, opening


def scene(delam, h, **options):
    mesh = delam.Mesh.layers(LENGTH, round(LENGTH / h), [n * PLY for n in PLIES], list(PLIES), "quad4")
    interfaces = [mesh.add_interface(k, k + 1) for k in range(len(OPEN))]
    problem = delam.Problem(mesh, plane="plane-strain")
    problem.options["kinematics"] = "linear"
    problem.set_orthotropic([115e9, 8.5e9, 8.5e9, 0.29, 0.29, 0.30, 4.5e9, 4.5e9, 3.3e9])
    problem.set_formulation("incompatible")
    law = delam.Law("piecewise-linear", criterion="benzeggagh-kenane", normal_stiffness=1e14, tangential_stiffness=1e14,
                    normal_onset=0.5 * 10e6 ** 2 / 1e14, tangential_onset=0.5 * 20e6 ** 2 / 1e14,
                    normal_toughness=200.0, tangential_toughness=800.0, onset_exponent=2.0, toughness_exponent=2.0)
    for interface, (first, last) in zip(interfaces, OPEN):
        problem.set_law(interface, law)
        x = interface.places[:, 0]
        problem.set_adhesion(interface, (x > first - 1e-3 * h) & (x < last - 1e-3 * h), 0.0)
    press = problem.add_pattern("press", [0.0, 1.0], [0.0, END])
    far = mesh.find_nodes((LENGTH, 0.0), (LENGTH, 24 * PLY))
    for direction in ("x", "y"):
        problem.prescribe(far, direction)
    # The arms, 12 plies each, are pulled apart at the faces of the outer 8.
    for body, bottom, direction in ((5, 16 * PLY, "y"), (0, 0.0, "-y")):
        nodes, weights = mesh.find_patch(body, (0.0, bottom), (0.0, bottom + 8 * PLY), (-1.0, 0.0))
        problem.prescribe_mean(nodes, weights, direction, drive={press: 0.5})
    for key, value in options.items():
        problem.options[key] = value
    return problem, interfaces


def analyse(delam, h, steps, **options):
    """bending.run with the crack lengths of the five interfaces as well."""
    problem, interfaces = scene(delam, h, **options)
    keys = [f"crack_length:{interface.index}" for interface in interfaces]
    return bending.run(delam, problem, [(END, steps)], keys)
