# SPDX-License-Identifier: BSD-3-Clause
"""Double cantilever beams: two published ones by their scenes in examples/, and the same beam in the plane and in space."""
import os

import h5py
import numpy as np

from coarse_scenes import COARSE, STIFF, coarse_run, front_of, resolved, sound
from support import expect, finish, write

EXAMPLES = os.environ["DELAM_EXAMPLES"]


# The published beams are those of their files; test_examples runs them clamped closer to the crack.
for name, settings, checks in (("dcb-alfano", [], COARSE["dcb-alfano"][1]), ("dcb-krueger", [], COARSE["dcb-krueger"][1]), STIFF):
    run = coarse_run(os.path.join(EXAMPLES, name, name + ".toml"), settings)
    for check in (sound, *checks) if run else ():
        check(name, run)
LENGTH, CELLS, STEPS = 0.060, 80, 28


def beam(dimension, divisions, width, supports):
    """The ply of dcb-krueger with an interface that coarse cells resolve. The loads act on the corners of the arms, or edges."""
    space = dimension == 3

    def place(x, y, z):
        return str([x, y, z] if space else [x, z])

    load = "[[loads]]\nbox = {{ lower = {}, upper = {} }}\ndirection = {}\npattern = \"open\"\n"
    up, down = ("[0, 0, 1]", "[0, 0, -1]") if space else ("[0, 1]", "[0, -1]")
    layer = "[[layers]]\nname = \"{}\"\nthickness = 0.0015\ndivisions = 2\nmaterial = \"ply\"\n"
    return write(f"""
schema = 1
[geometry]
dimension = {dimension}
length = {LENGTH}
divisions = {divisions}
{"width = " + str(width) if space else ""}
[[materials]]
name = "ply"
E1 = 139.4e9
E2 = 10.16e9
G12 = 4.6e9
nu12 = 0.30
nu23 = 0.436
formulation = "incompatible"
{layer.format("lower")}{layer.format("upper")}
[[laws]]
name = "resin"
normal_stiffness = 1e14
tangential_stiffness = 1e14
normal_onset = 0.32
tangential_onset = 0.32
normal_toughness = 170.3
tangential_toughness = 170.3
[[interfaces]]
lower = "lower"
upper = "upper"
law = "resin"
notch = [{{ from = 0.0, to = 0.030 }}]
[[supports]]
box = {{ lower = {place(LENGTH, 0.0, 0.0)}, upper = {place(LENGTH, width, 0.003)} }}
fix = {'["x", "y", "z"]' if space else '["x", "y"]'}
{supports}
[[patterns]]
name = "open"
times = [0.0, 1.0]
values = [0.0, 0.0014]
{load.format(place(0.0, 0.0, 0.003), place(0.0, width, 0.003), up)}{load.format(place(0.0, 0.0, 0.0), place(0.0, width, 0.0), down)}
[time]
end = 1.0
steps = {STEPS}
[solver]
damage_tolerance = 1e-6
[output]
every = {STEPS}
""")


def side(width, to):
    return f'[[supports]]\nbox = {{ lower = [0.0, 0.0, 0.0], upper = [{LENGTH - 1e-4}, {to * width}, 0.003] }}\nfix = ["y"]\n'


def front_in_plane(of):
    with h5py.File(os.path.join(of.out, "fields.h5"), "r") as file:
        return file["steps"][sorted(file["steps"])[-1]]["interface_0"]["front_points"][0, 0]


# Without strain across the width a slab in space is the plane one, whatever its width: discretised the same way, so to rounding and what the
# tolerance of the damage leaves. A wide beam with a free edge differs by that edge: little as long as nothing breaks, then by no more than the
# rows of cells (0.75 mm) that one of them breaks earlier, 3 % of the load each, and much less on average.
plane = coarse_run(beam(2, CELLS, 0.0, ""), [])
slab = coarse_run(beam(3, f"[{CELLS}, 2]", 0.004, side(0.004, 1)), [])
wide = coarse_run(beam(3, f"[{CELLS}, 8]", 0.025, side(0.025, 0)), [])
if plane and slab and wide:
    for key in ("reaction", "stored_bulk", "dissipated"):
        flat, solid = plane.history[key], slab.history[key] / 0.004
        expect(np.abs(solid - flat).max() < 1e-4 * np.abs(flat).max(),
               f"plane strain in space: {key} differs by {np.abs(solid - flat).max() / np.abs(flat).max():.1e}")
    flat, solid = plane.history["reaction"], wide.history["reaction"] / 0.025
    off, peak = solid[1:] / flat[1:] - 1, int(flat.argmax())
    mean = solid[peak:].mean() / flat[peak:].mean() - 1
    expect(np.abs(off[:peak - 1]).max() < 3e-3 and np.abs(off).max() < 0.035 and abs(mean) < 0.01,
           f"wide beam: load per width within {100 * np.abs(off[:peak - 1]).max():.2f} % of the plane one before the peak, "
           f"{100 * np.abs(off).max():.2f} % in all steps, {100 * mean:+.2f} % on average after it")
    front = front_of(wide)
    off = front[0, 0] + 0.375e-3 - front_in_plane(plane)  # half a cell: what is called front in space and in the plane
    expect(abs(off) <= 0.375e-3 and front_in_plane(plane) > 0.036,
           f"wide beam: front at mid-width {1e3 * front[0, 0]:.2f} mm, in the plane {1e3 * front_in_plane(plane):.2f} mm")
    resolved("plane beam", plane)
    expect(0 < front[0, 0] - front[-1, 0] < 2.5e-3 and np.all(np.abs(front[front[:, 1] < 0.02, 0] - front[0, 0]) < 0.75e-3),
           f"wide beam: straight but for the edge, where the front is {1e3 * (front[0, 0] - front[-1, 0]):.2f} mm behind")
finish()
