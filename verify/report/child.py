# SPDX-License-Identifier: BSD-3-Clause
"""Processes that end with the one that started them, whatever ends that one, and take along what they have started."""
from __future__ import annotations

import os
import signal
import subprocess
import threading

FOLLOWS = "DELAM_REPORT_FOLLOWS"


def start(command: list[str], env: dict | None = None, **more) -> subprocess.Popen:
    """Starts a program that calls follow(), in a process group of its own. Nobody writes into its input: the pipe
    closes when this process ends, also by a signal that cannot be caught."""
    env = {**(os.environ if env is None else env), FOLLOWS: "1"}
    return subprocess.Popen(command, env=env, stdin=subprocess.PIPE, start_new_session=True, **more)


def follow() -> None:
    """Ends this process and its group when the one that started it has gone. Programs that it runs find no input."""
    if os.environ.pop(FOLLOWS, None) is None:
        return
    parent = os.dup(0)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)

    def wait() -> None:
        os.read(parent, 1)
        os.killpg(0, signal.SIGKILL)

    threading.Thread(target=wait, daemon=True).start()


def end(child: subprocess.Popen) -> None:
    """Ends the child and whatever it has started."""
    kill(child.pid)
    child.wait()
    child.stdin.close()


def kill(group: int) -> None:
    try:
        os.killpg(group, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass
