# SPDX-License-Identifier: BSD-3-Clause
"""`delam view` of damaged results: every member of result.json, every column of history.csv, every data set and attribute
of fields.h5 is damaged in turn: missing, of another type, negative, huge, no number, cut, exchanged. None is accepted but
those in HARMLESS, which the page does not show: it stays the same, byte for byte."""
import csv
import io
import json
import os
import resource
import shutil

import h5py
import numpy as np

from support import changed, delam, expect, finish, folder, read, start, write

TEMPLATE = os.path.join(folder(), "template.html")
with open(TEMPLATE, "w", encoding="utf-8") as page:
    page.write("<title><!--delam:title--></title><!--delam:data-->")
WHOLE = os.path.join(folder(), "whole")
code, _, error = delam("run", write(changed("steps = 20", "steps = 3", changed("h = 0.0015", "h = 0.003"))), "--out", WHOLE)
expect(code == 0, f"a result: {error}")
code, _, error = delam("view", WHOLE, "--template", TEMPLATE)
expect(code == 0, f"a page: {error}")
PAGE = read(os.path.join(WHOLE, "view.html"))
# The hashes of the files would show every damage. What follows is about results without them.
for name in ("history.csv", "fields.h5"):
    out = os.path.join(folder(), "result")
    shutil.copytree(WHOLE, out)
    with open(os.path.join(out, name), "r+b") as file:
        file.seek(100)
        byte = file.read(1)
        file.seek(100)
        file.write(bytes([byte[0] ^ 1]))
    code, _, error = delam("view", out, "--template", TEMPLATE)
    expect(code == 2 and f"{name}: missing, or not as the run has written it" in error, f"a bit of {name}: {error.strip()}")
with open(os.path.join(WHOLE, "result.json"), encoding="utf-8") as file:
    about = json.load(file)
del about["files"]
with open(os.path.join(WHOLE, "result.json"), "w", encoding="utf-8") as file:
    json.dump(about, file, indent=2)

# Of result.json: what is not shown. Of fields.h5: what ParaView and plot.py show.
SHOWN_MEMBERS = {"program", "version", "commit", "status", "reason", "concept", "steps_done", "steps", "not_converged", "closing",
                 "scene_hash", "layers", "patterns", "cell", "units", "ended", "scene.title", "scene.file", "scene.dimension",
                 "scene.shortest_edge", "output.displacement_scale", "output.fields", "units.length", "units.force", "units.time",
                 "concept.solution", "concept.mixity_rule", "scene", "output"}
SHOWN_ITEMS = ("mesh/points", "mesh/cells", "mesh/body", "nodes_a", "nodes_b", "faces", "steps/00000001/displacement",
               "steps/00000001/stress", "zeta")
SHOWN_ATTRIBUTES = ("body_0", "body_1", "body_a", "body_b", "name", "step", "time", "scene_hash", "dimension")
FILES = ("result.json", "history.csv", "fields.h5")
accepted, harmless, refused = [], [], 0


def try_out(name, damage, shown, file):
    """shown: the page has it, so that the damage must be refused with the name of the file."""
    global refused
    out = os.path.join(folder(), "result")
    shutil.copytree(WHOLE, out)
    os.remove(os.path.join(out, "view.html"))
    damage(os.path.join(out, file))
    code, _, error = delam("view", out, "--template", TEMPLATE)
    shutil.rmtree(out) if code else None
    # What other files contradict is refused with the name of either.
    if code == 2 and any(f"{name}: " in error for name in FILES) and error.count("\n") == 1:
        refused += 1
    elif code == 0 and not shown and read(os.path.join(out, "view.html")) == PAGE:
        harmless.append(name)
    else:
        accepted.append((name, code, error[-200:]))


# ---- result.json


def members(about):
    for key, value in about.items():
        yield key, key in SHOWN_MEMBERS
        if isinstance(value, dict) and key in ("scene", "output", "units", "concept"):
            for inner in value:
                # Results of earlier versions have names of units, and no scales.
                if f"{key}.{inner}" != "units.scales":
                    yield f"{key}.{inner}", f"{key}.{inner}" in SHOWN_MEMBERS


def with_member(name, change):
    def damage(path):
        with open(path, encoding="utf-8") as file:
            about = json.load(file)
        at, *rest = name.split(".")
        within = about[at] if rest else about
        change(within, rest[0] if rest else at)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(about, file)
    return damage


def put(value):
    def change(within, key):
        within[key] = value
    return change


ABOUT = json.loads(read(os.path.join(WHOLE, "result.json")))
WRONG = {"missing": lambda within, key: within.pop(key), "a list": put([[1]]), "an object": put({"a": [1]}), "a number": put(-1),
         "huge": put(1e300), "half": put(0.5), "true": put(True), "no number": put(float("nan"))}
for member, is_shown in members(ABOUT):
    for what, how in WRONG.items():
        # A periodic cell, and another scale of the picture: what a run may have written.
        if (member, what) in (("cell", "an object"), ("output.displacement_scale", "half")):
            continue
        try_out(f"result.json: {member}: {what}", with_member(member, how), is_shown, "result.json")
for member, values in {"status": ["done"], "steps": [2, 4, "3"], "steps_done": [2, 4], "not_converged": [[9], [-1], [2, 1], ["1"]],
                       "closing": [["a", 1]], "layers": [[], ["lower"], ["upper", "lower"], ["lower", "upper", "more"]],
                       "patterns": [[{}], [{"name": "press"}], [{"name": "press", "drives": "x"}], [1]], "scene_hash": ["", "0" * 16],
                       "scene.dimension": [3, 1, 2.0], "scene.shortest_edge": [0, "1"], "output.displacement_scale": [0],
                       "concept.solution": ["energetic"], "output.fields": [["displacement", 1]], "cell": ["x", 3]}.items():
    for value in values:
        try_out(f"result.json: {member} = {value}", with_member(member, put(value)), True, "result.json")


def bytes_of(file, change):
    def damage(path):
        with open(path, "rb") as old:
            text = old.read()
        with open(path, "wb") as new:
            new.write(change(text))
    return damage


for share in (0.0, 0.1, 0.5, 0.9, 0.999):
    for file in ("result.json", "history.csv", "fields.h5"):
        try_out(f"{file}: cut at {share}", bytes_of(file, lambda text: text[:int(share * len(text))]), True, file)
for text in (b"[" * 100000, b'{"program": "delam", "x": ' + b"[" * 40 + b"]" * 40 + b"}", b"null", b"\xff\xfe", b'{"program": "delam"}'):
    try_out(f"result.json: {text[:30]!r}", bytes_of("result.json", lambda _: text), True, "result.json")

# ---- history.csv

with open(os.path.join(WHOLE, "history.csv"), newline="", encoding="utf-8") as history:
    TITLES, *ROWS = csv.reader(history)
COUNTS = {"step", "am_iterations", "linear_iterations", "contact_pairs", "backtracks", "debonded_length", "revisions",
          "search_candidates", "jumps", "crack_length", "process_zone_pairs"}
NEEDED = {"step", "time", "load", "reaction", "stored_bulk", "stored_interface", "dissipated", "work", "solution", "mixity_rule"}


def with_rows(change):
    def damage(path):
        titles, rows = list(TITLES), [list(row) for row in ROWS]
        text = io.StringIO()
        changed_rows = change(titles, rows) or rows
        csv.writer(text, lineterminator="\n").writerows([titles, *changed_rows])
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.getvalue())
    return damage


def cell(k, value):
    def change(_, rows):
        rows[2][k] = value
    return with_rows(change)


def without(k):
    def change(titles, rows):
        for row in (titles, *rows):
            del row[k]
    return with_rows(change)


def twice(k):
    def change(titles, rows):
        for row in (titles, *rows):
            row.append(row[k])
    return with_rows(change)


for k, title in enumerate(TITLES):
    values = ["", "x", "nan", "1e999", "1.5.2", "0x10", "1e300", " 1", "\x1b[31m"]
    values += ["inf"] if title not in ("search_gap", "search_margin") else []
    values += ["-1"] if title in COUNTS else []
    for value in values:
        if title in ("solution", "mixity_rule") or value not in ():
            try_out(f"history.csv: {title} = {value!r}", cell(k, value), True, "history.csv")
    try_out(f"history.csv: {title} twice", twice(k), True, "history.csv")
    if title in NEEDED:
        try_out(f"history.csv: no {title}", without(k), True, "history.csv")
for what, how in {"a row less": lambda titles, rows: rows[:-1], "a row more": lambda titles, rows: rows + [rows[-1]],
                  "rows exchanged": lambda titles, rows: [rows[0], rows[2], rows[1], rows[3]], "a row twice":
                  lambda titles, rows: [rows[0], rows[1], rows[1], rows[3]], "a longer row": lambda titles, rows:
                  [*rows[:3], [*rows[3], "1"]], "a shorter row": lambda titles, rows: [*rows[:3], rows[3][:-1]]}.items():
    try_out(f"history.csv: {what}", with_rows(how), True, "history.csv")


# ---- fields.h5


def with_file(change):
    def damage(path):
        with h5py.File(path, "r+") as file:
            change(file)
    return damage


def replaced(item, value):
    def change(file):
        del file[item]
        if value is not None:
            file[item] = value
    return with_file(change)


def element(item, value):
    def change(file):
        data = file[item][()]
        data[(-1,) * data.ndim] = value
        file[item][...] = data
    return with_file(change)


def claims(item):
    def change(file):
        kind = file[item].dtype
        shape = file[item].shape
        del file[item]
        file.create_dataset(item, (1 << 40, *shape[1:]), kind, chunks=True)
    return with_file(change)


def linked(item):
    def change(file):
        del file[item]
        file[item] = h5py.ExternalLink("/dev/zero", "/x")
    return with_file(change)


def outside(item):
    def change(file):
        kind, shape = file[item].dtype, file[item].shape
        del file[item]
        file.create_dataset(item, shape, kind, external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])
    return with_file(change)


def attribute(item, name, value):
    def change(file):
        del file[item].attrs[name]
        if value is not None:
            file[item].attrs[name] = value
    return with_file(change)


with h5py.File(os.path.join(WHOLE, "fields.h5"), "r") as file:
    found = []
    file.visititems(lambda name, item: found.append((name, item[()] if isinstance(item, h5py.Dataset) else None, dict(item.attrs))))
    found.append(("/", None, dict(file.attrs)))
for item, data, attributes in found:
    if item.startswith("steps/") and not item.startswith("steps/00000001"):
        continue
    if data is not None:
        is_shown = item.endswith(SHOWN_ITEMS) and not (item.endswith("points") and item != "mesh/points")
        is_shown = is_shown and not (item.endswith("displacement") and "interface" in item)
        whole = data.dtype.kind == "i"
        damages = {"missing": replaced(item, None), "other numbers": replaced(item, data.astype("f8" if whole else "i8")),
                   "a text": replaced(item, np.bytes_("x")), "one more row": replaced(item, np.concatenate([data, data[-1:]])),
                   "one row less": replaced(item, data[:-1]), "another shape": replaced(item, data.reshape(1, *data.shape)),
                   "empty": replaced(item, data[:0]), "single": replaced(item, data.astype("i2" if whole else "f4"))}
        values = [-2, 2 ** 40 if data.dtype.itemsize == 8 else 2 ** 30] if whole else [np.nan, np.inf, 1e300]
        values += [-0.1, 1.1] if item.endswith("zeta") else []
        damages.update({f"{value}": element(item, value) for value in values})
        if item.endswith(("cells", "faces")):
            damages["a node twice"] = replaced(item, np.repeat(data[:, :1], data.shape[1], 1)) if item.endswith("cells") else (
                replaced(item, data[:, :1]))
        for what, how in damages.items():
            try_out(f"fields.h5: {item}: {what}", how, is_shown, "fields.h5")
        for what, how in (("claims more", claims(item)), ("a link", linked(item)), ("elsewhere", outside(item))):
            try_out(f"fields.h5: {item}: {what}", how, is_shown or what == "a link", "fields.h5")
    for name in attributes:
        text = isinstance(attributes[name], bytes)
        is_shown = name in SHOWN_ATTRIBUTES
        for value in (None, "", 7) if text else (None, "x", np.nan, -7, 1e300, [1, 2], 0.5):
            try_out(f"fields.h5: {item}: {name} = {value}", attribute(item, name, value), is_shown, "fields.h5")
# Which steps have fields is the choice of the scene, so that one less is another result.
for item in ("mesh", "interfaces", "interfaces/interface_0", "steps", "steps/00000001/interface_0"):
    try_out(f"fields.h5: no {item}", replaced(item, None), True, "fields.h5")


def exchange(one, other):
    def change(file):
        file.move(one, "kept")
        file.move(other, one)
        file.move("kept", other)
    return with_file(change)


for one, other in (("steps/00000001", "steps/00000002"), ("mesh/points", "steps/00000001/displacement"),
                   ("interfaces/interface_0/nodes_a", "interfaces/interface_0/nodes_b"), ("mesh/cells", "mesh/points"),
                   ("interfaces/interface_0/faces", "mesh/cells"), ("steps/00000001/stress", "steps/00000001/displacement")):
    try_out(f"fields.h5: {one} and {other} exchanged", exchange(one, other), True, "fields.h5")

print(f"{refused} damages refused, {len(harmless)} without effect on the page, {len(accepted)} accepted")
for name in harmless:
    print("without effect:", name)
expect(refused > 500 and not accepted, "no damage is accepted: " + "; ".join(map(str, accepted[:20])))


# ---- few files


def few(number):
    return lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (number, number))


said = set()
for number in range(4, 16):
    code, _, error = start("view", WHOLE, "--template", TEMPLATE, preexec_fn=few(number))
    if code != 0 and "shared libraries" not in error:
        said.add("too many open files: raise the limit with ulimit -n" in error)
expect(said == {True}, f"a limit of open files has a message of its own: {said}")
finish()
