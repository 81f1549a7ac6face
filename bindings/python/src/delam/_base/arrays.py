# SPDX-License-Identifier: BSD-3-Clause
"""Checks and converts all input arrays, and gives the pointers of output arrays."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
# Sizes of an array: of any size (None), of this one, or of one of these.
Shape = tuple["int | tuple[int, ...] | None", ...]

_POINTERS: dict[np.dtype[Any], Any] = {
    np.dtype(np.float64): ctypes.POINTER(ctypes.c_double), np.dtype(np.int64): ctypes.POINTER(ctypes.c_int64),
    np.dtype(np.int32): ctypes.POINTER(ctypes.c_int32), np.dtype(np.uint8): ctypes.POINTER(ctypes.c_uint8)}


def pointer(array: NDArray[Any] | None) -> Any:
    """The address of a contiguous array as its type in C; None for None and for arrays without entries."""
    if array is None or array.size == 0:
        return None
    return ctypes.cast(array.ctypes.data, _POINTERS[array.dtype])


def _shape_text(shape: Shape) -> str:
    inside = ", ".join("any" if size is None else " or ".join(map(str, size)) if isinstance(size, tuple) else str(size)
                       for size in shape)
    return f"({inside},)" if len(shape) == 1 else f"({inside})"


def _fits(have: int, size: int | tuple[int, ...] | None) -> bool:
    return size is None or (have in size if isinstance(size, tuple) else have == size)


def ndim(value: object) -> int:
    """Dimensions of a value; -1 if it is no array, which gate() then reports."""
    try:
        return np.ndim(value)  # type: ignore[arg-type]
    except (ValueError, TypeError):
        return -1


def listed(value: Any) -> Any:
    """A single number as a list with one entry."""
    return [value] if ndim(value) == 0 else value


def _place(name: str, index: Any) -> str:
    return f"{name}[{', '.join(str(int(i)) for i in index)}]" if len(index) else name


def _refuse_masked(name: str, value: Any) -> None:
    if np.ma.is_masked(value):  # type: ignore[no-untyped-call]
        mask = np.ma.getmaskarray(value)  # type: ignore[no-untyped-call]
        raise ArgumentError(f"{_place(name, np.argwhere(mask)[0])} is masked")


def gate(name: str, value: Any, dtype: Any, shape: Shape) -> NDArray[Any]:
    """`value` as a contiguous array of `dtype` (float64, int64, int32) and `shape` (None: any size; a tuple: one of
    these), or ArgumentError naming the argument. Integers are taken for floats, not the other way round; all numbers
    must be finite."""
    dtype = np.dtype(dtype)
    _refuse_masked(name, value)
    try:
        array = np.asarray(value)
    except (ValueError, TypeError) as error:
        raise ArgumentError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiu":
        raise ArgumentError(f"{name} has type {array.dtype}, expected {dtype}")
    if dtype.kind == "i" and array.dtype.kind == "f" and array.size > 0:
        raise ArgumentError(f"{name} has type {array.dtype}, expected integers")
    if array.ndim != len(shape) or not all(map(_fits, array.shape, shape)):
        raise ArgumentError(f"{name} has shape {_shape_text(array.shape)}, expected {_shape_text(shape)}")
    if dtype.kind == "f":
        with np.errstate(over="ignore"):
            array = np.ascontiguousarray(array, dtype)
        if not np.isfinite(array).all():
            index = np.argwhere(~np.isfinite(array))[0]
            raise ArgumentError(f"{_place(name, index)} is {array[tuple(index)]}, must be finite")
        return array
    limits = np.iinfo(dtype)
    if array.size > 0 and array.dtype != dtype:
        for extreme, index in ((array.min(), array.argmin()), (array.max(), array.argmax())):
            if not limits.min <= int(extreme) <= limits.max:
                index = np.unravel_index(index, array.shape)
                raise ArgumentError(f"{_place(name, index)} = {extreme} does not fit into {dtype}")
    return np.ascontiguousarray(array, dtype)


def floats(name: str, value: Any, shape: Shape) -> FloatArray:
    """gate() of numbers."""
    return gate(name, value, np.float64, shape)


def indices(name: str, value: Any, shape: Shape = (None,), size: int | None = None) -> IntArray:
    """Indices; a single one where shape is one-dimensional; a boolean mask where `size`, its length, is given."""
    if size is not None and ndim(value) >= 0 and np.asarray(value).dtype == bool:
        _refuse_masked(name, value)
        mask = np.asarray(value)
        if mask.shape != (size,):
            raise ArgumentError(f"{name} is a mask of shape {_shape_text(mask.shape)}, expected ({size},)")
        return np.flatnonzero(mask).astype(np.int64)
    if len(shape) == 1 and ndim(value) == 0:
        value = [value]
    return gate(name, value, np.int64, shape)


def spread(name: str, value: ArrayLike, count: int) -> FloatArray:
    """[count] numbers, from that many or from one for all."""
    if ndim(value) == 0:
        return np.full(count, floats(name, [value], (1,))[0])
    return floats(name, value, (count,))


def direction(name: str, value: str | ArrayLike, dimension: int) -> FloatArray:
    """A vector, or the name of an axis: 'x', 'y', 'z', '-y' ..."""
    if isinstance(value, str):
        axis = "xyz"[:dimension].find(value.lstrip("+-")) if len(value.lstrip("+-")) == 1 else -1
        if axis < 0 or len(value) > 2:
            raise ArgumentError(f"{name} = {value!r} is no axis; in {dimension}D these are "
                                f"{', '.join('xyz'[:dimension])}, with or without a sign")
        vector = np.zeros(dimension)
        vector[axis] = -1.0 if value.startswith("-") else 1.0
        return vector
    return floats(name, value, (dimension,))
