# SPDX-License-Identifier: BSD-3-Clause
"""The plot script makes its pictures, in 2D and 3D, from whole and partial results."""
import os
import subprocess

from support import SCENE, changed, delam, expect, finish, folder, read, write

PICTURES = ("load-displacement.png", "energies.png", "snapshots.png")


def plot(out):
    return subprocess.run(["/usr/bin/python3", os.environ["DELAM_PLOT"], out], capture_output=True, text=True,
                          check=False)


def draws(scene, what):
    out = folder()
    code, _, error = delam("run", write(scene), "--out", out)
    expect(code == 0, f"{what}: run {error}")
    done = plot(out)
    expect(done.returncode == 0, f"{what}: plot.py {done.stderr.strip()[-300:]}")
    expect(all(read(os.path.join(out, name)).startswith(b"\x89PNG") for name in PICTURES if name in os.listdir(out)) and
           set(PICTURES) <= set(os.listdir(out)), f"{what}: three pictures")


draws(SCENE, "2D")
triangles = changed("dimension = 2", 'dimension = 2\ncell = "tri3"')
draws(changed("steps = 20", "steps = 5\n[output]\nsnapshots = [1.0]", triangles),
      "2D, triangles, one snapshot")
solid = changed("dimension = 2", "dimension = 3\nwidth = 0.006", changed("h = 0.0015", "h = 0.003"))
solid = changed("point = [0.0, 0.0]", "box = { lower = [0, 0, 0], upper = [0, 0.006, 0] }", solid)
solid = changed("point = [0.120, 0.0]\nfix = [\"x\", \"y\"]",
                "box = { lower = [0.12, 0, 0], upper = [0.12, 0.006, 0] }\nfix = [\"x\", \"z\"]", solid)
solid = changed('fix = ["y"]', 'fix = ["y", "z"]', solid)
solid = changed("point = [0.060, 0.006]\ndirection = [0.0, -1.0]",
                "box = { lower = [0.06, 0, 0.006], upper = [0.06, 0.006, 0.006] }\ndirection = [0, 0, -1]", solid)
draws(changed("steps = 20", "steps = 4", solid), "3D")
done = plot(folder())
expect(done.returncode == 2 and "holds no result" in done.stderr, "an empty folder is refused")
finish()
