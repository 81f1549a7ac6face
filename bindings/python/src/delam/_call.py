# SPDX-License-Identifier: BSD-3-Clause
"""One way into the library: contexts, the call with its checks, callbacks, Ctrl-C, and the end of objects.

A mesh, a law and a problem have a context each; solvers share that of their problem. A context belongs to one thread at
a time, so each has a lock that every call holds: objects may be used from any thread, and those of distinct problems
run side by side (ctypes gives the interpreter free during a call).

Python code called from inside (laws, progress) must not let an exception into C. What it raises is kept, the library is
asked to stop, and the exception is raised again once the call is over. So is Ctrl-C: during long calls of the main
thread a handler of our own keeps what the present SIGINT handler raises. Leaving it to the interpreter would lose it,
because a signal that arrives in C becomes an exception at the first instruction of the next callback, before any try
block.
"""
import collections
import ctypes
import logging
import operator
import signal
import threading
import weakref

from . import _raw
from ._library import library
from .errors import ArgumentError, HandleError, StateError, error_of

_logger = logging.getLogger("delam")
_thread = threading.local()


class Call:
    """What a call in progress has to remember, on its thread."""

    __slots__ = ("context", "exception", "lines", "outer")

    def __init__(self, context):
        self.context = context
        self.exception = None
        self.lines = []
        self.outer = getattr(_thread, "call", None)


def keep_exception(exception):
    """From a callback: the exception is raised when the call of the library is over."""
    call = _thread.call
    if call.exception is None:
        call.exception = exception


def stopped():
    """From a callback: Ctrl-C, or an exception before, has ended this call."""
    return _thread.call.exception is not None


@_raw.delam_progress_callback
def _on_progress(stage, done, total, _):
    call = _thread.call
    try:
        if call.exception is None and call.context.progress is not None:
            if call.context.progress(stage.decode(), done, total):
                return 1
    except BaseException as exception:
        keep_exception(exception)
    if call.exception is None:
        return 0
    # Calls that read heed requests, not answers.
    library.delam_context_cancel(call.context.handle)
    return 1


@_raw.delam_log_callback
def _on_log(level, text, _):
    _thread.call.lines.append((level, text))


_NO_PROGRESS = _raw.delam_progress_callback()


class Interrupt:
    """Holds SIGINT back while the library works in the main thread."""

    __slots__ = ("call", "previous", "over")

    def __init__(self, call):
        self.call = call
        self.previous = None
        self.over = False

    def _handle(self, number, frame):
        if self.over:  # another handler has kept this one, and hands on
            self.previous(number, frame)
            return
        try:
            self.previous(number, frame)
        except BaseException as exception:
            if self.call.exception is None:
                self.call.exception = exception

    def begin(self):
        if threading.current_thread() is not threading.main_thread():
            return
        previous = signal.getsignal(signal.SIGINT)
        if callable(previous):
            self.previous = previous
            signal.signal(signal.SIGINT, self._handle)

    def end(self):
        self.over = True
        if self.previous is None:
            return
        found = signal.signal(signal.SIGINT, self.previous)
        if found != self._handle:  # a callback of the host has installed another one, which stays
            signal.signal(signal.SIGINT, found)

    @property
    def active(self):
        return self.previous is not None


class Context:
    """Messages, log, progress, cancel of the objects made with it, and their lock."""

    def __init__(self):
        handle = ctypes.POINTER(_raw.delam_context)()
        status = library.delam_context_create(ctypes.byref(handle))
        if status != _raw.DELAM_OK:
            raise error_of(status, "no context: out of memory")
        self.handle = handle
        self.progress = None  # called with (stage, done, total) inside long work; a true result cancels
        self.hosted = False  # some law of the objects is computed by Python
        self._lock = threading.Lock()
        self._owner = None
        self._doomed = collections.deque()
        library.delam_context_set_log(handle, _on_log, None)
        weakref.finalize(self, _destroy, library.delam_context_destroy, handle)

    def cancel(self):
        """Ask the running call to stop at its next check; from any thread."""
        library.delam_context_cancel(self.handle)

    def call(self, function, *arguments, other=None, whole=False, long=False, outcomes=()):
        """Calls a function of the library and raises what went wrong.

        other     a further context that is used
        whole     Ctrl-C waits for the end of the function, which may be Python's own
        long      so it does, but asks the library to stop; progress is told, whose true result
                  does not stop what only reads
        outcomes  statuses > 0 that are given back instead of being raised
        Returns (status, message).
        """
        call = Call(self)
        status, message = self._locked(call, other, self._checked, call, function, arguments, whole, long)
        for level, line in call.lines:
            text = line.decode(errors="replace")
            # An error's text, and an outcome's, go with the exception or warning.
            if level > 0 and text != message:
                _logger.log(logging.WARNING if level == 1 else logging.INFO, "%s", text)
        if call.exception is not None:
            exception, call.exception = call.exception, None
            try:
                raise exception
            finally:
                del exception
        if status != _raw.DELAM_OK and status not in outcomes:
            raise error_of(status, message)
        return status, message

    def text(self, function, *arguments):
        """Calls a function that returns text; None stays None."""
        value = self._locked(Call(self), None, function, *arguments)
        return None if value is None else value.decode(errors="replace")

    def _checked(self, call, function, arguments, whole, long):
        interrupt = Interrupt(call) if whole or long or self.hosted else None
        if interrupt is not None:
            interrupt.begin()
        try:
            watched = long and (interrupt.active or self.progress is not None)
            if watched:
                library.delam_context_set_progress(self.handle, _on_progress, None)
            try:
                status = function(*arguments)
            finally:
                if watched:
                    library.delam_context_set_progress(self.handle, _NO_PROGRESS, None)
            message = ""
            if status != _raw.DELAM_OK:
                message = library.delam_context_message(self.handle).decode(errors="replace")
        finally:
            if interrupt is not None:
                interrupt.end()
        return status, message

    def _locked(self, call, other, function, *arguments):
        """Calls while this context, and another if there is one, belong to this thread. `with` and a lock are one step
        for Ctrl-C, so none stays locked."""
        if other is not None and other is not self:
            first, second = sorted((self, other), key=id)
            first._refuse_reentry()
            second._refuse_reentry()
            with first._lock, second._lock:
                value = self._owned((first, second), call, function, arguments)
            second._bury()
        else:
            first = self
            first._refuse_reentry()
            with first._lock:
                value = self._owned((first,), call, function, arguments)
        first._bury()
        return value

    @staticmethod
    def _owned(contexts, call, function, arguments):
        me = threading.get_ident()
        try:
            for context in contexts:
                context._owner = me
            _thread.call = call
            return function(*arguments)
        finally:
            _thread.call = call.outer
            for context in contexts:
                context._owner = None

    def _refuse_reentry(self):
        if self._owner == threading.get_ident():
            raise StateError("the library was called from inside a callback, with an object that is at work")

    def end(self, destroy, handle, keep):
        """Destroys a handle, now or when the call that holds the context is over. `keep`: what must live until then."""
        self._doomed.append((destroy, handle, keep))
        self._bury()

    def _bury(self):
        # The collector runs anywhere, also inside callbacks: never wait here.
        while self._doomed and self._lock.acquire(blocking=False):
            try:
                while self._doomed:
                    destroy, handle, _ = self._doomed.popleft()
                    _destroy(destroy, handle)
            finally:
                self._lock.release()


def _destroy(destroy, handle):
    destroy(ctypes.byref(handle))


class Object:
    """Something of the library: a handle with an end. Usable as a context manager."""

    def _make(self, context, kind, destroy, function, *arguments, keep=(), **how):
        """Calls a function that makes a handle, its last argument, and owns that. `keep`: what the library refers to as
        long as the handle lives; `how`: as for Context.call, whose result this is."""
        handle = ctypes.POINTER(kind)()
        try:
            outcome = context.call(function, *arguments, ctypes.byref(handle), **how)
        except BaseException:
            if handle:
                context.end(destroy, handle, keep)
            raise
        self.context = context
        self._pointer = handle
        self._finalizer = weakref.finalize(self, context.end, destroy, handle, keep)
        return outcome

    @property
    def _handle(self):
        if not self._finalizer.alive:
            raise HandleError(f"this {type(self).__name__} is closed")
        return self._pointer

    @property
    def closed(self):
        return not self._finalizer.alive

    def close(self):
        """Frees what the library holds for this object; it cannot be used any more. Garbage collection does the
        same."""
        self._finalizer()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def cancel(self):
        """Ask a call that runs with this object in another thread to stop at its next check: it raises Cancelled. If none
        is running, the request waits for the next step, or for a solver that is made or loaded."""
        self.context.cancel()


def text(name, value):
    """A str as the library takes it."""
    if not isinstance(value, str):
        raise ArgumentError(f"{name} = {value!r} is a {type(value).__name__}, expected a str")
    if "\0" in value:
        raise ArgumentError(f"{name} = {value!r} contains a zero character")
    return value.encode()


def number(name, value):
    try:
        if isinstance(value, (str, bytes, bytearray)):
            raise TypeError
        return float(value)
    except OverflowError:
        raise ArgumentError(f"{name} does not fit into a float") from None
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} = {value!r} is no number") from None


def integer(name, value, bits=64):
    try:
        value = operator.index(value)
    except TypeError:
        raise ArgumentError(f"{name} = {value!r} is no integer") from None
    if not -(1 << (bits - 1)) <= value < 1 << (bits - 1):
        raise ArgumentError(f"{name} = {value} does not fit into {bits} bits")
    return value
