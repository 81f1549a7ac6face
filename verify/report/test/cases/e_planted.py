# SPDX-License-Identifier: BSD-3-Clause
"""Cases that go wrong in every way that a case can, beside one that is right."""
import copy
import os
import signal
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

import planted
from case import Case, Failed, Rows, Skip, ledger_of

KEYS = ("reference", "tables", "orders", "ledger", "plots", "figures", "checks", "warnings", "losses", "refused")


def answer(spoil):
    def run(context):
        data = planted.sound()
        result = copy.deepcopy({key: data[key] for key in KEYS})
        if spoil is not loss:
            result["plots"] = []  # drawing is slow; one picture is enough
        spoil(result)
        return result
    return run


def crash(context):
    os.kill(os.getpid(), signal.SIGSEGV)


def leave(context):
    print("the last words", flush=True)
    os._exit(3)


def hang(context):
    time.sleep(600)


def fail(context):
    raise Failed("the mesh was refused")


def skip(context):
    raise Skip("no Fortran compiler")


def error(context):
    return {}["nothing"]


def column(context):
    return Rows({"table": "t", "columns": ["a"], "rows": [[1.0]]}).column("b")


def nan(result):
    result["tables"][0]["rows"][1][1] = float("nan")


def hole(result):
    result["tables"][0]["rows"][1][1] = None


def short(result):
    del result["tables"][0]["rows"][1][1]


def unknown(result):
    result["reference"] = {"kind": "", "source": "", "uncertainty": ""}


def nothing(result):
    result["checks"], result["orders"] = [], []


def sign(result):
    result["checks"][0]["value"] = abs(-2.0 / 2.0 - 1.0)


def factor(result):
    result["checks"][0]["value"] = abs(4.0 / 2.0 - 1.0)


def converged(result):
    result["tables"][0]["rows"][-1][4] = 2


def refused(result):
    result["checks"], result["orders"], result["refused"] = [], [], "poisson must be below 0.5"


def loss(result):
    result["losses"] = ["twice as slow as <b>the baseline</b>"]
    names = "stored_bulk", "stored_interface", "dissipated", "work", "lower", "increment", "upper", "increment_lower"
    ends = dict.fromkeys(names, [0.0, 1.0])
    result["ledger"] = ledger_of({"one step": ends}, "J/m")


ALL = {"right": answer(loss), "crash": crash, "leave": leave, "hang": hang, "fail": fail, "skip": skip, "error": error, "column": column, "nan": answer(nan),
       "hole": answer(hole), "short": answer(short), "unknown": answer(unknown), "nothing": answer(nothing), "sign": answer(sign), "factor": answer(factor),
       "converged": answer(converged), "refused": answer(refused), "none": lambda context: None}


def cases():
    return [Case(id=f"t-{name}", chapter="e", title=f"Planted: {name}", requirement="The end moves by F L / (E A).", geometry="1 m", materials="E = 1 Pa",
                 supports="one end held", units="SI", run=run, quick=name != "right", timing=name == "nothing", seconds=2.0 if name == "hang" else 60.0,
                 expected=1.0) for name, run in ALL.items()]
