# SPDX-License-Identifier: BSD-3-Clause
"""Every call of the library: contexts, the call with its checks, callbacks, Ctrl-C, and the destruction of objects.

A mesh, a law and a problem have a context each; solvers share that of their problem. A context belongs to one thread at
a time, so each has a lock that every call holds: objects may be used from any thread, and those of different problems
run in parallel (ctypes releases the interpreter lock during a call).

Python code called from inside (laws, progress) must not let an exception into C. An exception is kept, the library is
told to stop, and the exception is raised again when the call has ended. So is Ctrl-C: during long calls of the main
thread a separate handler keeps the exception that the present SIGINT handler raises. The interpreter
itself would lose it, because a signal that arrives in C becomes an exception at the first instruction of the next
callback, before any try block.
"""
from __future__ import annotations

import collections
import ctypes
import logging
import operator
import signal
import threading
import weakref
from collections.abc import Callable
from typing import Any, NoReturn, TypeVar

from . import raw
from .library import library
from .words import in_python
from .errors import ArgumentError, HandleError, StateError, error_of

Self = TypeVar("Self", bound="Object")

logger = logging.getLogger("delam")
_thread = threading.local()


class Call:
    """Data of a running call, on its thread."""

    __slots__ = ("context", "exception", "lines", "outer")

    def __init__(self, context: Context) -> None:
        self.context = context
        self.exception: BaseException | None = None
        self.lines: list[tuple[int, bytes]] = []
        self.outer: Call | None = getattr(_thread, "call", None)


def keep_exception(exception: BaseException) -> None:
    """Called in a callback: keeps the exception until the call of the library has ended."""
    call = _thread.call
    if call.exception is None:
        call.exception = exception


def stopped() -> bool:
    """Called in a callback: whether Ctrl-C or an earlier exception has ended this call."""
    return bool(_thread.call.exception is not None)


@raw.delam_progress_callback  # type: ignore[misc]
def _on_progress(stage: bytes, done: int, total: int, _: object) -> int:
    call = _thread.call
    try:
        if call.exception is None and call.context.progress is not None:
            if call.context.progress(stage.decode(), done, total):
                return 1
    except BaseException as exception:
        keep_exception(exception)
    if call.exception is None:
        return 0
    # Calls that read obey requests, not the callback's answer.
    library.delam_context_cancel(call.context.handle)
    return 1


@raw.delam_log_callback  # type: ignore[misc]
def _on_log(level: int, text: bytes, _: object) -> None:
    _thread.call.lines.append((level, text))


_NO_PROGRESS: Any = raw.delam_progress_callback()  # type: ignore[call-overload]


class Interrupt:
    """Holds SIGINT back while the library runs in the main thread."""

    __slots__ = ("call", "previous", "over")

    def __init__(self, call: Call) -> None:
        self.call = call
        self.previous: Callable[[int, Any], Any] | None = None
        self.over = False

    def _handle(self, number: int, frame: Any) -> None:
        assert self.previous is not None  # begin() has set it with this handler
        if self.over:  # another handler has kept this one, and hands on
            self.previous(number, frame)
            return
        try:
            self.previous(number, frame)
        except BaseException as exception:
            if self.call.exception is None:
                self.call.exception = exception

    def begin(self) -> None:
        if threading.current_thread() is not threading.main_thread():
            return
        previous = signal.getsignal(signal.SIGINT)
        if callable(previous):
            self.previous = previous
            signal.signal(signal.SIGINT, self._handle)

    def end(self) -> None:
        self.over = True
        if self.previous is None:
            return
        found = signal.signal(signal.SIGINT, self.previous)
        if found != self._handle:  # a callback of the host has installed another one, which stays
            signal.signal(signal.SIGINT, found)

    @property
    def active(self) -> bool:
        return self.previous is not None


class Context:
    """Messages, log, progress, cancel of the objects made with it, and their lock."""

    def __init__(self) -> None:
        handle = ctypes.POINTER(raw.delam_context)()
        status = library.delam_context_create(ctypes.byref(handle))
        if status != raw.DELAM_OK:
            raise error_of(status, "no context: out of memory")
        self.handle = handle
        # Called with (stage, done, total) inside long work; a true result cancels.
        self.progress: Callable[[str, int, int], object] | None = None
        self.hosted = False  # a law of the objects is computed by Python
        self._lock = threading.Lock()
        self._owner: int | None = None
        self._doomed: collections.deque[tuple[Any, Any, Any]] = collections.deque()
        library.delam_context_set_log(handle, _on_log, None)
        weakref.finalize(self, _destroy, library.delam_context_destroy, handle)

    def cancel(self) -> None:
        """Asks the running call to stop at its next check. May be called from any thread."""
        library.delam_context_cancel(self.handle)

    def call(self, function: Any, *arguments: Any, other: Context | None = None, whole: bool = False,
             long: bool = False, outcomes: tuple[int, ...] = ()) -> tuple[int, str]:
        """Calls a function of the library and raises its errors.

        other     a further context that is used
        whole     Ctrl-C waits for the end of the function, which may be Python's own
        long      the same, but asks the library to stop; calls progress, whose true result
                  does not stop a call that only reads
        outcomes  statuses > 0 that are returned instead of being raised
        Returns (status, message).
        """
        call = Call(self)
        status, message = self._locked(call, other, self._checked, call, function, arguments, whole, long)
        self._log(call, message)
        if call.exception is not None:
            exception, call.exception = call.exception, None
            try:
                raise exception
            finally:
                del exception
        if status != raw.DELAM_OK and status not in outcomes:
            raise error_of(status, message)
        return status, in_python(message)

    def beside(self, function: Any, *arguments: Any, other: Context | None = None) -> tuple[int, str]:
        """Calls a function of another library that uses objects of this context, and of another: its status, and the
        last error that libdelam has told meanwhile, or "". Ctrl-C, and what a callback has raised, is raised when the
        function has ended."""
        call = Call(self)
        status, _ = self._locked(call, other, self._checked, call, function, arguments, True, False)
        self._log(call, "")
        if call.exception is not None:
            exception, call.exception = call.exception, None
            try:
                raise exception
            finally:
                del exception
        told = [line.decode(errors="replace") for level, line in call.lines if level == 0]
        return status, told[-1] if told else ""

    @staticmethod
    def _log(call: Call, message: str) -> None:
        for level, line in call.lines:
            text = line.decode(errors="replace")
            # An error's text, and an outcome's, go with the exception or warning.
            if level > 0 and text != message:
                logger.log(logging.WARNING if level == 1 else logging.INFO, "%s", in_python(text))

    def text(self, function: Any, *arguments: Any) -> str | None:
        """Calls a function that returns text; None stays None."""
        value: bytes | None = self._locked(Call(self), None, function, *arguments)
        return None if value is None else value.decode(errors="replace")

    def _checked(self, call: Call, function: Any, arguments: tuple[Any, ...], whole: bool,
                 long: bool) -> tuple[int, str]:
        interrupt = Interrupt(call) if whole or long or self.hosted else None
        if interrupt is not None:
            interrupt.begin()
        try:
            watched = long and ((interrupt is not None and interrupt.active) or self.progress is not None)
            if watched:
                library.delam_context_set_progress(self.handle, _on_progress, None)
            try:
                status = function(*arguments)
            finally:
                if watched:
                    library.delam_context_set_progress(self.handle, _NO_PROGRESS, None)
            message = ""
            if status != raw.DELAM_OK:
                message = library.delam_context_message(self.handle).decode(errors="replace")
        finally:
            if interrupt is not None:
                interrupt.end()
        return status, message

    def _locked(self, call: Call, other: Context | None, function: Any, *arguments: Any) -> Any:
        """Calls while this thread holds this context, and another if there is one. Ctrl-C cannot come between `with`
        and the lock, so none stays locked."""
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
    def _owned(contexts: tuple[Context, ...], call: Call, function: Any, arguments: tuple[Any, ...]) -> Any:
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

    def _refuse_reentry(self) -> None:
        if self._owner == threading.get_ident():
            raise StateError("the library was called from inside a callback, with an object that is at work")

    def end(self, destroy: Any, handle: Any, keep: Any) -> None:
        """Destroys a handle, now or when the call that holds the context has ended. `keep`: objects that must live
        until then."""
        self._doomed.append((destroy, handle, keep))
        self._bury()

    def _bury(self) -> None:
        # The collector runs anywhere, also inside callbacks: never wait here.
        while self._doomed and self._lock.acquire(blocking=False):
            try:
                while self._doomed:
                    destroy, handle, _ = self._doomed.popleft()
                    _destroy(destroy, handle)
            finally:
                self._lock.release()


def _destroy(destroy: Any, handle: Any) -> None:
    destroy(ctypes.byref(handle))


class Object:
    """An object of the library: a handle that must be closed. Usable as a context manager."""

    context: Context
    _pointer: Any
    _finalizer: weakref.finalize
    _instead = ""  # of copying and pickling

    def _make(self, context: Context, kind: Any, destroy: Any, function: Any, *arguments: Any, keep: Any = (),
              **how: Any) -> tuple[int, str]:
        """Calls a function that makes a handle, its last argument, and takes ownership of it. `keep`: objects that the
        library uses as long as the handle lives; `how`: as for Context.call. Returns the result of that call."""
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
    def _handle(self) -> Any:
        if not self._finalizer.alive:
            raise HandleError(f"this {type(self).__name__} is closed")
        return self._pointer

    @property
    def closed(self) -> bool:
        """True if close() has freed this object."""
        return not self._finalizer.alive

    def close(self) -> None:
        """Frees the library's data of this object, which cannot be used any more. Garbage collection does the same."""
        self._finalizer()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _refuse(self, what: str) -> NoReturn:
        kind = type(self).__name__
        raise TypeError(f"a {kind} cannot be {what}: its data belong to the library in this process. {self._instead}")

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        self._refuse("pickled")

    def __copy__(self) -> NoReturn:
        self._refuse("copied")

    def __deepcopy__(self, memo: object) -> NoReturn:
        self._refuse("copied")

    def cancel(self) -> None:
        """Asks a call that runs with this object in another thread to stop at its next check; it raises Cancelled. If
        none is running, the request waits for the next step, or for the creation or loading of a solver."""
        self.context.cancel()


def text(name: str, value: object) -> bytes:
    """A str as the library takes it."""
    if not isinstance(value, str):
        raise ArgumentError(f"{name} = {value!r} is a {type(value).__name__}, expected a str")
    if "\0" in value:
        raise ArgumentError(f"{name} = {value!r} contains a zero character")
    return value.encode()


def number(name: str, value: Any) -> float:
    """A number as the library takes it."""
    try:
        if isinstance(value, (str, bytes, bytearray)):
            raise TypeError
        return float(value)
    except OverflowError:
        raise ArgumentError(f"{name} does not fit into a float") from None
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} = {value!r} is no number") from None


def integer(name: str, value: Any, bits: int = 64) -> int:
    """An integer as the library takes it. True and False are none."""
    try:
        if isinstance(value, bool):
            raise TypeError
        index = operator.index(value)
    except TypeError:
        raise ArgumentError(f"{name} = {value!r} is no integer") from None
    if not -(1 << (bits - 1)) <= index < 1 << (bits - 1):
        raise ArgumentError(f"{name} = {index} does not fit into {bits} bits")
    return index
