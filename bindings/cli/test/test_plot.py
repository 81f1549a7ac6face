# SPDX-License-Identifier: BSD-3-Clause
"""The plot script makes its pictures, in 2D and 3D, from whole and partial results."""
import contextlib
import io
import os
import runpy
import subprocess
import sys

from support import SCENE, brittle, changed, delam, draw, expect, finish, folder, read, write

PICTURES = ("load-displacement.png", "energies.png", "snapshots.png")


def path_of(name):
    return os.path.join(os.path.dirname(os.environ["DELAM_PLOT"]), name + ".py")


def script(name, *words):
    """The script itself, started once; the rest is drawn in this process."""
    done = subprocess.run(["/usr/bin/python3", path_of(name), *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def as_script(name, *words):
    """All lines of the script, as if it was started, but in this process, which has imported Matplotlib."""
    before, sys.argv = sys.argv, [path_of(name), *words]
    error = io.StringIO()
    try:
        with contextlib.redirect_stderr(error):
            runpy.run_path(path_of(name), run_name="__main__")
        code = 0
    except SystemExit as end:
        code = end.code or 0
    finally:
        sys.argv = before
    return code, error.getvalue()


def draws(scene, what, plot=draw):
    out = folder()
    code, _, error = delam("run", write(scene), "--out", out)
    expect(code == 0, f"{what}: run {error}")
    code, error = plot("plot", out)
    expect(code == 0, f"{what}: plot.py {error.strip()[-300:]}")
    expect(all(read(os.path.join(out, name)).startswith(b"\x89PNG") for name in PICTURES if name in os.listdir(out)) and
           set(PICTURES) <= set(os.listdir(out)), f"{what}: three pictures")
    return out


# An interpreter without packages (-S: not those of Debian).
for name in ("plot", "plot_family"):
    done = subprocess.run(["/usr/bin/python3", "-S", path_of(name), folder()], capture_output=True, text=True, check=False)
    expect(done.returncode == 2 and done.stderr.count("\n") == 1 and "/usr/bin/python3 has no numpy, matplotlib" in done.stderr and
           "python3-numpy, python3-matplotlib" in done.stderr, f"{name}.py without packages says what is missing: {done.stderr}")

coarse = changed("h = 0.0015", "h = 0.003")
draws(coarse, "2D", script)
triangles = changed("dimension = 2", 'dimension = 2\ncell = "tri3"', coarse)
draws(changed("steps = 20", "steps = 5\n[output]\nsnapshots = [1.0]", triangles),
      "2D, triangles, one snapshot")
solid = changed("dimension = 2", "dimension = 3\nwidth = 0.006", changed("h = 0.0015", "h = 0.003"))
solid = changed("point = [0.0, 0.0]", "box = { lower = [0, 0, 0], upper = [0, 0.006, 0] }", solid)
solid = changed("point = [0.120, 0.0]\nfix = [\"x\", \"y\"]",
                "box = { lower = [0.12, 0, 0], upper = [0.12, 0.006, 0] }\nfix = [\"x\", \"z\"]", solid)
solid = changed('fix = ["y"]', 'fix = ["y", "z"]', solid)
solid = changed("point = [0.060, 0.006]\ndirection = [0.0, -1.0]",
                "box = { lower = [0.06, 0, 0.006], upper = [0.06, 0.006, 0.006] }\ndirection = [0, 0, -1]", solid)
out = draws(changed("steps = 20", "steps = 4", solid), "3D")
expect("fronts.png" in os.listdir(out) and read(os.path.join(out, "fronts.png")).startswith(b"\x89PNG"), "3D: fronts in plan")
expect("cut.png" in os.listdir(out) and read(os.path.join(out, "cut.png")).startswith(b"\x89PNG"), "3D: a cut view")
for words, said in (((out, "--cut", "y=7"), "the cut at y = 7 meets no cell"), ((out, "--cut", "y=inf"), "takes x, y or z"),
                    ((out, "--cut", "u=1"), "takes x, y or z"), ((out, "--cut"), "usage")):
    code, error = draw("plot", *words)
    expect(said in error and (code == 2 or "meets no cell" in said), f"plot.py {' '.join(words[1:])}: {error.strip()[-100:]}")

import h5py  # noqa: E402
import numpy as np  # noqa: E402

from _pictures.cut import box_of, chosen_plane, draw_cut  # noqa: E402
from _pictures.fronts import lines_of, plan_of, sides_of  # noqa: E402
from _pictures.result import plt  # noqa: E402
from _pictures.section import Section  # noqa: E402

with h5py.File(os.path.join(out, "fields.h5"), "r") as file:
    last = file["steps"][sorted(file["steps"])[-1]]
    plane = chosen_plane(file, last)
    expect((plane.normal, round(plane.place, 12)) == (1, 0.003), "the cut runs along the beam in its middle, across the front")
    section = Section(file["mesh/cells"][()], file["mesh/body"][()], plane.distance(file["mesh/points"][()]))
    expect(np.allclose(box_of(file, last, 0.0, plane, section), [[0, 0], [0.12, 0.006]]), "and shows its whole side")
    figure, ax = plt.subplots()
    lines = draw_cut(ax, file, last, 0.0, plane, section)
    middle = np.array([line.mean(0) for line in lines.get_segments()])
    zeta = lines.get_array()
    expect(np.allclose(middle[:, 1], 0.003) and np.all(zeta[middle[:, 0] < 0.029] < 1e-12) and zeta[middle[:, 0] > 0.11].min() > 0.9,
           "on it the notch is open and the far end holds")
    colours = [c.get_facecolors() for c in ax.collections][0]
    expect(len(np.unique(colours, axis=0)) == 2, "in the tones of both arms")
    plt.close(figure)

# An interface around a yarn along x: its sides apart, and of a front around it half on each.
along, around = (values.ravel() for values in np.meshgrid(np.arange(5.0), (np.arange(16) + 0.5) * np.pi / 8, indexing="ij"))
points = np.column_stack([along, np.cos(around), 0.4 * np.sin(around)])
normals = np.column_stack([0 * along, 0.4 * np.cos(around), np.sin(around)])
ring = 16 * np.arange(4)[:, None] + np.arange(16)
after = 16 * np.arange(4)[:, None] + (np.arange(16) + 1) % 16
faces = np.stack([ring, after, after + 16, ring + 16], -1).reshape(-1, 4)
yarn = {"points": points, "weights": np.ones(80), "faces": faces,
        "frames": np.concatenate([normals, np.tile([1.0, 0, 0], (80, 1)), np.cross(normals, [1.0, 0, 0])], 1)}
front = {"front_points": points[32:48] + [0.1, 0, 0], "front_starts": np.array([0, 16]), "front_closed": np.array([1])}
for inward in (1, -1):
    yarn["frames"][:, :3] *= inward
    yarn["faces"] = faces[:, ::inward]
    sides = sides_of(yarn)
    expect([name for name, _, _ in sides] == [", upper side", ", lower side"], "a yarn has two sides")
    for sign, (_, nodes, seen) in zip((1, -1), sides):
        expect(np.array_equal(nodes, sign * points[:, 2] > 0), "nodes above or below")
        high = points[np.concatenate([yarn["faces"][:, [0, 1, 2]], yarn["faces"][:, [0, 2, 3]]], 1).reshape(-1, 3)].mean(1)[:, 2]
        expect(np.array_equal(seen[np.abs(high) > 0.05], sign * high[np.abs(high) > 0.05] > 0), "triangles above or below")
        lines = lines_of(front, plan_of(points), points, nodes)
        expect(np.ptp(np.concatenate(lines)[:, 1]) > 1.9 and sum(map(len, lines)) in (8, 9), "half of it on each side")
expect([len(side[1]) for side in sides_of({**yarn, "points": points * [1, 1, 0] + [0, 0, 1], "frames":
                                           np.tile(np.eye(3)[[2, 0, 1]].ravel(), (80, 1))})] == [80], "a level interface has one")


def compare(out, *results, plot=draw):
    return plot("plot_family", "--out", out, *results)


both = folder()
results = []
for size in ("0.003", "0.0015"):
    results.append(os.path.join(both, "h" + size))
    code, _, error = delam("run", write(brittle()), "--set", "geometry.h=" + size, "--out", results[-1])
    expect(code == 0, f"a result to compare {error}")
code, error = compare(os.path.join(both, "family"), *results, plot=as_script)
expect(code == 0, f"plot_family.py {error.strip()[-300:]}")
expect(sorted(os.listdir(os.path.join(both, "family"))) == ["energies.png", "load-displacement.png"] and
       all(read(os.path.join(both, "family", name)).startswith(b"\x89PNG") for name in PICTURES[:2]), "two pictures")
other = os.path.join(both, "other")
code, _, error = delam("run", write(SCENE), "--set", "time.steps=10", "--set", "title=other", "--out", other)
expect(code == 0 and compare(both, *results, other)[0] == 0, "results that differ in several ways")
feet = os.path.join(both, "feet")
delam("run", write(changed("[time]", '[units]\nlength = "ft"\n[time]')), "--out", feet)
code, error = compare(both, results[0], feet)
expect(code == 2 and "different units" in error, "different units are refused")
code, error = compare(both, results[0], folder())
expect(code == 2 and "holds no result" in error, "so is a folder without a result")
# What the legend and the title say.
from plot_family import Curves  # noqa: E402
from _pictures.result import Result  # noqa: E402
curves = Curves([Result(path) for path in results])
expect(curves.labels == ["h = 0.003", "h = 0.0015"], f"the legend: {curves.labels}")
expect("20 steps" in curves.title("x") and "local solution, converged mixity" in curves.title("x") and
       "h =" not in curves.title("x"), f"the title: {curves.title('x')!r}")
curves = Curves([Result(path) for path in (*results, other)])
expect(len(set(curves.labels)) == 3 and "other, 10 steps, h = 0.0015" in curves.labels, f"the legend: {curves.labels}")
code, error = as_script("plot", folder())
expect(code == 2 and "holds no result" in error, "an empty folder is refused")
finish()
