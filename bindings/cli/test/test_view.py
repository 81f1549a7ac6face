# SPDX-License-Identifier: BSD-3-Clause
"""`delam view` without a browser: the page holds the template and the result, its arrays are the numbers of fields.h5
and history.csv, what cannot be shown is said with file and reason."""
import base64
import contextlib
import csv
import json
import os
import re
import resource
import shutil
import stat
import subprocess
import zlib

import h5py
import numpy as np

from support import DELAM, changed, delam, expect, expect_error, finish, folder, read, start, write

TEMPLATE = "<title><!--delam:title--></title><!--delam:data--><p>the rest of the template</p>"


def template(text=TEMPLATE):
    path = os.path.join(folder(), "template.html")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


class Page:
    """What a page holds, unpacked."""

    def __init__(self, path):
        self.text = read(path).decode()
        start = self.text.index('id="delam-data">') + len('id="delam-data">')
        self.data = json.loads(self.text[start:self.text.index("</script>", start)])

    def array(self, about, components=1):
        packed = re.search(f'id="{about["id"]}">([^<]*)<', self.text).group(1)
        raw = np.frombuffer(zlib.decompress(base64.b64decode(packed)), np.uint8)
        values = raw.reshape(4, -1).T.copy().view({"float32": np.float32, "int32": np.int32}[about["type"]])[:, 0]
        expect(len(values) == about["count"], f"{about['id']}: {len(values)} values")
        return values.reshape(components, -1).T if components > 1 else values

    def polygons(self, about):
        offsets, nodes = self.array(about["offsets"]), self.array(about["nodes"])
        return [nodes[a:b] for a, b in zip(offsets, offsets[1:])]


def viewed(scene, *words):
    out = folder()
    code, _, error = delam("run", write(scene), "--out", out)
    expect(code == 0, f"run: {error.strip()[-200:]}")
    code, said, error = delam("view", out, "--template", template(), *words)
    expect(code == 0 and "view.html: " in said, f"view: {said.strip()} {error.strip()}")
    return out


def near(values, exact, bits):
    """As close as so many significant bits are of what single precision leaves."""
    exact = np.asarray(exact)
    least = 2.0 ** -bits + 2.0 ** -24
    return values.shape == exact.shape and np.all(np.abs(values - exact) <= np.abs(exact) * least + 1e-37)


def area_of(polygon, points):
    at = points[polygon]
    return np.linalg.norm(sum(np.cross(a - at[0], b - at[0]) for a, b in zip(at[1:], at[2:]))) / 2


def owners_of(points, faces, exact, cells):
    """The cell of each face: of those with its body's side of the interface, the one that has all its points."""
    rounded = [tuple(at) for at in np.round(exact, 7)]
    having = {}
    for cell, nodes in enumerate(cells):
        for node in nodes[nodes >= 0]:
            having.setdefault(rounded[node], set()).add(cell)
    out = []
    for face in faces:
        of = set.intersection(*(having[tuple(at)] for at in np.round(points[face].astype(float), 7)))
        expect(len(of) == 1, f"a face has {len(of)} cells") if len(of) != 1 else None
        out.append(min(of))
    return np.array(out)


def compare(out, what, area, interface_area):
    """Everything in the page with the files that it was made of. area: of what is seen of the bodies, each face."""
    page = Page(os.path.join(out, "view.html"))
    expect("the rest of the template" in page.text and "<!--delam" not in page.text, f"{what}: the template is filled")
    mesh = page.data["mesh"]
    points = page.array(mesh["points"], 3)
    with h5py.File(os.path.join(out, "fields.h5"), "r") as file:
        # A node is found by its body, as it has twins across the interface: by those of the interface and the rest.
        exact = file["mesh/points"][()]
        group = file["interfaces/interface_0"]
        sides = [page.array(mesh["interfaces"][0][side]) for side in "ab"]
        for side, name in zip(sides, ("nodes_a", "nodes_b")):
            expect(near(points[side], exact[group[name][()]], 24), f"{what}: {name} lie where they are")
        faces = page.polygons(mesh)
        expect(abs(sum(area_of(f, points) for f in faces) / area - 1) < 1e-6,
               f"{what}: faces have the area {sum(area_of(f, points) for f in faces):.6g}, expected {area:.6g}")
        across = page.polygons(mesh["interfaces"][0])
        if interface_area:
            seen = sum(area_of(f, points[sides[1]]) for f in across)
            expect(abs(seen / interface_area - 1) < 1e-6, f"{what}: the interface has the area {seen:.6g}")
        else:
            seen = sum(np.linalg.norm(np.diff(points[sides[1]][f], axis=0), axis=1).sum() for f in across)
            expect(abs(seen / 0.12 - 1) < 1e-6, f"{what}: the interface has the length {seen:.6g}")
        # The body of a face is that of the points around it.
        middle = np.array([points[f].mean(0) for f in faces])[:, mesh["dimension"] - 1]
        expect(np.array_equal(page.array(mesh["body"]), (middle > 0.003).astype(int)), f"{what}: bodies of the faces")
        owners = owners_of(points, faces, exact, file["mesh/cells"][()])
        names = sorted(file["steps"])
        expect([s["step"] for s in page.data["steps"]] == [int(file["steps"][n].attrs["step"]) for n in names],
               f"{what}: all {len(names)} steps are there")
        for step, name in zip(page.data["steps"], names):
            of = file["steps"][name]
            compare_step(page, step, of, group, sides, owners, f"{what}, step {step['step']}")
    compare_history(page, out, what)


def compare_step(page, step, of, group, sides, owners, what):
    u = page.array(step["displacement"], 3)
    exact = of["displacement"][()]
    good = all(near(u[side], exact[group[name][()]], 16) for side, name in zip(sides, ("nodes_a", "nodes_b")))
    # Tied nodes of pairs at mid-side nodes may move by more than any node of a cell.
    cells = of.file["mesh/cells"][()]
    largest = np.linalg.norm(exact[np.unique(cells[cells >= 0])], axis=1).max()
    expect(good and abs(np.linalg.norm(u, axis=1).max() - largest) <= 2e-5 * largest + 1e-37, f"{what}: displacements")
    expect(near(page.array(step["adhesion"][0]), of["interface_0/zeta"][()], 16), f"{what}: adhesion")
    if "stress" in step:
        # Every face has the stress of the cell whose it is: the one that has all its points.
        seen, cells = page.array(step["stress"], 6), of["stress"][()]
        expect(near(seen, cells[owners], 12), f"{what}: stresses")


def compare_history(page, out, what):
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    columns = {c["name"]: c["values"] for c in page.data["history"]}
    expect(set(columns) == set(rows[0]) - {"solution", "mixity_rule"}, f"{what}: all columns of numbers are there")
    wrong = [name for name, values in columns.items()
             if any(float(row[name]) != (np.inf if value is None else value) for row, value in zip(rows, values, strict=True))]
    expect(not wrong, f"{what}: history.csv to the last digit {wrong}")


coarse = changed("h = 0.0015", "h = 0.003")
coarse = changed("steps = 20", "steps = 4", coarse)
solid = changed("dimension = 2", "dimension = 3\nwidth = 0.006", coarse)
solid = changed("point = [0.0, 0.0]", "box = { lower = [0, 0, 0], upper = [0, 0.006, 0] }", solid)
solid = changed("point = [0.120, 0.0]\nfix = [\"x\", \"y\"]",
                "box = { lower = [0.12, 0, 0], upper = [0.12, 0.006, 0] }\nfix = [\"x\", \"z\"]", solid)
solid = changed('fix = ["y"]', 'fix = ["y", "z"]', solid)
solid = changed("point = [0.060, 0.006]\ndirection = [0.0, -1.0]",
                "box = { lower = [0.06, 0, 0.006], upper = [0.06, 0.006, 0.006] }\ndirection = [0, 0, -1]", solid)
PLANE = 0.12 * 0.006
# Of both beams: above or below, and all sides; the faces between them are those of the interface.
SKIN = 2 * 0.12 * 0.006 + 4 * 0.12 * 0.003 + 4 * 0.006 * 0.003

out = viewed(coarse)
compare(out, "quadrilaterals", PLANE, None)
compare(viewed(changed("dimension = 2", 'dimension = 2\ncell = "tri6"', coarse)), "triangles of 6 nodes", PLANE, None)
compare(viewed(solid), "bricks", SKIN, 0.12 * 0.006)
compare(viewed(changed("dimension = 3", 'dimension = 3\ncell = "tet10"', solid)), "tetrahedra of 10 nodes", SKIN, 0.12 * 0.006)

# What the scene says is text, wherever it comes.
page = Page(os.path.join(viewed(changed("small ENF", "a </script><b> & <!--delam:data-->", coarse)), "view.html"))
expect(page.data["about"]["scene"]["title"] == "a </script><b> & <!--delam:data-->" and
       "<title>a &lt;/script&gt;&lt;b&gt; &amp; &lt;!--delam:data--&gt;</title>" in page.text, "a title like a page's end")

# Only adhesion, every second step and the last.
thin = viewed(coarse + '[output]\nfields = ["zeta"]\n', "--every", "3")
page = Page(os.path.join(thin, "view.html"))
expect([s["step"] for s in page.data["steps"]] == [0, 3, 4] and page.data["every"] == 3, "--every 3: steps 0, 3 and 4")
expect(all("displacement" not in s and "stress" not in s and s["adhesion"][0] for s in page.data["steps"]), "only adhesion")

# Where the page goes, and the same bytes twice.
other = os.path.join(folder(), "page.html")
words = ("view", out, "--template", template())
expect(delam(*words, "--out", other)[0] == 0 and read(other) == read(os.path.join(out, "view.html")), "--out: the same page")
expect_error(delam(*words, "--out", other), 2, "page.html is there already: --replace")
expect(delam(*words, "--out", other, "--replace")[0] == 0 and delam(*words)[0] == 0, "--replace, and view.html anew")
expect_error(delam(*words, "--out", os.path.join(out, "none", "page.html")), 3, "none/page.html.new: No such file")
pipe = os.path.join(folder(), "pipe")
os.mkfifo(pipe)
for place in (pipe, os.path.dirname(pipe)):
    expect_error(delam(*words, "--out", place, "--replace"), 2, "this cannot be replaced, as it is no regular file")
expect(stat.S_ISFIFO(os.stat(pipe).st_mode), "the pipe stays")
before = read(other)
answer = start(*words, "--out", other, "--replace",
               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
expect_error(answer, 3, "cannot write .*page.html.new: File too large")
expect(read(other) == before and os.listdir(os.path.dirname(other)) == ["page.html"], "no room: the earlier page stays")

# An unfinished result is shown with what it has.
cut = os.path.join(folder(), "cut")
shutil.copytree(out, cut)
about = json.loads(read(os.path.join(cut, "result.json")))
about.update(status="incomplete", reason="interrupted", steps_done=2)
del about["files"]  # their hashes
about["not_converged"] = [step for step in about["not_converged"] if step <= 2]
with open(os.path.join(cut, "result.json"), "w", encoding="utf-8") as file:
    json.dump(about, file)
lines = read(os.path.join(cut, "history.csv")).decode().splitlines(True)
with open(os.path.join(cut, "history.csv"), "w", encoding="utf-8") as file:
    file.writelines(lines[:4])
with contextlib.suppress(FileNotFoundError):
    os.remove(os.path.join(cut, "jumps.csv"))
with h5py.File(os.path.join(cut, "fields.h5"), "r+") as file:
    for name in [name for name in file["steps"] if int(name) > 2]:
        del file["steps"][name]
expect(delam("view", cut, "--template", template())[0] == 0 and
       Page(os.path.join(cut, "view.html")).data["about"]["status"] == "incomplete", "an interrupted run")

# What is wrong.
expect_error(delam("view", os.path.join(out, "nowhere")), 2, "nowhere: there is no such folder")
expect_error(delam("view", other), 2, "page.html: it is no folder")
expect_error(delam("view", folder()), 2, "result.json: there is no such file, so this folder holds no result")
expect_error(delam(*words[:2], "--template", other), 2, "page.html: this is no template of the page")
expect_error(delam(*words[:2], "--template", out), 2, "cannot be read: it is a folder")
# The program looks for its template from its own folder.
alone = shutil.copy(DELAM, folder())
done = subprocess.run([alone, "view", out], capture_output=True, text=True, check=False)
expect_error((done.returncode, done.stdout, done.stderr), 2, "view.html: there is no template .*bindings/cli/view/view.html.*--template FILE")
code, _, error = delam("view", out, "--every", "0", "--template", template())
expect(code == 2 and "--every" in error, f"--every 0: {error.strip()[:80]}")


def broken(what, *patterns):
    """A copy of the result with which `what` does something."""
    path = os.path.join(folder(), "broken")
    shutil.copytree(out, path)
    result = json.loads(read(os.path.join(path, "result.json")))
    del result["files"]  # their hashes would show each of these
    with open(os.path.join(path, "result.json"), "w", encoding="utf-8") as file:
        json.dump(result, file)
    what(path)
    before = os.path.exists(os.path.join(path, "view.html"))
    expect_error(delam("view", path, "--template", template()), 2, *patterns)
    expect(before == os.path.exists(os.path.join(path, "view.html")), "an earlier page stays")


def put(name, text):
    def write_it(path):
        with open(os.path.join(path, name), "w", encoding="utf-8") as file:
            file.write(text)
    return write_it


def change(action):
    def change_it(path):
        with h5py.File(os.path.join(path, "fields.h5"), "r+") as file:
            action(file)
    return change_it


def other_points(file):
    del file["mesh/points"]
    file["mesh/points"] = np.zeros((3, 3))


def other_hash(file):
    file.attrs["scene_hash"] = np.bytes_("0123456789abcdef")


def no_steps(file):
    del file["steps"]
    file.create_group("steps")


def short_field(file):
    group = file["steps/00000001"]
    del group["displacement"]
    group["displacement"] = np.zeros((2, 3))


broken(put("result.json", "{}"), "result.json: this is no result")
broken(put("history.csv", "step,time\n"), "history.csv: it has no rows")
broken(put("history.csv", "step,time\n0,0\n1\n"), "history.csv: row 2 has 1 columns")
broken(put("fields.h5", "no HDF5"), "fields.h5: it cannot be read")
broken(lambda path: os.remove(os.path.join(path, "fields.h5")), "fields.h5: cannot be read: No such file")
broken(change(other_points), r"fields.h5: mesh/cells names \d+, and there are 3")
broken(change(other_hash), "fields.h5: it belongs to the scene 0123456789abcdef")
broken(change(no_steps), "fields.h5: it has the fields of no step")
broken(change(short_field), r"steps/00000001/displacement has 6 values, and not \d+")
broken(change(lambda file: file.pop("interfaces/interface_0/faces")), "fields.h5: .*faces cannot be read")

finish()
