# SPDX-License-Identifier: BSD-3-Clause
"""Interrupted at any time and resumed, a run gives the history of an uninterrupted one bit for bit."""
import json
import os
import signal
import subprocess

import h5py
from support import DELAM, brittle, changed, delam, expect, expect_error, finish, folder, read, write

# One step violates the two-sided estimate, before the last interruption: the list must survive that.
text = changed("steps = 20", "steps = 60\n[solver]\nbacktracking_tolerance = 1e-9", brittle())
scene = write(text)
whole = folder()
expect(delam("run", scene, "--out", whole)[0] == 0, "uninterrupted")
history = read(os.path.join(whole, "history.csv"))
violated = json.loads(read(os.path.join(whole, "result.json")))["estimate_violated"]


def stop_after(step, number, out, *words):
    """Sends a signal when the line of a step is seen; exit code and last step seen."""
    with subprocess.Popen([DELAM, "run", scene, "--out", out, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True) as process:
        sent = False
        for line in process.stdout:
            if line.startswith("step ") and int(line.split()[1].split("/")[0]) >= step and not sent:
                process.send_signal(number)
                sent = True
        error = process.stderr.read()
    return process.returncode, error


for number, name in ((signal.SIGINT, "Ctrl-C"), (signal.SIGTERM, "SIGTERM")):
    out = folder()
    code, error = stop_after(5, number, out)
    expect(code == 130 and "--resume" in error, f"{name}: exit {code}, says how to go on")
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
    code, shown, _ = delam("run", scene, "--out", out, "--resume")
    expect(code == 0 and "resumed after step" in shown, f"{name}: resumed")
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
code, shown, _ = delam("run", scene, "--out", out, "--resume")
expect(code == 0 and read(os.path.join(out, "history.csv")) == history, "resumed after a kill")

out = folder()
stop_after(5, signal.SIGINT, out)
other = write(changed("young = 75e9", "young = 76e9", text))
expect_error(delam("run", other, "--out", out, "--resume"), 2, "the scene, with its --set, is not the one")
comment = write("# a comment\n" + text)
expect(delam("run", comment, "--out", out, "--resume")[0] == 0, "a comment is no change")
code, shown, _ = delam("run", scene, "--out", out, "--resume")
expect(code == 0 and "complete already" in shown, "nothing is left to do")
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
