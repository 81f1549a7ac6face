# SPDX-License-Identifier: BSD-3-Clause
"""The closing lines of a run and jumps.csv: what people read, what result.json has of it, after interruptions too. The lines
themselves are tested in test_closing_lines.cpp."""
import csv
import io
import json
import os
import re
import signal
import subprocess

from support import DELAM, brittle, changed, delam, expect, finish, folder, read, write

COLUMNS = "step,before,time,stored,dissipated,released,debonded,interface,first_pair,last_pair"
LOADS = ",load,reaction_before,reaction_after"


def about_of(out):
    return json.loads(read(os.path.join(out, "result.json")))


def table(out, name):
    return list(csv.DictReader(io.StringIO(read(os.path.join(out, name)).decode())))


def closing(text):
    """The lines of a run after those of its steps, but for the last, which names the files."""
    lines = text.splitlines()
    last = max(i for i, line in enumerate(lines) if re.match(r"step \d+/", line))
    return lines[last + 1:-1]


# A short notch: the crack jumps several times. Two patterns, the second one for the names of the columns.
jumping = changed("steps = 20", "steps = 20\n[solver]\njump_tolerance = 1e-3\n[output]\nevery = 100\nsnapshots = [2.0]",
                  brittle())
scene, out = write(jumping), folder()
code, text, error = delam("run", scene, "--out", out)
about, jumps, rows = about_of(out), table(out, "jumps.csv"), table(out, "history.csv")
expect(code == 0 and len(jumps) > 0, f"an analysis with {len(jumps)} jumps {error}")
expect(read(os.path.join(out, "jumps.csv")).decode().splitlines()[0] == COLUMNS + LOADS + ",name", "columns of jumps.csv")
expect(all(abs(float(j["load"]) - 0.003 * float(j["time"])) < 1e-16 for j in jumps), "load: the factor at the instant")
expect(all(j["name"] == "lower-upper" for j in jumps), "name of the interface")
lines = closing(text)
expect(lines == about["closing"], "result.json has the closing lines")
told = [line for line in lines if re.match("jump (at|between) ", line)]


def four_digits(value):
    return f"{value:.0f}" if 1e3 <= abs(value) < 1e7 else f"{value:.4g}"


def fall_of(jump):
    before, after = float(jump["reaction_before"]), float(jump["reaction_after"])
    return f", reaction {four_digits(before)} to {four_digits(after)}" if abs(after - before) > 0.02 * abs(before) else ""


def instant_of(jump):
    before, time = float(jump["before"]), float(jump["time"])
    if time - before > 3e-3 * time:
        return f"between time {before:.6g} and {time:.6g} (load {0.003 * before:.6g} to {0.003 * time:.6g})"
    return f"at time {time:.6g} (load {0.003 * time:.6g})"


wanted = [f'jump {instant_of(j)}: interface "lower-upper" debonded by '
          f'{float(j["debonded"]):.3g}, {float(j["released"]):.3g} released{fall_of(j)}' for j in jumps]
expect(fall_of(jumps[0]) and float(jumps[0]["reaction_after"]) < float(rows[int(jumps[0]["step"]) - 1]["reaction"]) <=
       float(jumps[0]["reaction_before"]), "reactions of the first jump: the load grows until then")
expect(told == wanted if len(jumps) <= 10 else set(told) < set(wanted), f"a line for each jump: {told}")
found = about["jumps"]
expect(found["count"] == len(jumps) and len(found["largest"]) == len(told) and
       abs(found["released"] - sum(float(j["released"]) for j in jumps)) < 1e-12 and
       found["largest"][0]["loads"] == {"press": float(jumps[0]["load"])}, "jumps in result.json")
expect("history.csv, jumps.csv, fields.h5" in text, "the last line names the file")

# The ledger, from the rows.
start, end = rows[0], rows[-1]
total = [sum(float(r[k]) for k in ("stored_bulk", "stored_interface", "dissipated")) - float(r["work"]) for r in rows]
released = [sum(float(r["released"]) for r in rows[:i + 1]) for i in range(len(rows))]
off = max((abs(t - total[0] + r) for t, r in zip(total, released)))
balance = about["energy_balance"]
expect(abs(abs(balance["defect"]) - off) < 1e-12 and balance["relative"] == abs(balance["defect"]) / balance["work"] and
       balance["work"] == max(float(r["work"]) for r in rows), f"the balance in result.json: {balance}")
expect(sum("energy balance: off by" in line for line in lines) == 1, "one line tells it")
expect(sum(released) > 0.05 * balance["work"] and balance["relative"] < 0.01 and "warning: energy" not in text,
       "with what is released it is closed")

# Steps that stop early are not minimal: the two-sided estimate tells, and what they do not settle is released.
stopped = write(changed("steps = 20", "steps = 8\n[solver]\nminimisation_limit = 1"))
bad = folder()
code, text, _ = delam("run", stopped, "--out", bad, "--set", "solver.step_control=fixed")
expect(code == 1 and sum(line.startswith("two-sided estimate violated in steps: ") for line in closing(text)) == 1 and
       about_of(bad)["jumps"]["released"] > 0 and about_of(bad)["energy_balance"]["relative"] < 0.01,
       f"an analysis of steps that stop early says so {closing(text)}")

# A mixed mode in coarse steps: frozen, the library warns once, and the closing line has the worst step.
mixed = changed('fix = ["y"]', 'layer = "upper"\nfix = ["y"]', changed("[0.0, 0.0]", "[0.0, 0.003]"))
code, text, _ = delam("run", write(mixed), "--out", bad, "--set", "time.steps=6", "--set", "solver.mixity_rule=frozen")
worst = max(table(bad, "history.csv"), key=lambda r: float(r["mixity_error"]))
error = about_of(bad)["mixity_error"]
expect(code == 0 and text.count("the mode mixity changes on the way") == 1, "a mixity in error is logged once")
expect(error["relative"] == float(worst["mixity_error"]) > 0.01 and error["step"] == int(worst["step"]) and
       sum(f'(step {worst["step"]}, time' in line and "mode mixity" in line for line in closing(text)) == 1,
       f"and closes the run: {error}")

# Where nothing jumps there is no file, or an empty one if jumps are located.
quiet = write(changed("steps = 20", "steps = 2", changed("values = [0.0, 0.006]", "values = [0.0, 0.0006]")))
expect(delam("run", quiet, "--out", out)[0] == 0 and "jumps.csv" not in os.listdir(out),
       "that of an earlier result is removed")
code, text, _ = delam("run", quiet, "--out", out, "--set", "solver.jump_tolerance=1e-3")
expect(read(os.path.join(out, "jumps.csv")).decode() == COLUMNS + LOADS + ",name\n" and
       about_of(out)["jumps"] == {"count": 0, "released": 0, "debonded": 0, "largest": []}, "no jump")
found = closing(text)
expect(len(found) == 2 and found[0].startswith("energy balance: off by ") and
       found[1].startswith("mesh: error of the stored energy about "),
       f"a calm run ends with its balance and the error of its mesh: {found}")
expect(about_of(out)["load_drops"] == {"steps": [], "largest": None} and about_of(out)["mixity_error"]["relative"] == 0,
       "nothing to report in result.json")

# Standard cells of half the thickness of an arm are too stiff, by what incompatible modes would take off.
coarse = write(changed("h = 0.0015", "h = 0.003", changed("steps = 20", "steps = 2", changed("values = [0.0, 0.006]",
                                                                                             "values = [0.0, 0.0006]"))))
loads = {}
for formulation in ("incompatible", "standard"):
    code, text, _ = delam("run", coarse, "--out", out, "--set", f"materials[0].formulation={formulation}")
    error, loads[formulation] = about_of(out)["mesh_error"], float(table(out, "history.csv")[-1]["reaction"])
    lines = [line for line in closing(text) if "mesh: " in line]
    expect(code == 0 and error["step"] in (1, 2) and len(lines) == 1, f"{formulation}: {lines}, {error}")
    if formulation == "incompatible":
        expect(lines[0].startswith("mesh: ") and error["error"] < 0.03 and error["excess"] == 0, "a mesh that bends")
    else:
        expect(lines[0].startswith("warning: mesh: ") and 'formulation = "incompatible" takes off ' in lines[0] and
               0.03 < error["excess"] <= (1 + 1e-9) * (error["error"] + error["fronts"]), "a mesh that does not")
        high = loads["standard"] / loads["incompatible"] - 1
        expect(0.5 * high < error["error"] / (1 - error["error"]) < 2 * high, f"loads are too high by {high}: {error}")

# Interrupted after its first jump: the file has it already, and after --resume it is that of an uninterrupted run.
whole, half = folder(), folder()
many = ("--set", "time.steps=60")
delam("run", scene, "--out", whole, *many)
first = int(table(whole, "jumps.csv")[0]["step"])
with subprocess.Popen([DELAM, "run", scene, "--out", half, *many], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                      text=True) as process:
    for line in process.stdout:
        if line.startswith(f"step {first}/"):
            process.send_signal(signal.SIGINT)
            break
    rest, _ = process.communicate()
part = read(os.path.join(half, "jumps.csv"))
expect(process.returncode == 130 and read(os.path.join(whole, "jumps.csv")).startswith(part) and
       about_of(half)["jumps"]["count"] == len(table(half, "jumps.csv")) >= 1, "interrupted: jumps so far are kept")
expect(about_of(whole)["closing"][0] in rest, "and told")
code, text, _ = delam("run", scene, "--out", half, *many, "--resume")
expect(code == 0 and read(os.path.join(half, "jumps.csv")) == read(os.path.join(whole, "jumps.csv")) and
       closing(text) == about_of(half)["closing"] == about_of(whole)["closing"], "resumed: all jumps, and the same lines")
again = delam("run", scene, "--out", half, *many, "--resume")[1].splitlines()
expect(again[0].endswith("complete already") and again[1:] == about_of(whole)["closing"], "complete already: the same lines")

# An energetic search that compares too few states says so.
code, text, _ = delam("run", scene, "--out", half, "--set", "solver.solution=energetic", "--set", "time.steps=4", "--set",
                      "solver.search_limit=3", "--set", "solver.kinematics=linear")
rows = [{k: float(v) for k, v in row.items() if k not in ("solution", "mixity_rule")} for row in table(half, "history.csv")]
open_steps = [int(r["step"]) for r in rows if r["search_gap"] > 1e-2 * max(abs(r["stored_bulk"] + r["stored_interface"]), r["work"])]
largest = max(rows, key=lambda r: r["search_gap"])
found = about_of(half)["search"]
expect(code == 0 and found["gap_steps"] == open_steps and len(open_steps) > 0 and "warning: search: in " in text and
       found["margin_steps"] == [int(r["step"]) for r in rows if r["search_margin"] < -1e-9 * r["work"]] and
       found["largest_gap"]["gap"] == largest["search_gap"], f"gaps of a search of 3 states: steps {open_steps}")
finish()
