# SPDX-License-Identifier: Apache-2.0
"""Tetrahedra from numpy arrays. N = 60 makes a million of them."""

import sys
import time

import numpy as np
import tetralux

n = int(sys.argv[1]) if len(sys.argv) > 1 else 60
axis = np.linspace(0, 1, n)
points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
first = np.arange(n**3).reshape(n, n, n)[:-1, :-1, :-1].ravel()
step = (n * n, n, 1)
# six tetrahedra to a cube, one for each order in which x, y, z are walked along
orders = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]
cells = np.concatenate(
    [np.stack([first, first + step[a], first + step[a] + step[b], first + sum(step)], axis=1) for a, b, _ in orders]
)
values = np.sin(9 * points[:, 0]) * np.sin(7 * points[:, 1]) + points[:, 2]

start = time.perf_counter()
mesh = tetralux.Mesh(points, cells, point_data={"waves": values})
renderer = tetralux.Renderer(mesh, "waves", size=(512, 512))
image = renderer.render()
print(f"{mesh.n_tetrahedra:,} tetrahedra, first picture after {time.perf_counter() - start:.2f} s")
print(f"the next one takes {renderer.render(eye=(2, 1.5, 2.5)).report['milliseconds']:.0f} ms")
image.save("million_cells.png")
