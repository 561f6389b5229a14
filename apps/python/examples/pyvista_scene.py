# SPDX-License-Identifier: Apache-2.0
"""A volume among PyVista's actors: a sphere stands half in it, the floor lies behind it."""

import pyvista as pv

grid = pv.ImageData(dimensions=(24, 24, 24), spacing=(1 / 23,) * 3)
x, y, z = grid.points.T
grid["T"] = ((x - 0.5) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2) ** 0.5
mesh = grid.cast_to_unstructured_grid()

plotter = pv.Plotter(off_screen=True, window_size=(500, 400))
plotter.tetralux.add_volume(mesh, "T", cmap="viridis", opacity="linear", opacity_unit_distance=0.2)
plotter.add_mesh(pv.Sphere(radius=0.3, center=(0.9, 0.6, 0.6)), color="orange")
plotter.add_mesh(pv.Plane(center=(0.5, 0.5, -0.1), i_size=2, j_size=2), color="lightgray")
plotter.camera_position = "iso"
plotter.screenshot("pyvista_scene.png")
plotter.close()
