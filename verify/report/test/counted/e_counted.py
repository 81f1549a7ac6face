# SPDX-License-Identifier: BSD-3-Clause
"""Cases that write down that they ran; one of them waits, so that a test can interrupt the report there."""
import copy
import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

import planted
from case import Case

KEYS = ("reference", "tables", "orders", "ledger", "plots", "figures", "checks", "warnings", "losses", "refused")


def note(context, text):
    with open(context.out / "ran.txt", "a", encoding="utf-8") as file:
        file.write(text + "\n")


def answer(context, name):
    note(context, name)
    data = planted.sound()
    result = copy.deepcopy({key: data[key] for key in KEYS})
    result["plots"] = []
    return result


def right(name):
    return lambda context: answer(context, name)


def wrong(context):
    result = answer(context, "wrong")
    result["checks"][0]["value"] = 2.0
    return result


def nothing(context):
    note(context, "nothing")
    return {}["nothing"]


def table(name, which):
    def run(context):
        context.harness(which)
        return answer(context, name)
    return run


def wait(context):
    """Waits, with a program of its own, for as long as the test wants."""
    if (context.out / "wait").is_file():
        program = subprocess.Popen(["sleep", "600"])
        note(context, f"waits {os.getpid()} {program.pid}")
        while (context.out / "wait").is_file():
            time.sleep(0.02)
    return answer(context, "wait")


# In the order in which they run, one after the other.
ALL = {"right": right("right"), "wrong": wrong, "nothing": nothing, "first": table("first", "shared"), "wait": wait,
       "second": table("second", "shared"), "last": right("last")}


def cases():
    words = {"requirement": "The end moves by F L / (E A).", "geometry": "1 m", "materials": "E = 1 Pa",
             "supports": "one end held", "units": "SI"}
    return [Case(id=f"t-{name}", chapter="e", title=f"Planted: {name}", **words, run=run, quick=name != "last",
                 timing=name == "last", seconds=60.0, expected=1.0) for name, run in ALL.items()]
