# SPDX-License-Identifier: Apache-2.0
"""The forms in which cells come, as VTK's: offsets, connectivity, types."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Floats, index_array, int64_array, numbers_within, whole_array
from ._errors import InputError

TETRA = 10

#: VTK's number and the points of a cell, by meshio's name of it.
CELL_TYPES: dict[str, tuple[int, int]] = {
    "tetra": (10, 4),
    "hexahedron": (12, 8),
    "wedge": (13, 6),
    "pyramid": (14, 5),
    "tetra10": (24, 10),
    "hexahedron20": (25, 20),
    "wedge15": (26, 15),
    "pyramid13": (27, 13),
    "hexahedron27": (29, 27),
    "hexahedron24": (33, 24),
    "wedge12": (31, 12),
    "wedge18": (32, 18),
    "voxel": (11, 8),
}
# Known, and no solids: they are counted as left out.
_FLAT_TYPES = {"vertex": 1, "line": 3, "line3": 21, "triangle": 5, "triangle6": 22, "quad": 9, "quad8": 23, "quad9": 28}


class CellArrays(NamedTuple):
    """Cells as VTK has them; ``faces`` are (offsets, stream) of polyhedra, as the C++ library takes them."""

    types: npt.NDArray[np.uint8]
    offsets: npt.NDArray[np.int64]
    connectivity: npt.NDArray[np.int64]
    faces: Optional[tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]] = None


def tetrahedra(points: Floats, cells: npt.NDArray[Any]) -> _core.Mesh:
    return _core.Mesh.tetrahedra(points, index_array("cells", cells, len(points)))


def _of_blocks(blocks: Mapping[str, Any]) -> CellArrays:
    types, sizes, numbers = [], [], []
    for name, cells in blocks.items():
        block = whole_array(f"cells '{name}'", cells)
        number, corners = CELL_TYPES.get(name, (_FLAT_TYPES.get(name, 0), 0))
        if number == 0:
            raise InputError(f"cells: there is no type '{name}'; take some of {', '.join(CELL_TYPES)}")
        if block.ndim != 2 or (corners and block.shape[1] != corners):
            raise InputError(f"cells '{name}': their shape is {block.shape}; give (m, {corners or 'n'})")
        types.append(np.full(len(block), number, np.uint8))
        sizes.append(np.full(len(block), block.shape[1], np.int64))
        numbers.append(block.astype(np.int64, copy=False).ravel())
    if not types:
        raise InputError("cells: there is none; give at least one type with its cells")
    return CellArrays(np.concatenate(types), _ends(np.concatenate(sizes)), np.concatenate(numbers))


def _ends(sizes: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    offsets = np.zeros(len(sizes) + 1, np.int64)
    np.cumsum(sizes, out=offsets[1:])
    return offsets


def core_mesh(points: Floats, cells: Any) -> _core.Mesh:
    """Of cells as an (m, 4) array, blocks by meshio's names, or (offsets, connectivity, celltypes)."""
    if isinstance(cells, CellArrays):
        return of_arrays(points, cells)
    if isinstance(cells, Mapping):
        if list(cells) == ["tetra"]:
            return core_mesh(points, cells["tetra"])
        return of_arrays(points, _of_blocks(cells))
    if isinstance(cells, tuple) and len(cells) == 3 and not np.isscalar(cells[0]):
        types = whole_array("celltypes", cells[2])
        if types.ndim != 1:
            raise InputError(f"celltypes: their shape is {types.shape}; give one number for each cell")
        if types.size and not (0 <= types.min() and types.max() < 256):
            raise InputError("celltypes: one lies beyond 0 and 255; give VTK's numbers of cell types")
        return of_arrays(
            points,
            CellArrays(
                np.ascontiguousarray(types, dtype=np.uint8),
                int64_array("offsets", cells[0]),
                int64_array("connectivity", cells[1]),
            ),
        )
    array = whole_array("cells", cells)
    if array.ndim != 2 or array.shape[1] != 4:
        raise InputError(
            f"cells: their shape is {array.shape}; give (m, 4) for tetrahedra, "
            'or {"tetra": …, "hexahedron": …}, or (offsets, connectivity, celltypes)'
        )
    return tetrahedra(points, array)


def of_arrays(points: Floats, cells: CellArrays) -> _core.Mesh:
    types, offsets, connectivity, faces = cells
    if len(offsets) != len(types) + 1:
        raise InputError(f"offsets: {len(offsets)} for {len(types)} cells; give one more than cells, the last the end")
    if len(types) and (types == TETRA).all() and 4 * len(types) == len(connectivity):
        if (np.diff(offsets) == 4).all() and offsets[0] == 0:
            return tetrahedra(points, connectivity.reshape(-1, 4))
    numbers_within("connectivity", connectivity, len(points))
    if faces is None:
        return _core.Mesh.cells(points, types, offsets, connectivity)
    return _core.Mesh.cells(points, types, offsets, connectivity, *faces)
