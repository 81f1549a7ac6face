# SPDX-License-Identifier: BSD-3-Clause
"""Shared by the tests of many processes: starting delam and delam-mpi under a time limit, and expectations."""
import atexit
import contextlib
import ctypes
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from environment import ENVIRONMENT

DELAM = os.environ["DELAM"]
DELAM_MPI = os.environ["DELAM_MPI"]
EXAMPLES = os.environ["DELAM_EXAMPLES"]
SKIPPED = 77
failures = []

if shutil.which("mpirun") is None:
    print("mpirun is not there")
    sys.exit(SKIPPED)

# Writes its process number for the test, then becomes the program. WRAP, if there is one, is done first.
WRAPPER = """#!/bin/sh
DELAM_RANK=${OMPI_COMM_WORLD_RANK:-${PMI_RANK:-0}}
echo $$ > "$DELAM_PIDS/$DELAM_RANK.new" && mv "$DELAM_PIDS/$DELAM_RANK.new" "$DELAM_PIDS/$DELAM_RANK"
eval "$DELAM_WRAP"
LD_PRELOAD="$DELAM_PRELOAD" exec "$@"
"""


def folder():
    """A new folder, which goes with this process."""
    path = tempfile.mkdtemp(prefix="delam_ranks_")
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    return path


HERE = folder()
with open(os.path.join(HERE, "rank.sh"), "w", encoding="utf-8") as script:
    script.write(WRAPPER)
os.chmod(script.name, 0o755)


def with_parent():
    """mpirun, and with it the ranks, ends if the test is killed."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def alive(pid):
    """Running, or waiting to be: not what has ended and only its parent has not noticed."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            return file.read().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


class Ranks:
    """delam-mpi, or another program, on a number of ranks; `said` is what it writes, both streams. Ends with
    the block, ranks included."""

    def __init__(self, count, *words, wrap="", preload="", program=DELAM_MPI):
        self.count = count
        self.pids = folder()
        self.said_path = os.path.join(self.pids, "said")
        environment = dict(ENVIRONMENT, DELAM_PIDS=self.pids, DELAM_WRAP=wrap, DELAM_PRELOAD=preload)
        with open(self.said_path, "wb") as said:
            self.process = subprocess.Popen(
                ["mpirun", "-n", str(count), os.path.join(HERE, "rank.sh"), program, *words], env=environment,
                stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT, start_new_session=True,
                preexec_fn=with_parent)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for pid in [*self.running(), self.process.pid]:
            with contextlib.suppress(ProcessLookupError):
                if pid != self.process.pid or self.process.poll() is None:
                    os.kill(pid, signal.SIGKILL)
        self.process.wait()

    @property
    def said(self):
        with open(self.said_path, encoding="utf-8", errors="replace") as file:
            return file.read()

    def pid(self, rank):
        """Returns the process id of a rank; None while it has not begun."""
        path = os.path.join(self.pids, str(rank))
        if not os.path.exists(path):
            return None
        with open(path, encoding="utf-8") as file:
            return int(file.read())

    def running(self):
        return [pid for pid in map(self.pid, range(self.count)) if pid is not None and alive(pid)]

    def wait(self, limit):
        """Exit code of mpirun, None where it or a rank still runs after the time limit (s)."""
        until = time.monotonic() + limit
        while time.monotonic() < until:
            if self.process.poll() is not None and not self.running():
                return self.process.returncode
            time.sleep(0.02)
        return None


def on_ranks(count, *words, limit=200, **options):
    """Exit code (None: hangs) and what was said."""
    with Ranks(count, *words, **options) as ranks:
        return ranks.wait(limit), ranks.said


def alone(*words, limit=200):
    """The serial program: exit code and what it said."""
    done = subprocess.run([DELAM, *words], env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=limit, check=False)
    return done.returncode, done.stdout


def expect(condition, what):
    print(("ok    " if condition else "FAIL  ") + what, flush=True)
    if not condition:
        failures.append(what)


def last_lines(said):
    """Returns the last lines of the program or, if it said nothing, of mpirun."""
    lines = [line.strip() for line in said.replace("\r", "\n").splitlines() if line.strip(" -\n")]
    own = [line for line in lines if re.search(r"delam|error|^(run|solve|step)", line)]
    return " | ".join(own[-3:] or lines[-3:])[-500:]


def finish():
    if failures:
        print(f"{len(failures)} failed:\n  " + "\n  ".join(failures))
    sys.exit(1 if failures else 0)
