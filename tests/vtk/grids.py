# SPDX-License-Identifier: Apache-2.0
"""Grids for the tests, and what `tetralux render` draws of them. TETRALUX_PROGRAM names that program."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "outside"))
import array_exr  # noqa: E402

PROGRAM = os.environ["TETRALUX_PROGRAM"]
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="tetralux-vtk-"))

TETRA, HEXAHEDRON, WEDGE, PYRAMID = 10, 12, 13, 14


def wave(points):
    """A smooth field within [0, 1]."""
    x, y, z = points.T
    return 0.5 + 0.25 * np.sin(5 * x + 2 * y) * np.cos(4 * z - y) + 0.25 * np.sin(3 * y + z)


def lattice(n):
    """Points of a lattice over [-1, 1]^3, a little out of place within, and the eight corners of each box of it."""
    axis = np.linspace(-1, 1, n + 1)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    inside = (np.abs(points) < 1 - 1e-9).all(1)
    points = points + inside[:, None] * np.random.default_rng(7).uniform(-0.2 / n, 0.2 / n, points.shape)
    i, j, k = (a.ravel() for a in np.meshgrid(*3 * [np.arange(n)], indexing="ij"))
    corner = [((i + a) * (n + 1) + j + b) * (n + 1) + k + c for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    return points, np.stack(corner, 1)


def tetrahedra(n):
    """Points, and six tetrahedra about the diagonal of each box."""
    points, boxes = lattice(n)
    paths = [(0, 4, 6, 7), (0, 6, 2, 7), (0, 2, 3, 7), (0, 3, 1, 7), (0, 1, 5, 7), (0, 5, 4, 7)]
    return points, np.concatenate([boxes[:, list(path)] for path in paths])


def grid_of(points, cells, types=TETRA, point_data=None, cell_data=None):
    """`cells`: an array of one type, or a list of point numbers for each of the `types`."""
    grid = vtkUnstructuredGrid()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    grid.SetPoints(vtk_points)
    if np.isscalar(types):
        types = np.full(len(cells), types)
    offsets = np.concatenate([[0], np.cumsum([len(cell) for cell in cells])])
    array = vtkCellArray()
    array.SetData(
        numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=1),
        numpy_to_vtkIdTypeArray(np.concatenate(list(cells)).astype(np.int64), deep=1),
    )
    grid.SetCells(numpy_to_vtk(np.asarray(types, np.uint8), deep=1), array)
    for data, arrays in ((grid.GetPointData(), point_data or {}), (grid.GetCellData(), cell_data or {})):
        for name, values in arrays.items():
            one = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
            one.SetName(name)
            data.AddArray(one)
        if arrays:
            data.SetActiveScalars(next(iter(arrays)))
    return grid


def box_grid(n=8):
    points, cells = tetrahedra(n)
    return grid_of(points, cells, point_data={"wave": wave(points)})


COLORS = [[0, 0.1, 0.2, 0.9], [0.45, 0.9, 0.9, 0.8], [0.6, 0.2, 0.7, 0.1], [1, 0.9, 0.1, 0.1]]
OPACITIES = [[0, 0.0], [0.3, 0.2], [0.5, 3.0], [0.52, 0.4], [1, 4.0]]


def program_picture(grid, camera, size, *options, colors=COLORS, extinction=OPACITIES, surface=None, **more):
    """What `tetralux render` draws: float RGBA, rows from the top."""
    file, function, picture = FOLDER / "grid.vtu", FOLDER / "function.json", FOLDER / "picture.exr"
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.Write()
    text = {"normalized": False, "color": colors, **more}
    if extinction is not None:
        text["extinction"] = extinction
    function.write_text(json.dumps(text))
    view = ["--eye", *camera.GetPosition(), "--target", *camera.GetFocalPoint(), "--up", *camera.GetViewUp()]
    view = [view[0], _triple(view[1:4]), view[4], _triple(view[5:8]), view[8], _triple(view[9:12])]
    if camera.GetParallelProjection():
        view += ["--height", repr(2 * camera.GetParallelScale())]
    else:
        view += ["--fov", repr(camera.GetViewAngle())]
    if surface is not None:
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(str(FOLDER / "surface.vtp"))
        writer.SetInputData(surface)
        writer.Write()
        view += ["--surface", str(FOLDER / "surface.vtp"), "--surface-flat"]
    command = [PROGRAM, "render", str(file), "-o", str(picture), "--quiet", "--tf", str(function)]
    command += ["--size", f"{size[0]}x{size[1]}", *view, *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr)
    return array_exr.read(picture)


def _triple(values):
    return ",".join(repr(float(value)) for value in values)
