# SPDX-License-Identifier: BSD-3-Clause
"""How the commands in Python end and what they print: each exception is one line with an exit code, and no text from a
file or a user reaches the terminal as it is. A script begins with

    if __name__ == "__main__":
        command.begin("delam: fit")

before it imports what takes long, and ends with command.run(main). Standard library alone."""
import contextlib
import errno
import io
import os
import re
import signal
import sys
import traceback
import warnings

HERE = os.path.dirname(os.path.realpath(__file__))
# What reads files and draws is beside the studies where those are installed, and in the Python package among the sources.
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "..", "..", "python", "src", "delam")]

from _pictures.input_file import Unreadable, reason  # noqa: E402

DONE, NOT_CONVERGED, WRONG, OUTPUT, NUMERICAL, INTERRUPTED = 0, 1, 2, 3, 4, 130

LONGEST = 1000  # characters of a message: a text of a file may be any number of them

# What moves a cursor, turns a line or hides a text: controls but for line feeds and tabs, separators and changes of
# direction of Unicode, and bytes that are no UTF-8. src/text/printable.cpp shows the same ones in the same way.
UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufeff"
                         "\U000e0000-\U000e007f]")


def _escaped(match):
    code = ord(match[0])
    # Bytes that are no UTF-8 come from the system as surrogates.
    given = bytes([code - 0xdc00]) if 0xdc80 <= code <= 0xdcff else match[0].encode("utf-8", "surrogatepass")
    return "".join(f"\\x{byte:02x}" for byte in given)


def printable(text):
    """The text with each unprintable byte as \\xNN."""
    return UNPRINTABLE.sub(_escaped, str(text))


class Trouble(Exception):
    """A message for people, and the exit code of the program."""

    def __init__(self, text, code=WRONG):
        super().__init__(text)
        self.code = code


class _Who:
    """Who speaks: "delam: fit", "plot.py"; and the lists that hear what is complained of, the last of which may keep it."""
    name = "delam"
    hearers = []


def say(text):
    """Lines on the standard output."""
    print(printable(text), flush=True)


@contextlib.contextmanager
def overheard(keep=True):
    """A list of what is complained of within. keep: it does not reach the terminal."""
    heard = []
    _Who.hearers.append((heard, keep))
    try:
        yield heard
    finally:
        _Who.hearers.pop()


def complain(text):
    """One line on the standard error."""
    for heard, keep in reversed(_Who.hearers):
        heard.append(text)
        if keep:
            return
    text = printable(text).replace("\n", "\\x0a")
    if len(text) > LONGEST:
        text = text[:LONGEST] + "..."
    with contextlib.suppress(OSError, ValueError):  # there is nobody to tell
        print(f"{_Who.name}: {text}", file=sys.stderr, flush=True)


def outcome(error):
    """The message and the exit code of an exception."""
    if isinstance(error, Trouble):
        return error, error.code
    if isinstance(error, Unreadable):
        return error, WRONG
    if isinstance(error, KeyboardInterrupt):
        return "interrupted", INTERRUPTED
    if isinstance(error, MemoryError):
        return "out of memory", NUMERICAL
    if isinstance(error, OSError):
        if error.errno == errno.ENOMEM:
            return "out of memory", NUMERICAL
        return (f"{os.fsdecode(error.filename)}: " if error.filename else "") + reason(error), OUTPUT
    where = traceback.extract_tb(error.__traceback__)
    place = f", at {os.path.basename(where[-1].filename)}:{where[-1].lineno}" if where else ""
    return f"fault of the program: {type(error).__name__}: {error}{place}", NUMERICAL


def _end_at_once(*_):
    complain("interrupted")
    os._exit(INTERRUPTED)  # an exception would be taken for a module's that cannot be imported


def _interrupt(*_):
    raise KeyboardInterrupt


def on_interrupt(action):
    """What Ctrl-C and SIGTERM do, unless whoever started this program has it ignore them."""
    for number in (signal.SIGINT, signal.SIGTERM):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, action)


def _end_uncaught(_, error, trace):
    text, code = outcome(error.with_traceback(trace))
    complain(text)
    os._exit(code)


def begin(who):
    """From here on nothing but lines of complain() reaches the terminal."""
    _Who.name = who
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # none where its descriptor is closed
            stream.reconfigure(errors="backslashreplace")
    sys.excepthook = _end_uncaught
    warnings.showwarning = lambda message, *_, **__: complain(f"warning: {message}")
    on_interrupt(_end_at_once)
    # The program that starts a study holds signals back until someone answers them.
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT, signal.SIGTERM})


@contextlib.contextmanager
def loading():
    """Around imports within a command: an interrupt ends it there, because modules may swallow exceptions."""
    before = [(number, signal.getsignal(number)) for number in (signal.SIGINT, signal.SIGTERM)]
    on_interrupt(_end_at_once)
    try:
        yield
    finally:
        for number, action in before:
            signal.signal(number, action)


def reported(main, interrupted=None):
    """The exit code of main(); what it raises becomes one line. interrupted: is called where Ctrl-C has ended it."""
    try:
        code = main()
        if sys.stdout is not None:
            sys.stdout.flush()
        return code
    except Exception as error:  # pylint: disable=broad-exception-caught
        text, code = outcome(error)
    except KeyboardInterrupt as error:
        if interrupted is not None:
            interrupted()
        text, code = outcome(error)
    complain(text)
    return code


def run(main, interrupted=None):
    """Ends the program with the exit code of main()."""
    on_interrupt(_interrupt)
    try:
        code = reported(main, interrupted)
    finally:
        on_interrupt(_end_at_once)
    if code == OUTPUT:
        # What the standard output cannot take must not be tried again while the interpreter ends.
        with contextlib.suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    sys.exit(code)
