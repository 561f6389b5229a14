# SPDX-License-Identifier: Apache-2.0
"""From the name of a field to the numbers that are drawn, by the rules of `tetralux render --scalar`."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from ._arrays import Floats, array_of, float_array
from ._errors import FieldError, InputError

if TYPE_CHECKING:
    from ._mesh import Mesh

Scalars = Union[str, npt.ArrayLike, None]


class Chosen(NamedTuple):
    title: str
    values: Floats
    on_points: bool


def _magnitude(values: Floats) -> Floats:
    """Euclidean norm that neither overflows nor vanishes where the result can be written, summed in order."""
    largest = np.abs(values).max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = values / largest[:, None]
        total = ratios[:, 0] * ratios[:, 0]
        for column in range(1, values.shape[1]):
            total = total + ratios[:, column] * ratios[:, column]
        norm = largest * np.sqrt(total)
    norm[largest == 0] = 0
    infinite = np.isinf(largest)
    norm[infinite] = np.inf
    return np.ascontiguousarray(norm)


def _component(mesh: Mesh, name: str, values: npt.NDArray[Any], text: str) -> Optional[int]:
    names = mesh.component_names.get(name, [])
    if text in names:
        return names.index(text)
    number = "xyz".find(text) if len(text) == 1 and text in "xyz" else int(text) if text.isdecimal() else -1
    return number if 0 <= number < values.shape[1] else None


def _scalar(name: str, values: Any, component: Optional[int], on_points: bool, mesh: Mesh) -> Chosen:
    array = array_of(f"field '{name}'", values)
    if array.ndim > 2:
        array = array.reshape(len(array), -1)
    title = name
    if array.ndim == 2 and array.shape[1] == 1:
        array = array[:, 0]
    elif array.ndim == 2:
        numbers = float_array(f"field '{name}'", array)
        if component is None:
            return _checked(Chosen(f"{name} (magnitude)", _magnitude(numbers), on_points), mesh)
        names = mesh.component_names.get(name) or (list("xyz") if array.shape[1] <= 3 else None)
        title = f"{name} ({names[component] if names else component})"
        array = array[:, component]
    return _checked(Chosen(title, float_array(f"field '{name}'", array), on_points), mesh)


def _checked(chosen: Chosen, mesh: Mesh) -> Chosen:
    wanted = mesh.n_points if chosen.on_points else mesh.n_cells
    if chosen.values.ndim != 1 or len(chosen.values) != wanted:
        place = "points" if chosen.on_points else "cells"
        raise InputError(
            f"field '{chosen.title}': {chosen.values.shape} values for {wanted} {place}; give one for each"
        )
    return chosen


def _find(mesh: Mesh, name: str) -> Optional[tuple[str, Any, bool]]:
    """A field by its name, of points first, or as "name@points" or "name@cells"."""
    for data, on_points in ((mesh.point_data, True), (mesh.cell_data, False)):
        if name in data:
            return name, data[name], on_points
    stem, at, place = name.rpartition("@")
    if at and place in ("points", "cells"):
        data = mesh.point_data if place == "points" else mesh.cell_data
        if stem in data:
            return stem, data[stem], place == "points"
    return None


def _first(mesh: Mesh) -> Optional[str]:
    """The first field of points, else of cells, that is not mere numbers of them and has a value somewhere."""
    without_value = None
    for data, place in ((mesh.point_data, "points"), (mesh.cell_data, "cells")):
        for name, values in data.items():
            array = np.asarray(values)
            if name in mesh.bookkeeping or array.dtype.kind not in "biuf":
                continue
            if np.isfinite(array).any():
                return f"{name}@{place}"
            without_value = without_value or f"{name}@{place}"
    return without_value


def _coordinate(mesh: Mesh, axis: int) -> Chosen:
    return Chosen("xyz"[axis], np.ascontiguousarray(mesh.points[:, axis]), True)


def choose(mesh: Mesh, scalars: Scalars) -> Chosen:
    """The numbers of a field: by its name ("T", "v:x", "T@cells"), or given themselves; None: the mesh's first.

    Vectors without a component count by their magnitude. Raises FieldError naming the nearest field.
    """
    if scalars is not None and not isinstance(scalars, str):
        array = array_of("scalars", scalars)
        if array.ndim not in (1, 2) or len(array) not in (mesh.n_points, mesh.n_cells):
            raise InputError(
                f"scalars: their shape is {array.shape}; give one for each of {mesh.n_points} points "
                f"or {mesh.n_cells} cells, or a field's name"
            )
        return _scalar("scalars", array, None, len(array) == mesh.n_points, mesh)
    name = scalars or mesh.active or _first(mesh)
    if name is None:
        low, high = mesh.bounds
        size = np.subtract(high, low)
        return _coordinate(mesh, 0 if size[0] >= size[1] and size[0] >= size[2] else 1 if size[1] >= size[2] else 2)
    found = _find(mesh, name)
    if found:
        return _scalar(found[0], found[1], None, found[2], mesh)
    if name in ("x", "y", "z"):
        return _coordinate(mesh, "xyz".index(name))
    stem, colon, text = name.rpartition(":")
    while colon and stem:
        found = _find(mesh, stem)
        if found:
            values = np.asarray(found[1])
            values = values.reshape(len(values), -1)
            component = _component(mesh, found[0], values, text)
            if component is not None:
                return _scalar(found[0], values, component, found[2], mesh)
            raise FieldError(
                f"field '{found[0]}' has no component '{text}'; it has {values.shape[1]} (0 to {values.shape[1] - 1})"
            )
        stem, colon, more = stem.rpartition(":")
        text = f"{more}:{text}"
    raise FieldError(missing(mesh, name))


def missing(mesh: Mesh, name: str) -> str:
    names = [*mesh.point_data, *mesh.cell_data]
    near = difflib.get_close_matches(name, names, 1, 0) if names else []
    if not near:
        return f"no field named '{name}': the mesh has none; give point_data or cell_data"
    others = ", ".join(f"'{each}'" for each in names[:20])
    return f"no field named '{name}'; did you mean '{near[0]}'? The mesh has {others}"
