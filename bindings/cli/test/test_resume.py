# SPDX-License-Identifier: BSD-3-Clause
"""Interrupted at any time and resumed, a run gives the history of an uninterrupted one bit for bit."""
import json
import os
import signal
import subprocess
import time

import h5py
from support import DELAM, brittle, changed, delam, expect, expect_error, finish, folder, read, write

# One step violates the two-sided estimate, before the last interruption: the list must survive that.
EVERY = "\n[output]\nevery = 1"
text = changed("steps = 20", "steps = 60\n[solver]\nbacktracking_tolerance = 1e-9" + EVERY, brittle())
scene = write(text)
whole = folder()
expect(delam("run", scene, "--out", whole)[0] == 0, "uninterrupted")
history = read(os.path.join(whole, "history.csv"))
violated = json.loads(read(os.path.join(whole, "result.json")))["estimate_violated"]


shown = []  # lines of the run that was stopped last


def stop_after(step, number, out, *words):
    """Sends a signal when the line of a step is seen; exit code and standard error."""
    shown.clear()
    with subprocess.Popen([DELAM, "run", scene, "--out", out, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True) as process:
        sent = False
        for line in process.stdout:
            shown.append(line)
            if line.startswith("step ") and int(line.split()[1].split("/")[0]) >= step and not sent:
                process.send_signal(number)
                sent = True
        error = process.stderr.read()
    return process.returncode, error


for number, name in ((signal.SIGINT, "Ctrl-C"), (signal.SIGTERM, "SIGTERM")):
    out = folder()
    code, error = stop_after(5, number, out)
    expect(code == 130 and "interrupted" in error and "--resume" in error, f"{name}: exit {code}, says how to go on")
    about = json.loads(read(os.path.join(out, "result.json")))
    part = read(os.path.join(out, "history.csv"))
    expect(about["status"] == "incomplete" and about["reason"] == "interrupted" and 5 <= about["steps_done"] < 60,
           f"{name}: marked incomplete after step {about['steps_done']}")
    expect(history.startswith(part) and len(part.splitlines()) == about["steps_done"] + 2,
           f"{name}: finished steps are kept")
    with h5py.File(os.path.join(out, "fields.h5")) as file:
        expect(len(file["steps"]) == about["steps_done"] + 1, f"{name}: so are their fields")
    # Once more, then to the end.
    code, _ = stop_after(max(about["steps_done"] + 3, 40), number, out, "--resume")
    expect(code == 130, f"{name}: interrupted again")
    code, said, _ = delam("run", scene, "--out", out, "--resume")
    expect(code == 0 and "resumed after step" in said, f"{name}: resumed")
    expect(read(os.path.join(out, "history.csv")) == history, f"{name}: the history is that of an uninterrupted run")
    with h5py.File(os.path.join(out, "fields.h5")) as a, h5py.File(os.path.join(whole, "fields.h5")) as b:
        expect(list(a["steps"]) == list(b["steps"]) and
               all((a["steps"][k]["displacement"][()] == b["steps"][k]["displacement"][()]).all() for k in b["steps"]),
               f"{name}: so are the fields")
    about = json.loads(read(os.path.join(out, "result.json")))
    expect(about["resumed"] == 2, f"{name}: result.json counts")
    expect(violated and about["estimate_violated"] == violated, f"{name}: so is the list of violated estimates")

out = folder()
expect(stop_after(7, signal.SIGKILL, out)[0] == -signal.SIGKILL, "killed")
expect("result.json" not in os.listdir(out), "no result is claimed")
code, _, _ = delam("run", scene, "--out", out, "--resume")
expect(code == 0 and read(os.path.join(out, "history.csv")) == history, "resumed after a kill")

# Killed as soon as one step is done, again and again: each time it gets on by that step.
out = folder()
for kill in range(3):
    stop_after(0, signal.SIGKILL, out, *(["--resume"] if kill > 0 else []))
    begun = [line for line in shown if line.startswith("resumed after step ")]
    expect(kill == 0 or (begun and int(begun[0].split()[-1]) >= kill), f"killed {kill} times: {''.join(begun).strip()}")
expect(delam("run", scene, "--out", out, "--resume")[0] == 0, "then to the end")
expect(read(os.path.join(out, "history.csv")) == history, "which is that of an uninterrupted run")
expect(json.loads(read(os.path.join(out, "result.json")))["resumed"] == 3, "result.json counts the kills")

# Another run of the scene, of a file elsewhere and at another time, writes the same bytes; so does a resumed one.
again, elsewhere = folder(), write(text)
started = json.loads(read(os.path.join(whole, "result.json")))["started"]
time.sleep(1)  # the dates have whole seconds
expect(delam("run", elsewhere, "--out", again)[0] == 0, "run again")
for name in ("history.csv", "state.bin", "fields.h5", "fields.xdmf"):
    expect(read(os.path.join(again, name)) == read(os.path.join(whole, name)), f"the same {name}, later and elsewhere")
    expect(read(os.path.join(out, name)) == read(os.path.join(whole, name)), f"the same {name} after three kills")
expect(json.loads(read(os.path.join(again, "result.json")))["started"] != started, "result.json has the dates")

out = folder()
stop_after(5, signal.SIGINT, out)
other = write(changed("young = 75e9", "young = 76e9", text))
expect_error(delam("run", other, "--out", out, "--resume"), 2, "the scene, with its --set, is not the one")
comment = write("# a comment\n" + text)
expect(delam("run", comment, "--out", out, "--resume")[0] == 0, "a comment is no change")
code, said, _ = delam("run", scene, "--out", out, "--resume")
expect(code == 0 and "complete already" in said, "nothing is left to do")

# States of earlier formats: 2 kept the date and the number of resumes, and no seal covered the first line.
SEAL = 17  # a hash and the end of a line


def fnv(bytes_):
    value = 0xcbf29ce484222325
    for byte in bytes_:
        value = (value ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    return f"{value:016x}"


def earlier(out, format_):
    """Makes the state of a run that was interrupted one of an earlier format."""
    path = os.path.join(out, "running", "state.bin")
    line, _, rest = read(path).partition(b"\n")
    head = json.loads(line)
    expect(head.pop("kind") == "delam state 4", "the format of today")
    expect(rest[-SEAL:-1].decode() == fnv(line + b"\n" + rest[:-SEAL]), "its seal covers all before it")
    del head["history"], head["fields"]
    old = {"kind": f"delam state {format_}", **head, "checksum": fnv(rest[:-SEAL])}
    if format_ == 2:
        old.update(started="2026-01-31T12:00:00Z", resumed=6)
        os.remove(os.path.join(out, "running", "origin.json"))
    os.remove(os.path.join(out, "running", ".delam"))
    with open(path, "wb") as file:
        file.write(json.dumps(old, separators=(",", ":")).encode() + b"\n" + rest[:-SEAL])


for format_ in (2, 3):
    out = folder()
    stop_after(5, signal.SIGINT, out)
    earlier(out, format_)
    code, said, _ = delam("run", scene, "--out", out, "--resume")
    expect(code == 0 and f"of format {format_}, whose first line, history and fields no checksum covers" in said,
           f"resumed from a state of format {format_}, and said so")
    expect(read(os.path.join(out, "history.csv")) == history, "to the same end")
    about = json.loads(read(os.path.join(out, "result.json")))
    expect(format_ == 3 or (about["started"] == "2026-01-31T12:00:00Z" and about["resumed"] == 7), "with its date")

# Killed while steps are revised: the state that is saved counts on what they held before.
for name in ("history.csv", "step_00000002.bin"):
    out = folder()
    stop_after(5, signal.SIGINT, out)
    path = os.path.join(out, "running", name)
    whole_file = read(path)
    with open(path + ".revised", "wb") as file:
        file.write(whole_file[:-30] + b"9" * 30)
    expect(delam("run", scene, "--out", out, "--resume")[0] == 0, f"{name}: what was revised and not saved is dropped")
    expect(read(os.path.join(out, "history.csv")) == history, "and the end is the same")
    out = folder()
    stop_after(5, signal.SIGINT, out)
    path = os.path.join(out, "running", name)
    os.rename(path, path + ".revised")
    with open(path, "wb") as file:
        file.write(whole_file[:-30] + b"9" * 30)
    expect(delam("run", scene, "--out", out, "--resume")[0] == 0, f"{name}: what was revised and saved takes its place")
    expect(read(os.path.join(out, "history.csv")) == history, "and the end is the same")

# Ctrl-C within a step: a person reads that the run was interrupted, and no error of the library.
slow = changed("h = 0.0015", "h = 0.0005", text)
scene, kept = write(slow), scene
code, error = stop_after(1, signal.SIGINT, folder())
expect(code == 130 and error.startswith("delam: interrupted after step"), f"within a step: {error.strip()}")
expect(not any("cancel" in line or "error" in line for line in shown if not line.startswith("mesh: error of the stored energy")),
       f"nothing else is said: {shown[-1].strip()}")
scene = kept
expect_error(delam("run", other, "--out", out, "--resume"), 2, "the scene, with its --set, is not the one")

out = folder()
stop_after(5, signal.SIGINT, out)
state = os.path.join(out, "running", "state.bin")
with open(state, "r+b") as file:
    file.seek(-10, os.SEEK_END)
    file.write(b"x" * 10)
expect_error(delam("run", scene, "--out", out, "--resume"), 2, "state.bin", "damaged")
expect(delam("run", scene, "--out", out)[0] == 0 and read(os.path.join(out, "history.csv")) == history,
       "run starts anew")
finish()
