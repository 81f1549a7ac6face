# SPDX-License-Identifier: BSD-3-Clause
"""No thread of the BLAS spins beside a small analysis, with no variable set: the program, a host in C and one in Python
take the processor time that they take with one thread. Times of other programs do not enter."""
import os
import resource
import subprocess
import sys

from support import DELAM, expect, finish, folder

UNSET = {key: value for key, value in os.environ.items() if not key.startswith(("OPENBLAS", "OMP_", "GOTO"))}
BIN, EXAMPLES = os.path.dirname(DELAM), os.environ["DELAM_EXAMPLES"]
UNSET["DELAM_LIBRARY"] = os.path.join(os.path.dirname(BIN), "lib", "libdelam.so")
UNSET["PYTHONPATH"] = os.path.join(os.path.dirname(EXAMPLES), "bindings", "python", "src")
ONE = dict(UNSET, OPENBLAS_NUM_THREADS="1")
PROGRAMS = {"the program": [DELAM, "run", os.path.join(EXAMPLES, "enf", "enf.toml"), "--set", "output.fields=[]", "--out"],
            "a host in C": [os.path.join(BIN, "enf")],
            "a host in Python": [sys.executable, os.path.join(EXAMPLES, "enf", "enf.py")]}


def processor_time(words, environment):
    """Of the quickest of five runs, in seconds."""
    times = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([*words, os.path.join(folder(), "out")], env=environment, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


if len(os.sched_getaffinity(0)) < 2:
    sys.exit(77)
for name, words in PROGRAMS.items():
    unset, one = processor_time(words, UNSET), processor_time(words, ONE)
    expect(unset < 1.3 * one, f"{name}: {1e3 * unset:.0f} ms of processors, with one thread {1e3 * one:.0f} ms")
finish()
