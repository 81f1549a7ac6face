# SPDX-License-Identifier: BSD-3-Clause
"""No worker of the BLAS lives beside a small analysis, with no variable set: it would spin. The program, a host in C and
one in Python have one thread when they write their results."""
import fcntl
import os
import subprocess
import sys
import time

from support import DELAM, expect, finish, folder

UNSET = {key: value for key, value in os.environ.items() if not key.startswith(("OPENBLAS", "OMP_", "GOTO"))}
BIN, EXAMPLES = os.path.dirname(DELAM), os.environ["DELAM_EXAMPLES"]
UNSET["DELAM_LIBRARY"] = os.path.join(os.path.dirname(BIN), "lib", "libdelam.so")
UNSET["PYTHONPATH"] = os.path.join(os.path.dirname(EXAMPLES), "bindings", "python", "src")
# NumPy alone, whose BLAS starts its workers and keeps them: what the others are told apart from.
NUMPY = [sys.executable, "-c", "import numpy; print(numpy.ones(3).sum())"]
PROGRAMS = {"the program": [DELAM, "run", os.path.join(EXAMPLES, "enf", "enf.toml"), "--set", "output.fields=[]", "--out",
                            os.path.join(folder(), "out")],
            "a host in C": [os.path.join(BIN, "enf")],
            "a host in Python": [sys.executable, os.path.join(EXAMPLES, "enf", "enf.py")]}


def full_pipe():
    """Its two ends; who writes to it waits."""
    reading, writing = os.pipe()
    fcntl.fcntl(writing, fcntl.F_SETFL, os.O_NONBLOCK)
    try:
        while True:
            os.write(writing, b"\n" * 4096)
    except BlockingIOError:
        fcntl.fcntl(writing, fcntl.F_SETFL, 0)
    return reading, writing


def wait_for_output(process):
    """Returns once the process has slept for a tenth of a second without processor time, or has ended."""
    before, still = None, 0
    while still < 10 and process.poll() is None:
        with open(f"/proc/{process.pid}/stat") as file:
            state, *values = file.read().rpartition(")")[2].split()
        now = state, values[10], values[11]
        still = still + 1 if now == before and state == "S" else 0
        before = now
        time.sleep(0.01)


def threads(words):
    """Number of threads of a program while it waits to write its first results; None: it has written nothing."""
    reading, writing = full_pipe()
    process = subprocess.Popen(words, env=UNSET, stdout=writing, stderr=subprocess.DEVNULL)
    os.close(writing)
    wait_for_output(process)
    count = len(os.listdir(f"/proc/{process.pid}/task")) if process.poll() is None else None
    with open(reading, "rb") as file:
        written = file.read().strip()
    expect(process.wait() == 0, f"{words[0]} ends with {process.returncode}")
    return count if written else None


if (threads(NUMPY) or 1) < 2:
    sys.exit(77)  # one processor, or a BLAS without threads of its own
for name, words in PROGRAMS.items():
    count = threads(words)
    expect(count == 1, f"{name}: {count} threads when it writes its results, expected one")
finish()
