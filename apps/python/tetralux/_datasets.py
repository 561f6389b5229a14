# SPDX-License-Identifier: Apache-2.0
"""What PyVista, VTK and meshio hold, as meshes. None of them is imported unless it is needed."""

from __future__ import annotations

import importlib
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._arrays import points_array
from ._cells import CELL_TYPES, CellArrays, core_mesh
from ._errors import InputError, UnsupportedError
from ._mesh import Mesh

_POLYHEDRON = 42
_GHOSTS = "vtkGhostType"
_LEFT_OUT = 1 | 32  # duplicate, hidden


def mesh_of(source: Any) -> Optional[Mesh]:
    """A Mesh of a dataset; None if it is of no known kind."""
    if hasattr(source, "IsA") and source.IsA("vtkDataObject"):
        return _of_vtk(source)
    if type(source).__module__.partition(".")[0] == "meshio":
        return _of_meshio(source)
    return None


def _of_meshio(source: Any) -> Mesh:
    blocks: dict[str, list[Any]] = {}
    places: dict[str, list[int]] = {}
    for place, block in enumerate(source.cells):
        if block.type in CELL_TYPES:
            blocks.setdefault(block.type, []).append(block.data)
            places.setdefault(block.type, []).append(place)
    if not blocks:
        raise InputError("mesh: no solid cells in it; give tetrahedra, hexahedra, wedges or pyramids")
    points = np.asarray(source.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    cells = {name: parts[0] if len(parts) == 1 else np.concatenate(parts) for name, parts in blocks.items()}
    order = [place for name in cells for place in places[name]]
    data = {
        name: np.concatenate([np.asarray(values[place]) for place in order])
        for name, values in source.cell_data.items()
    }
    return Mesh(points, cells, point_data=source.point_data, cell_data=data)


def _of_vtk(source: Any) -> Mesh:
    if source.IsA("vtkCompositeDataSet") or (source.IsA("vtkDataSet") and not source.IsA("vtkUnstructuredGrid")):
        if source.IsA("vtkPolyData"):
            raise InputError("mesh: a surface has no inside; give cells with a volume (a tetrahedral mesh of it, say)")
        return _of_grid(_unstructured(source))
    if not source.IsA("vtkUnstructuredGrid"):
        raise InputError(f"mesh: {source.GetClassName()} has no cells; give a dataset or a block of them")
    return _of_grid(source)


def _unstructured(source: Any) -> Any:
    """Grids and blocks as one vtkUnstructuredGrid, with the fields that all of them have."""
    vtk_append = importlib.import_module("vtkmodules.vtkFiltersCore").vtkAppendFilter()
    leaves = [source]
    if source.IsA("vtkCompositeDataSet"):
        leaves = []
        iterator = source.NewIterator()
        iterator.SkipEmptyNodesOn()
        iterator.InitTraversal()
        while not iterator.IsDoneWithTraversal():
            leaf = iterator.GetCurrentDataObject()
            if leaf.IsA("vtkDataSet") and not leaf.IsA("vtkPolyData") and leaf.GetNumberOfCells():
                leaves.append(leaf)
            iterator.GoToNextItem()
        if not leaves:
            raise InputError("mesh: none of the blocks has cells with a volume; give one that does")
    for leaf in leaves:
        vtk_append.AddInputData(leaf)
    vtk_append.Update()
    return vtk_append.GetOutput()


def _numpy(array: Any) -> npt.NDArray[Any]:
    values: npt.NDArray[Any] = importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy(array)
    return values


def _fields(data: Any) -> tuple[dict[str, Any], dict[str, list[str]]]:
    fields: dict[str, Any] = {}
    components: dict[str, list[str]] = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)  # None for text
        if array is None or not array.GetName():
            continue
        name = array.GetName()
        fields[name] = _numpy(array)
        if array.HasAComponentName():
            components[name] = [array.GetComponentName(c) or str(c) for c in range(array.GetNumberOfComponents())]
    return fields, components


def _polyhedra(grid: Any) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """(offsets, stream) of faces for every cell: nothing for those that are no polyhedra."""
    stream: list[npt.NDArray[np.int64]] = []
    sizes = np.zeros(grid.GetNumberOfCells(), np.int64)
    ids = importlib.import_module("vtkmodules.vtkCommonCore").vtkIdList()
    types = _numpy(_types(grid))
    for cell in np.flatnonzero(types == _POLYHEDRON):
        grid.GetFaceStream(int(cell), ids)
        faces = np.fromiter((ids.GetId(i) for i in range(1, ids.GetNumberOfIds())), np.int64)
        sizes[cell] = len(faces)
        stream.append(faces)
    offsets = np.zeros(len(sizes) + 1, np.int64)
    np.cumsum(sizes, out=offsets[1:])
    return offsets, np.concatenate(stream)


def _types(grid: Any) -> Any:
    """An array, however old VTK is: before 9.5 that function asked for a list to fill."""
    try:
        return grid.GetCellTypes()
    except TypeError:
        return grid.GetCellTypesArray()


def _of_grid(grid: Any) -> Mesh:
    if grid.GetNumberOfCells() == 0 or grid.GetPoints() is None:
        raise InputError("mesh: it has no cells; give one with at least one solid cell")
    points = points_array(_numpy(grid.GetPoints().GetData()))
    types = np.ascontiguousarray(_numpy(_types(grid)), dtype=np.uint8)
    faces = _polyhedra(grid) if (types == _POLYHEDRON).any() else None
    array = grid.GetCells()
    cells = CellArrays(
        types,
        np.ascontiguousarray(_numpy(array.GetOffsetsArray()), dtype=np.int64),
        np.ascontiguousarray(_numpy(array.GetConnectivityArray()), dtype=np.int64),
        faces,
    )
    point_data, point_names = _fields(grid.GetPointData())
    cell_data, cell_names = _fields(grid.GetCellData())
    ghosts = cell_data.pop(_GHOSTS, None)
    point_data.pop(_GHOSTS, None)
    if ghosts is not None and (ghosts & _LEFT_OUT).any():
        cells = cells._replace(types=np.where(ghosts & _LEFT_OUT, 0, types).astype(np.uint8))
    mesh = Mesh.__new__(Mesh)
    mesh._points = points
    mesh._core = core_mesh(points, cells)
    mesh._fill(point_data, cell_data)
    mesh.component_names = {**cell_names, **point_names}
    for data, place in ((grid.GetPointData(), "points"), (grid.GetCellData(), "cells")):
        active = data.GetScalars()
        if mesh.active is None and active is not None and active.GetName():
            mesh.active = f"{active.GetName()}@{place}"
    return mesh


def read_by_others(path: str, time: Optional[float]) -> Mesh:
    """By PyVista, else by meshio, whichever is there and can."""
    why = []
    for name, read in (("pyvista", _read_by_pyvista), ("meshio", _read_by_meshio)):
        try:
            module = importlib.import_module(name)
        except ImportError:
            why.append(f"{name} is not installed")
            continue
        try:
            return read(module, path, time)
        except InputError:
            raise
        except (Exception, SystemExit) as error:  # theirs: of any kind
            why.append(f"{name}: {' '.join(str(error).split()) or type(error).__name__}")
    raise UnsupportedError(f"{path}: {'; '.join(why)}; install pyvista or save it as .vtu")


def _read_by_pyvista(pyvista: Any, path: str, time: Optional[float]) -> Mesh:
    if time is None:
        data = pyvista.read(path)
    else:
        reader = pyvista.get_reader(path)
        times = list(reader.time_values)
        reader.set_active_time_value(min(times, key=lambda each: abs(each - time)))
        data = reader.read()
    mesh = _of_vtk(data)
    mesh.active = None  # of a file the first field is drawn, as everywhere
    return mesh


def _read_by_meshio(meshio: Any, path: str, time: Optional[float]) -> Mesh:
    return _of_meshio(meshio.read(path))
