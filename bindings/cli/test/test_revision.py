# SPDX-License-Identifier: BSD-3-Clause
"""Steps that backtracking replaces: rows and fields are those of the steps as they stand in the end."""
import json
import os
import signal
import subprocess

import h5py
from support import DELAM, brittle, changed, delam, expect, finish, folder, read, write

FRONT = changed("steps = 20", 'steps = 20\n[output]\ncolumns = ["front"]', brittle())
scene = write(FRONT)
on = ("--set", "solver.backtracking=on")


def table(out):
    lines = read(os.path.join(out, "history.csv")).decode().splitlines()
    titles = lines[0].split(",")
    numbers = [t for t in titles if t not in ("solution", "mixity_rule")]
    return [{t: float(v) for t, v in zip(titles, line.split(",")) if t in numbers} for line in lines[1:]]


whole = folder()
code, shown, error = delam("run", scene, "--out", whole, *on)
expect(code == 0, f"an analysis that returns {error}")
rows = table(whole)
returning = [int(row["step"]) for row in rows if row["backtracks"] > 0]
replaced = [int(row["step"]) for row in rows if row["revisions"] > 0]
expect(returning and replaced and min(replaced) < max(returning), f"steps {returning} return, {replaced} are replaced")
expect([row["step"] for row in rows] == list(range(21)), "each step has one row, in order")
expect(all(a["dissipated"] <= b["dissipated"] for a, b in zip(rows, rows[1:])), "nothing heals from row to row")
every = folder()
expect(delam("run", scene, "--out", every, *on, "--set", "output.every=1")[0] == 0, "with the fields of every step")
with h5py.File(os.path.join(every, "fields.h5")) as file:
    weights = file["interfaces/interface_0/weights"][()]
    zeta = [file["steps"][name]["interface_0/zeta"][()] for name in sorted(file["steps"])]
    fronts = [float((weights * (zeta[0] - z)).sum()) for z in zeta]
    expect(len(zeta) == 21 and all(abs(f - row["front"]) < 1e-12 for f, row in zip(fronts, rows)),
           "fields and rows are of the same steps")
off = folder()
delam("run", scene, "--out", off)
before = table(off)
expect(any(a["front"] != b["front"] for a, b in zip(before, rows)), "without backtracking they are others")
about = json.loads(read(os.path.join(whole, "result.json")))
expect(about["concept"]["backtracking"] == "on" and about["estimate_violated"] == [],
       "the estimate is met in every step")

# Interrupted before and after the return; the steps to go back to are part of the state.
for number in (signal.SIGINT, signal.SIGKILL):
    for step in (max(1, min(returning) - 1), min(returning), min(returning) + 1):
        out = folder()
        with subprocess.Popen([DELAM, "run", scene, "--out", out, *on], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as process:
            for line in process.stdout:
                if line.startswith(f"step {step}/"):
                    process.send_signal(number)
                    break
            process.communicate()
        code, _, error = delam("run", scene, "--out", out, *on, "--resume")
        expect(code == 0 and all(read(os.path.join(out, name)) == read(os.path.join(whole, name))
                                 for name in ("history.csv", "fields.h5", "state.bin")),
               f"signal {number.value} after step {step}: resumed to the same history and fields {error.strip()}")
finish()
