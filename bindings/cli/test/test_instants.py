# SPDX-License-Identifier: BSD-3-Clause
"""The steps whose fields are written: all that are asked for, or at most twenty where something happens."""
import json
import os
import signal
import subprocess

import h5py
from support import DELAM, brittle, changed, delam, expect, expect_error, finish, folder, read, write


def steps_of(out):
    with h5py.File(os.path.join(out, "fields.h5")) as file:
        return [int(name) for name in sorted(file["steps"])]


def rows_of(out):
    lines = read(os.path.join(out, "history.csv")).decode().splitlines()
    titles = lines[0].split(",")
    return [dict(zip(titles, line.split(","))) for line in lines[1:]]


def numbers(rows, title):
    return [float(row[title]) for row in rows]


def run(text, *words):
    out = folder()
    code, said, error = delam("run", write(text), "--out", out, *words)
    expect(code == 0, f"a run {error.strip()}")
    return out, said


# A ductile interface: one peak, no jump.
STEPS = 100
steady = changed("steps = 20", f"steps = {STEPS}")
out, _ = run(steady)
rows, chosen = rows_of(out), steps_of(out)
eighths = {part * STEPS // 8 for part in range(9)}
dissipated, reaction = numbers(rows, "dissipated"), numbers(rows, "reaction")
first = next(k for k in range(STEPS) if dissipated[k] > 0)
falls = [k for k in range(1, STEPS) if reaction[k - 1] < reaction[k] > reaction[k + 1]]
expect(set(chosen) >= eighths | {first}, f"eighths of the analysis and the first damage, {first}: {chosen}")
expect(set(falls[:1]) <= set(chosen), f"the first peak, {falls[:1]}")
expect(len(chosen) <= 20, f"{len(chosen)} instants")
with h5py.File(os.path.join(out, "fields.h5")) as file:
    estimated = [int(name) for name in sorted(file["steps"]) if "mesh_error" in file["steps"][name].attrs]
expect(set(estimated) == {first, STEPS // 2, STEPS}, f"the error of the mesh is estimated three times: {estimated}")

# A jump, with the state before it.
out, _ = run(changed("steps = 20", f"steps = {STEPS}", brittle()))
jumps = [k for k, row in enumerate(rows_of(out)) if float(row["jumps"]) > 0]
chosen = steps_of(out)
expect(jumps and {jumps[0] - 1, jumps[0]} <= set(chosen) and len(chosen) <= 20, f"before and after {jumps}: {chosen}")

# Loaded and unloaded more often than there is room for: the largest peaks stay, each a turning point.
CYCLES = 30
times = [2.0 * k / (2 * CYCLES) for k in range(2 * CYCLES + 1)]
height = [0.0 if k % 2 == 0 else 0.006 * (0.1 + 0.9 * ((7 * k) % (2 * CYCLES)) / (2 * CYCLES)) for k in range(2 * CYCLES + 1)]
cyclic = changed("times = [0.0, 2.0]\nvalues = [0.0, 0.006]", f"times = {times}\nvalues = {height}",
                 changed("steps = 20", f"steps = {4 * CYCLES}"))
out, _ = run(cyclic)
rows, chosen = rows_of(out), steps_of(out)
reaction, dissipated = numbers(rows, "reaction"), numbers(rows, "dissipated")
peaks = {k for k in range(1, 4 * CYCLES) if reaction[k - 1] < reaction[k] > reaction[k + 1]}
expect(len(peaks) > 20 and len(chosen) == 20, f"{len(peaks)} peaks, {len(chosen)} instants")
heavier = {k for k in range(1, 4 * CYCLES) if dissipated[k] > 0 == dissipated[k - 1]}
for k, row in enumerate(rows):
    if float(row["jumps"]) > 0:
        heavier |= {k - 1, k}
eighths = {part * 4 * CYCLES // 8 for part in range(9)}
kept = set(chosen) - eighths - heavier
left = peaks - eighths - heavier - kept
expect(heavier <= set(chosen), f"the first damage, before and after the jump: {sorted(heavier)}")
expect(kept and kept <= peaks, f"besides them, peaks: {sorted(kept)}")
expect(min(reaction[k] for k in kept) > max(reaction[k] for k in left), "the largest")
whole = out

# A resumed run chooses the same, wherever it was stopped: with state and fields, bit for bit.
for stop in (21, 64, 110):
    out = folder()
    scene = os.path.join(out, "scene.toml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(cyclic)
    result = folder()
    with subprocess.Popen([DELAM, "run", scene, "--out", result], stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            if line.startswith(f"step {stop}/"):
                process.send_signal(signal.SIGKILL)
                break
        process.communicate()
    expect(delam("run", scene, "--out", result, "--resume")[0] == 0, f"killed after step {stop} and resumed")
    expect(all(read(os.path.join(result, name)) == read(os.path.join(whole, name))
               for name in ("history.csv", "fields.h5", "fields.xdmf", "state.bin")), "to the same files")

# Snapshots of the scene take the place of the eighths; `every` is as asked.
out, _ = run(steady + "[output]\nsnapshots = [0.5]\n")
chosen = steps_of(out)
expect({0, 25, STEPS, first} <= set(chosen) and 50 not in chosen, f"one snapshot: {chosen}")
out, _ = run(changed("steps = 20", "steps = 20\n[output]\nevery = 1"))
expect(steps_of(out) == list(range(21)), "every step")

# The history alone.
bare, said = run(steady + "[output]\nfields = []\n")
expect(sorted(os.listdir(bare)) == ["history.csv", "jumps.csv", "result.json", "state.bin"] or
       sorted(os.listdir(bare)) == ["history.csv", "result.json", "state.bin"], f"no fields: {sorted(os.listdir(bare))}")
expect("fields.h5" not in said, "nor does it say so")
out, _ = run(steady)
expect(read(os.path.join(bare, "history.csv")) == read(os.path.join(out, "history.csv")), "the history is the same")
expect_error(delam("view", bare), 2, "writes no fields")
again, _ = run(steady)
code, _, _ = delam("run", write(steady), "--out", again, "--set", "output.fields=[]")
expect(code == 0 and "fields.h5" not in os.listdir(again), "fields of an earlier result do not stay")
expect(json.loads(read(os.path.join(again, "result.json")))["output"]["fields"] == [], "result.json says it")

# Small arrays are as they are in memory, large ones packed.
with h5py.File(os.path.join(out, "fields.h5")) as file:
    expect(file["mesh/points"].compression is None, "a small array is not packed")
fine, _ = run(changed("h = 0.0015", "h = 0.00015", changed("steps = 20", "steps = 1")))
with h5py.File(os.path.join(fine, "fields.h5")) as file:
    data = file["steps/00000001/stress"]
    expect(data.nbytes > 2**20 and data.compression == "gzip" and data.id.get_storage_size() < data.nbytes,
           f"{data.nbytes} bytes take {data.id.get_storage_size()}")
finish()
