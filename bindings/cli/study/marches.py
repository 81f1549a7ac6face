# SPDX-License-Identifier: BSD-3-Clause
"""What the studies share: marches of `delam run` with settings of their own, and how parameters are written."""
import csv
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

DONE, NOT_CONVERGED, WRONG, OUTPUT, NUMERICAL, INTERRUPTED = 0, 1, 2, 3, 4, 130


class Trouble(Exception):
    """A message for people, and the exit code of the program."""

    def __init__(self, text, code=WRONG):
        super().__init__(text)
        self.code = code


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
        raise Trouble(f"\"{key}\" is no key of a scene: laws.0.normal_toughness, for example")
    return path


def setting(path, value):
    return f"{path}={value!r}" if isinstance(value, float) else f"{path}={value}"


def value_at(scene, path):
    """The number at a path of a scene that is read already; None: it is not given."""
    at = scene
    for key in re.findall(r"[^.\[\]]+", path):
        try:
            at = at[int(key)] if isinstance(at, list) else at[key]
        except (KeyError, IndexError, ValueError, TypeError):
            return None
    return float(at) if isinstance(at, (int, float)) and not isinstance(at, bool) else None


running = []  # marches that a signal must end
lock = threading.Lock()


def end_all():
    """Every march keeps its finished steps."""
    with lock:
        for child in running:
            child.send_signal(signal.SIGTERM)


def finish(child):
    """The exit code of a march."""
    code = child.wait()
    with lock:
        running.remove(child)
    return code


def run_study(name, main):
    """Ends the program with the exit code of main(), or with one line for what went wrong."""
    try:
        sys.exit(main())
    except Trouble as trouble:
        text, code = trouble, trouble.code
    except OSError as error:
        text, code = error, OUTPUT
    except KeyboardInterrupt:
        end_all()
        text, code = "interrupted", INTERRUPTED
    print(f"delam: {name}: {text}", file=sys.stderr)
    sys.exit(code)


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
    """Refuses what is no log of a march, where one is written or removed."""
    if not os.path.lexists(path):
        return
    if os.path.islink(path) or not os.path.isfile(path):
        raise Trouble(f"cannot write {path}: it is a link, or no regular file: move it away", OUTPUT)
    if path.endswith(".log"):
        with open(path, encoding="utf-8", errors="replace") as log:
            begins = log.read(len(LOG_BEGINS))
        if begins not in (LOG_BEGINS, ""):
            raise Trouble(f"cannot write {path}: it is no log of delam run: move it away", OUTPUT)


def start(scene, out, settings, resume=False, one_thread=True):
    """A running `delam run`; its words go to OUT.log beside the folder of the result."""
    command = [program(), "run", scene, "--out", out] + [word for one in settings for word in ("--set", one)]
    environment = dict(os.environ, **({"OPENBLAS_NUM_THREADS": "1"} if one_thread else {}))
    refuse_foreign_log(out + ".log")
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW | os.O_CLOEXEC
    with os.fdopen(os.open(out + ".log", flags, 0o666), "w", encoding="utf-8") as log:
        log.write(LOG_BEGINS + shlex.join(command[1:]) + "\n")
        log.flush()
        with lock:
            running.append(subprocess.Popen(command + (["--resume"] if resume else []), stdout=log,
                                            stderr=subprocess.STDOUT, env=environment))
            return running[-1]


class Check:
    """What `delam check` says of a scene with settings: `errors`, and what it found; nothing if it does not get that far."""

    def __init__(self, scene, settings):
        words = [word for one in settings for word in ("--set", one)]
        done = subprocess.run([program(), "check", scene, "--json", *words], stdout=subprocess.PIPE,
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
    """The last message of a march."""
    with open(out + ".log", encoding="utf-8", errors="replace") as log:
        lines = [line for line in log.read().splitlines() if line.startswith("delam: ")]
    return lines[-1] if lines else "no message"


def read_history(out):
    """Columns of a result by name; words are left out."""
    with open(os.path.join(out, "history.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns = {}
    for i, name in enumerate(rows[0]):
        try:
            columns[name] = np.array([float(row[i]) for row in rows[1:]])
        except ValueError:
            continue
    return columns


def read_about(out):
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        return json.load(file)


def make_folder(path):
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise Trouble(f"cannot write {path}: {error.strerror}", OUTPUT) from error
