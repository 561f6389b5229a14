# SPDX-License-Identifier: Apache-2.0
"""A transfer function of one's own: an opaque isosurface in a clear shell, with light. One renderer draws what changes."""

import tetralux

shell = {
    "normalized": True,
    "color": [[0, 0.1, 0.2, 0.6], [0.6, 1, 0.8, 0.4], [1, 0.9, 0.2, 0.05]],
    "extinction": [[0, 0], [0.3, 1], [1, 40]],
}
renderer = tetralux.Renderer("bucky:32", size=(400, 400), eye=(1.9, 1.4, 2.3), lights="headlight")
renderer.transfer_function = shell
renderer.render().save("shell.png")

renderer.transfer_function = {**shell, "isosurfaces": [{"value": 0.63, "opacity": 0.95, "color": [1, 0.5, 0.1]}]}
renderer.silhouette = True
image = renderer.render()
image.save("isosurface.png")
print("error against the exact picture:", renderer.verify(1000)["rmse"])
