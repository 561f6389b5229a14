# SPDX-License-Identifier: Apache-2.0
"""Tetralux against PyVista's own add_volume, in one run: processor time of all threads, error, lines of code, as a table.

VTK's unstructured mapper takes the opacity function as extinction times the unit distance; that of grids takes the opacity of
such a distance. Both are given what stands for the same extinction. The error is over the RGB of the screen, in [0, 1]; VTK's
tables and PyVista's pictures have 8 bits.
"""

import inspect
import sys
import time

import numpy as np
import pyvista as pv
import tetralux

N = int(sys.argv[1]) if len(sys.argv) > 1 else 32
SIZE = int(sys.argv[2]) if len(sys.argv) > 2 else 512
FRAMES = 3
EYE, TARGET = np.array([1.9, 1.4, 2.3]), np.array([0.5, 0.5, 0.5])
UNIT = 0.04  # so long a piece has the optical depth 1 where extinction is largest
STEPS = np.linspace(0, 1, 256)
COLORS = np.column_stack([STEPS, 1 - STEPS, np.full(256, 0.5)])
TAU = 25 * STEPS**2  # per mesh unit
FUNCTION = {
    "normalized": True,
    "color": np.column_stack([STEPS, COLORS]).tolist(),
    "extinction": np.column_stack([STEPS, TAU]).tolist(),
}


def unstructured_grid():
    mesh = tetralux.read(f"bucky:{N}")
    points, cells = mesh.tetrahedra
    grid = pv.UnstructuredGrid({pv.CellType.TETRA: cells.astype(np.int64)}, points)
    grid["T"] = next(iter(mesh.point_data.values()))
    return grid


def with_tetralux(grid, plotter):
    plotter.tetralux.add_volume(grid, "T", transfer_function=FUNCTION)


def with_ugrid_mapper(grid, plotter):
    plotter.add_volume(
        grid,
        scalars="T",
        cmap=color_map(),
        opacity=255 * TAU * UNIT,
        opacity_unit_distance=UNIT,
        mapper="ugrid",
        shade=False,
        show_scalar_bar=False,
    )


def with_resampling(grid, plotter):
    dimensions = (2 * N, 2 * N, 2 * N)
    spacing = (np.array(grid.bounds[1::2]) - grid.bounds[::2]) / (2 * N - 1)
    image = pv.ImageData(dimensions=dimensions, spacing=spacing, origin=grid.bounds[::2])
    image = image.sample(grid)
    plotter.add_volume(
        image,
        scalars="T",
        clim=grid.get_data_range("T"),
        cmap=color_map(),
        opacity=255 * (1 - np.exp(-TAU * UNIT)),
        opacity_unit_distance=UNIT,
        mapper="smart",
        shade=False,
        show_scalar_bar=False,
    )


def color_map():
    from matplotlib.colors import ListedColormap

    return ListedColormap(COLORS)


def aim(plotter, eye):
    plotter.camera_position = [eye, TARGET, (0, 1, 0)]
    plotter.camera.view_angle = 30
    plotter.renderer.reset_camera_clipping_range()


def measure(add, grid):
    plotter = pv.Plotter(off_screen=True, window_size=(SIZE, SIZE))
    plotter.set_background("black")
    start = time.process_time()
    add(grid, plotter)
    aim(plotter, EYE)
    screen = plotter.screenshot(return_img=True)[..., :3] / 255
    first = time.process_time() - start
    start = time.process_time()
    for frame in range(FRAMES):
        aim(plotter, EYE + 0.01 * (frame + 1))
        plotter.render()
        plotter.screenshot(return_img=True)
    following = (time.process_time() - start) / FRAMES
    plotter.close()
    return first, following, screen


def lines(add):
    return len([line for line in inspect.getsource(add).splitlines()[1:] if line.strip()])


grid = unstructured_grid()
exact = tetralux.render(
    grid, "T", transfer_function=FUNCTION, eye=EYE, target=TARGET, size=(SIZE, SIZE), engine="reference"
).rgba[..., :3]
print(f"{grid.n_cells:,} tetrahedra, {SIZE}x{SIZE}\n")
print("| | first picture, CPU s | next pictures, CPU s | rmse | largest error | lines |")
print("| --- | --- | --- | --- | --- | --- |")
for title, add in (
    ("`plotter.tetralux.add_volume(grid)`", with_tetralux),
    ('`plotter.add_volume(grid, mapper="ugrid")`', with_ugrid_mapper),
    (f"resampled to {2 * N}³, `plotter.add_volume(image)`", with_resampling),
):
    first, following, screen = measure(add, grid)
    error = screen - exact
    rmse = np.sqrt((error**2).mean())
    print(f"| {title} | {first:.2f} | {following:.3f} | {rmse:.1e} | {np.abs(error).max():.2f} | {lines(add)} |", flush=True)
