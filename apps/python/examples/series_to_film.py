# SPDX-License-Identifier: Apache-2.0
"""A field that changes on one mesh, as frames of a film: only the field is made anew. An animated PNG where Pillow is there."""

import numpy as np
import tetralux

mesh = tetralux.read("bucky:16")
x, y, z = (mesh.points - mesh.points.mean(axis=0)).T
renderer = tetralux.Renderer(mesh, size=(240, 240), transfer_function="turbo", background="white")
frames = []
for step in range(12):
    phase = 2 * np.pi * step / 12
    renderer.scalars = np.sin(9 * np.sqrt(x**2 + y**2 + z**2) - phase)
    frames.append(renderer.render())

try:
    from PIL import Image
except ImportError:
    for step, frame in enumerate(frames):
        frame.save(f"film_{step:02}.png")
else:
    first, *others = [Image.fromarray(frame.to_uint8()) for frame in frames]
    first.save("film.png", save_all=True, append_images=others, duration=80, loop=0)
