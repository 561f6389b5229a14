# SPDX-License-Identifier: Apache-2.0
"""Arrays of whoever calls as the library takes them: copied only where type or layout does not fit."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import InputError

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.uint32]


def array_of(what: str, values: Any) -> npt.NDArray[Any]:
    """Any array of real numbers. Raises InputError for what is none."""
    try:
        array = np.asarray(values)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: no array can be made of it ({error}); give numbers") from None
    if array.dtype.kind not in "biuf" or array.dtype.itemsize > 8:
        raise InputError(f"{what}: numbers of type {array.dtype}; give real or whole ones of at most 64 bits")
    return array


def float_array(what: str, values: Any) -> Floats:
    """float64, C order; the array itself where it is that already."""
    return np.ascontiguousarray(array_of(what, values), dtype=np.float64)


def points_array(points: Any) -> Floats:
    array = array_of("points", points)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"points: their shape is {array.shape}; give (n, 3): x, y, z of each")
    return float_array("points", array)


def whole_array(what: str, values: Any) -> npt.NDArray[Any]:
    array = array_of(what, values)
    if array.dtype.kind not in "iu":
        if array.size:
            raise InputError(f"{what}: numbers of type {array.dtype}; give whole ones (int32, int64, uint32, …)")
        array = array.astype(np.int64)
    return array


def numbers_within(what: str, values: npt.NDArray[Any], end: int) -> None:
    """Raises InputError unless all lie in 0 … end − 1."""
    if values.size and (values.min() < 0 or values.max() >= end):
        bad = values.min() if values.min() < 0 else values.max()
        raise InputError(f"{what}: {bad} is no point's number; there are {end}, counted from 0")


def index_array(what: str, values: npt.NDArray[Any], points: int) -> Indices:
    """uint32, C order, all within the points."""
    numbers_within(what, values, points)
    return np.ascontiguousarray(values, dtype=np.uint32)


def int64_array(what: str, values: Any) -> npt.NDArray[np.int64]:
    array = whole_array(what, values)
    if array.ndim != 1:
        raise InputError(f"{what}: its shape is {array.shape}; give one row of numbers")
    return np.ascontiguousarray(array, dtype=np.int64)
