# SPDX-License-Identifier: Apache-2.0
"""Meshes as PyVista, VTK and meshio have them, and files that their readers read."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT, grid_of_tetrahedra, waves

import tetralux

POINTS, CELLS = grid_of_tetrahedra(6)
SIZE = (64, 48)


def own_mesh():
    return tetralux.Mesh(POINTS, CELLS, point_data={"v": waves(POINTS)}, cell_data={"c": np.arange(len(CELLS)) % 7})


def expected(scalars="v"):
    return tetralux.render(own_mesh(), scalars, size=SIZE).rgba


@pytest.fixture
def pyvista():
    return pytest.importorskip("pyvista")


@pytest.fixture
def pyvista_grid(pyvista):
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: CELLS}, POINTS)
    grid.point_data["v"] = waves(POINTS)
    grid.cell_data["c"] = np.arange(len(CELLS)) % 7
    return grid


def test_unstructured_grid_of_pyvista(pyvista_grid):
    for scalars in ("v", "c"):
        np.testing.assert_array_equal(tetralux.render(pyvista_grid, scalars, size=SIZE).rgba, expected(scalars))
        np.testing.assert_array_equal(pyvista_grid.tetralux.render(scalars, size=SIZE).rgba, expected(scalars))


def test_active_scalars_are_drawn(pyvista_grid):
    pyvista_grid.set_active_scalars("c", preference="cell")
    pyvista_grid.point_data.active_scalars_name = None
    assert tetralux.render(pyvista_grid, size=SIZE).report["field"] == "c"


def test_points_are_borrowed(pyvista_grid):
    mesh = pyvista_grid.tetralux.mesh
    assert np.shares_memory(mesh.points, pyvista_grid.points)
    assert pyvista_grid.tetralux.mesh is mesh
    pyvista_grid["more"] = np.ones(len(POINTS))
    assert "more" in pyvista_grid.tetralux.mesh.point_data


def test_unstructured_grid_of_vtk_alone():
    vtk = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints

    points = vtkPoints()
    points.SetData(numpy_to_vtk(POINTS))
    cells = vtk.vtkCellArray()
    cells.SetData(4, numpy_to_vtkIdTypeArray(CELLS.ravel()))
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(vtk.VTK_TETRA, cells)
    values = numpy_to_vtk(waves(POINTS))
    values.SetName("v")
    grid.GetPointData().AddArray(values)
    np.testing.assert_array_equal(tetralux.render(grid, "v", size=SIZE).rgba, expected())


def test_meshio():
    meshio = pytest.importorskip("meshio")
    half = len(CELLS) // 2
    mesh = meshio.Mesh(
        POINTS,
        [("tetra", CELLS[:half]), ("triangle", CELLS[:5, :3]), ("tetra", CELLS[half:])],
        point_data={"v": waves(POINTS)},
        cell_data={"c": [np.arange(half) % 7, np.zeros(5), np.arange(half, len(CELLS)) % 7]},
    )
    for scalars in ("v", "c"):
        np.testing.assert_array_equal(tetralux.render(mesh, scalars, size=SIZE).rgba, expected(scalars))


def test_other_datasets_of_pyvista(pyvista):
    """Grids are hexahedra; blocks are one mesh."""
    image = pyvista.ImageData(dimensions=(6, 6, 6), spacing=(0.2,) * 3)
    image["v"] = waves(np.asarray(image.points))
    hexahedra = image.cast_to_unstructured_grid()
    rectilinear = pyvista.RectilinearGrid(*[np.linspace(0, 1, 6)] * 3)
    rectilinear["v"] = np.asarray(image["v"])
    structured = image.cast_to_structured_grid()
    right = tetralux.render(hexahedra, "v", size=SIZE).rgba
    assert right[..., 3].max() > 0.1
    for dataset in (image, rectilinear, structured):
        drawn = dataset.tetralux.render("v", size=SIZE).rgba
        np.testing.assert_allclose(drawn, right, atol=2e-5)
    left, other = (hexahedra.extract_cells(np.arange(a, b)) for a, b in ((0, 60), (60, 125)))
    blocks = pyvista.MultiBlock([left, None, other])
    np.testing.assert_allclose(blocks.tetralux.render("v", size=SIZE).rgba, right, atol=2e-5)


def test_polyhedra(pyvista):
    from pyvista import examples

    grid = examples.cells.Polyhedron()
    grid["v"] = np.arange(grid.n_points, dtype=float)
    assert tetralux.render(grid, "v", size=SIZE).rgba[..., 3].max() > 0.01


def test_ghosts_are_left_out(pyvista_grid):
    ghosts = np.zeros(len(CELLS), np.uint8)
    ghosts[: len(CELLS) // 2] = 32
    pyvista_grid.cell_data["vtkGhostType"] = ghosts
    assert tetralux.render(pyvista_grid, "v", size=SIZE).report["cells_drawn"] == len(CELLS) - len(CELLS) // 2


def test_surfaces_are_refused(pyvista):
    with pytest.raises(ValueError, match="surface has no inside"):
        tetralux.render(pyvista.Sphere(), size=SIZE)


def test_files_of_other_readers(pyvista, pyvista_grid, tmp_path):
    path = tmp_path / "grid.vtk"
    pyvista_grid.save(path)
    np.testing.assert_array_equal(tetralux.render(path, "v", size=SIZE).rgba, expected())


def test_files_read_as_the_program_reads_them(program, drawn_by_program, tmp_path):
    """.vtu by the library's own reader; its first field, a vector by its magnitude, a component, a field on cells."""
    meshio = pytest.importorskip("meshio")
    vector = np.stack([waves(POINTS), POINTS[:, 0], POINTS[:, 2] ** 2], axis=1)
    path = tmp_path / "mesh.vtu"
    meshio.Mesh(
        POINTS,
        [("tetra", CELLS)],
        point_data={"velocity": vector, "v": waves(POINTS)},
        cell_data={"c": [np.arange(len(CELLS)) % 7.0]},
    ).write(path)
    mesh = tetralux.read(path)
    for scalars in (None, "velocity", "velocity:y", "v", "c", "x"):
        arguments = ["--scalar", scalars] if scalars else []
        drawn = drawn_by_program(str(path), "--size", "64x48", *arguments)
        np.testing.assert_array_equal(tetralux.render(mesh, scalars, size=SIZE).rgba, drawn, err_msg=str(scalars))


def test_neither_pyvista_nor_meshio(tmp_path):
    code = (
        "import sys; sys.modules['pyvista'] = sys.modules['meshio'] = None\n"
        "import tetralux\n"
        "try: tetralux.read('mesh.vtk')\n"
        "except tetralux.UnsupportedError as error: print(error)\n"
    )
    (tmp_path / "mesh.vtk").write_text("")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert "install pyvista" in done.stdout and done.stdout.count("\n") == 1


def test_the_core_needs_only_numpy():
    code = (
        "import sys\nimport tetralux\n"
        "tetralux.render('bucky:8', size=(8, 8))\n"
        "heavy = {'pyvista', 'vtk', 'vtkmodules', 'meshio', 'matplotlib', 'PIL', 'ipywidgets'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_package_says_its_licence():
    for path in (ROOT / "apps/python").rglob("*.py"):
        assert "SPDX-License-Identifier: Apache-2.0" in path.read_text().splitlines()[0]
