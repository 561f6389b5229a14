# SPDX-License-Identifier: Apache-2.0
"""Meshes: of arrays, of files, of what PyVista, VTK and meshio have."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np

from . import _core
from ._arrays import Floats, points_array
from ._cells import core_mesh
from ._errors import FieldError, InputError, UnsupportedError


class Mesh:
    """Checked cells with fields, shared by any number of renderers and threads.

    Parameters
    ----------
    points : array_like, (n, 3)
        Coordinates, in units of your own ("mesh units" below). float64 in C order is taken as it is, without a copy:
        do not change it while the mesh lives. Anything else is copied once.
    cells : array_like, mapping or tuple
        (m, 4) whole numbers: tetrahedra, in any orientation. ``{"tetra": (a, 4), "hexahedron": (b, 8), …}``: blocks by
        meshio's names. ``(offsets, connectivity, celltypes)``: VTK's numbers, with one offset more than cells. uint32
        in C order is taken as it is.
    point_data, cell_data : mapping of str to array_like, optional
        Fields: (n,) or (n, k) numbers for each point or cell. Where one is NaN, the cells about it are not drawn.

    Raises
    ------
    ValueError
        Where arrays do not fit together, a number names no point, or no sound cell is left. Cells that are flat, twice
        there or at points that are not finite are left out and counted in `report` instead.

    Examples
    --------
    >>> import numpy as np, tetralux
    >>> mesh = tetralux.Mesh(np.eye(4)[:, :3], [[0, 1, 2, 3]], point_data={"T": [0.0, 1.0, 2.0, 3.0]})
    >>> mesh.n_tetrahedra
    1
    """

    def __init__(
        self,
        points: Any,
        cells: Any,
        *,
        point_data: Optional[Mapping[str, Any]] = None,
        cell_data: Optional[Mapping[str, Any]] = None,
    ) -> None:
        self._points: Optional[Floats] = points_array(points)
        self._core = core_mesh(self._points, cells)
        self._fill(dict(point_data or {}), dict(cell_data or {}))

    def _fill(self, point_data: dict[str, Any], cell_data: dict[str, Any]) -> None:
        #: Fields on points by name; add to it what you like.
        self.point_data: dict[str, Any] = point_data
        #: Fields on cells by name.
        self.cell_data: dict[str, Any] = cell_data
        #: Names that a file gives the components of a field.
        self.component_names: dict[str, list[str]] = {}
        #: Fields that are mere numbers of points or cells: drawn only when asked for.
        self.bookkeeping: set[str] = set()
        #: The field that is drawn where none is named; None: the first.
        self.active: Optional[str] = None
        #: Times of all steps of a series, of which this is one.
        self.times: list[float] = []

    @classmethod
    def _read(cls, source: str, options: dict[str, Any]) -> Mesh:
        self = cls.__new__(cls)
        self._points = None
        self._core, fields, times = _core.read(source, **options)
        self._fill({}, {})
        self.times = list(times)
        for field in fields:
            data = self.point_data if field["on_points"] else self.cell_data
            data[field["name"]] = field["values"]
            if field["component_names"]:
                self.component_names[field["name"]] = field["component_names"]
            if field["bookkeeping"]:
                self.bookkeeping.add(field["name"])
        return self

    @property
    def points(self) -> Floats:
        """(n, 3) float64: the points that it was made of."""
        return self._core.positions if self._points is None else self._points

    @property
    def n_points(self) -> int:
        """How many values a field on points has."""
        return self._core.n_points

    @property
    def n_cells(self) -> int:
        """How many values a field on cells has."""
        return self._core.n_cells

    @property
    def n_tetrahedra(self) -> int:
        """How many tetrahedra are drawn."""
        return self._core.n_tetrahedra

    @property
    def tetrahedra(self) -> tuple[Floats, Any]:
        """What is drawn: (p, 3) float64 points and (t, 4) uint32 corners; views, not to be changed."""
        return self._core.positions, self._core.corners

    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """((x, y, z), (x, y, z)): the lowest and the highest coordinates of what is drawn, mesh units."""
        low, high = self._core.bounds
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])

    @property
    def length(self) -> float:
        """Diagonal of `bounds`, mesh units."""
        return float(np.linalg.norm(np.subtract(*self.bounds)))

    @property
    def report(self) -> dict[str, Any]:
        """What checking found: cells, cell_types, defects, skipped, each counted by name."""
        return self._core.report

    def __getitem__(self, name: str) -> Any:
        """A field's values, of points first. Raises KeyError naming the nearest field."""
        from ._fields import missing

        for data in (self.point_data, self.cell_data):
            if name in data:
                return data[name]
        raise FieldError(missing(self, name))

    def __repr__(self) -> str:
        fields = ", ".join([*self.point_data, *(f"{name} (cells)" for name in self.cell_data)])
        return f"<tetralux.Mesh: {self.n_tetrahedra} tetrahedra, fields: {fields or 'none'}>"


Source = Union[Mesh, str, "os.PathLike[str]", Any]


def read(
    source: Union[str, os.PathLike[str]],
    *,
    time: Optional[float] = None,
    subdivision: int = 0,
    merge: Optional[float] = None,
    smooth_cells: bool = False,
) -> Mesh:
    """A mesh from a file, or a generated field: "bucky:32", "coulomb:N", "marschner-lobb:N", "hydrogen:N".

    .vtu (one piece), Gmsh, MEDIT, TetGen and raw voxels are read by the library itself; other formats by PyVista or
    meshio, whichever is installed and can.

    Parameters
    ----------
    source : str or path
    time : float, optional
        Of a series: the step nearest to it; the first where nothing is said.
    subdivision : int, default 0
        Pieces along each edge of a curved cell, 1 to 64; 0: as many as its order.
    merge : float, optional
        Points within this distance, mesh units, become one.
    smooth_cells : bool, default False
        Fields on cells become fields on points, by averaging.

    Raises
    ------
    ValueError
        Where the file is not what it must be. tetralux.Error where nothing installed reads it.
    """
    path = os.fspath(source)
    options = {"time": time, "subdivision": subdivision, "merge": merge, "smooth_cells": smooth_cells}
    try:
        return Mesh._read(path, options)
    except UnsupportedError:
        if subdivision or merge is not None or smooth_cells:
            raise UnsupportedError(
                f"{path}: only the library's own readers take subdivision, merge and smooth_cells; save it as .vtu"
            ) from None
    from ._datasets import read_by_others

    return read_by_others(path, time)


def as_mesh(source: Source) -> Mesh:
    """A Mesh of whatever holds one: Mesh, path, dataset of PyVista or VTK, meshio.Mesh."""
    if isinstance(source, Mesh):
        return source
    if isinstance(source, (str, os.PathLike)):
        return read(source)
    from ._datasets import mesh_of

    mesh = mesh_of(source)
    if mesh is None:
        raise InputError(
            f"mesh: {type(source).__name__} is none; give a tetralux.Mesh, a path, or a mesh of PyVista, VTK or meshio"
        )
    return mesh
