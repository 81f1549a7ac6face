# SPDX-License-Identifier: BSD-3-Clause
"""What the studies share: analyses of `delam run` with settings of their own, and how parameters are written."""
import fcntl
import json
import os
import re
import shlex
import signal
import subprocess
import sys
import threading
import types

import numpy as np

import command
from _pictures.input_file import LAST_WORDS, MOST_RESULT, Unreadable, quoted, read_columns, read_end, read_json
from command import DONE, INTERRUPTED, NOT_CONVERGED, NUMERICAL, OUTPUT, WRONG, Trouble

__all__ = ["DONE", "INTERRUPTED", "NOT_CONVERGED", "NUMERICAL", "OUTPUT", "WRONG", "Check", "Trouble", "analyse", "end_all",
           "given_words", "hold", "last_words", "make_folder", "number_in", "path_of", "read_about", "read_history",
           "refuse_set", "run_study", "setting", "value_at", "warnings_of"]

# Numbers whose squares, and sums and quotients of those, are still numbers with all digits.
LEAST, MOST = 1e-150, 1e150


def given_words():
    """What the command line was given, as the program hands it over: names as of its options."""
    if len(sys.argv) != 2:
        raise Trouble("this script is run by the program: delam sweep, delam fit")
    given = types.SimpleNamespace(**json.loads(sys.argv[1]))
    for k, word in enumerate(given.set):
        key, sign, value = word.partition("=")
        given.set[k] = path_of(key) + sign + value
    return given


def program():
    """The command line that runs a scene: the one that has called the study."""
    return os.environ.get("DELAM", "delam")


def path_of(key):
    """laws.0.normal_toughness as the program writes it, laws[0].normal_toughness."""
    path = re.sub(r"\.(\d+)(?=\.|$)", r"[\1]", key)
    if not re.fullmatch(r"[A-Za-z_][\w-]*(\[\d+\])*(\.[A-Za-z_][\w-]*(\[\d+\])*)*", path):
        raise Trouble(f"{quoted(key)} is no key of a scene: laws.0.normal_toughness, for example")
    return path


def setting(path, value):
    return f"{path}={value!r}" if isinstance(value, float) else f"{path}={value}"


def number_in(text, where):
    """A finite number that is written out; `where` begins the message if it is none."""
    try:
        value = float(text)
    except ValueError:
        raise Trouble(f"{where}: {quoted(text)} is no number") from None
    if not np.isfinite(value) or (value != 0 and not LEAST <= abs(value) <= MOST):
        raise Trouble(f"{where}: {quoted(text)}: 0, or a number from {LEAST:g} to {MOST:g}, is expected")
    return value


def value_at(scene, path):
    """The number at a path of a scene that is read already; None: it is not given."""
    at = scene
    for key in re.findall(r"[^.\[\]]+", path):
        try:
            at = at[int(key)] if isinstance(at, list) else at[key]
        except (KeyError, IndexError, ValueError, TypeError):
            return None
    if isinstance(at, bool) or not isinstance(at, (int, float)):
        return None
    return number_in(repr(at), path)


class Worker:
    """A process that runs analyses, one after another (`delam serve`)."""

    def __init__(self):
        self.child = subprocess.Popen([program(), "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                      env=dict(os.environ, OPENBLAS_NUM_THREADS="1"))
        self.lives = True

    def exit_code(self, job):
        """The exit code of an analysis; below 0: a signal has ended it."""
        try:
            self.child.stdin.write(json.dumps(job) + "\n")
            self.child.stdin.flush()
            answer = self.child.stdout.readline()
        except BrokenPipeError:
            answer = ""
        self.lives = answer != ""
        return int(answer) if self.lives else self.child.wait() or NUMERICAL


busy, idle = [], []  # workers
lock = threading.Lock()


def end_all():
    """Every analysis keeps its finished steps."""
    with lock:
        for worker in busy + idle:
            worker.child.send_signal(signal.SIGTERM)


def run_study(main):
    """Ends the program with the exit code of main(), or with one line for what went wrong."""
    command.run(main, end_all)


def hold(folder):
    """Keeps other studies out of a folder, as long as the file that it returns is open."""
    make_folder(folder)
    path = os.path.join(folder, "study.lock")
    try:
        number = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC | os.O_NONBLOCK, 0o666)
    except OSError as error:
        raise Trouble(f"cannot write {path}: {error.strerror}", OUTPUT) from error
    file = os.fdopen(number, "a", encoding="utf-8")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        raise Trouble(f"{folder}: another study is writing there", OUTPUT) from error
    return file


def refuse_set(paths, settings, option):
    """A key is either varied or set."""
    for word in settings:
        if word.partition("=")[0] in paths:
            raise Trouble(f"--set {word}: {option} has the same key")


LOG_BEGINS = "delam "  # also of those that older versions have written


def refuse_foreign_log(path):
    """Refuses what is no log of an analysis, where one is written or removed."""
    if not os.path.lexists(path):
        return
    if os.path.islink(path) or not os.path.isfile(path):
        raise Trouble(f"cannot write {path}: it is a link, or no regular file: move it away", OUTPUT)
    if path.endswith(".log"):
        with open(path, encoding="utf-8", errors="replace") as log:
            begins = log.read(len(LOG_BEGINS))
        if begins not in (LOG_BEGINS, ""):
            raise Trouble(f"cannot write {path}: it is no log of delam run: move it away", OUTPUT)


def analyse(scene, out, settings, resume=False):
    """The exit code of `delam run`, whose words go to OUT.log beside the folder of the result."""
    words = shlex.join(["run", scene, "--out", out] + [word for one in settings for word in ("--set", one)])
    refuse_foreign_log(out + ".log")
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW | os.O_CLOEXEC
    with os.fdopen(os.open(out + ".log", flags, 0o666), "w", encoding="utf-8") as log:
        log.write(LOG_BEGINS + words + "\n")
    with lock:
        worker = idle.pop() if idle else Worker()
        busy.append(worker)
    code = worker.exit_code({"scene": scene, "set": settings, "out": out, "resume": resume, "log": out + ".log",
                             "command": f"{program()} {words}"})
    with lock:
        busy.remove(worker)
        if worker.lives:
            idle.append(worker)
    return code


class Check:
    """What `delam check` says of a scene with settings: `errors`, and what it found; nothing if it does not get that far."""

    def __init__(self, scene, settings):
        words = [word for one in settings for word in ("--set", one)]
        done = subprocess.run([program(), "check", scene, "--json", "--no-plan", *words], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, check=False)
        try:
            self.found = json.loads(done.stdout)
        except ValueError:
            self.found = {}
        self.errors = self.found.get("errors", [])

    @property
    def words(self):
        """The first error, as `delam check` prints it."""
        error = self.errors[0]
        line = f"{error['file']}:{error['line']}" if error["line"] else error["file"]
        return ": ".join(text for text in (line, error["key"], error["message"]) if text)


def last_words(out):
    """The last message of an analysis, or what else its log ends with: the system speaks where the program cannot."""
    text = read_end(out + ".log", LAST_WORDS).decode("utf-8", "surrogateescape")
    lines = [line for line in text.split("\n") if line.strip() and not line.startswith(LOG_BEGINS)]
    said = [line for line in lines if line.startswith("delam: ")] or lines
    return said[-1] if said else f"the analysis ended without a message ({out}.log)"


def warnings_of(out):
    """The warnings of a result: of its scene, and its closing lines. Those of single steps are in the log alone."""
    about = read_about(out)
    closing = [line.removeprefix("warning: ") for line in about.get("closing", []) if line.startswith("warning: ")]
    return [*about.get("warnings", []), *closing]


def read_history(out):
    """Columns of a result by name; words are left out."""
    path = os.path.join(out, "history.csv")
    columns = {name: np.array(column) for name, column in read_columns(path).items() if not isinstance(column, list)}
    if not columns or not next(iter(columns.values())).size:
        raise Unreadable(f"{path}: there are no rows of numbers")
    return columns


def read_about(out):
    return read_json(os.path.join(out, "result.json"), MOST_RESULT)


def make_folder(path):
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise Trouble(f"cannot write {path}: {error.strerror}", OUTPUT) from error
