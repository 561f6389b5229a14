# SPDX-License-Identifier: Apache-2.0
"""Many views of one mesh, drawn by several threads at once: each has a renderer of its own, all share the mesh."""

import math
import threading
from concurrent.futures import ThreadPoolExecutor

import tetralux

mesh = tetralux.read("bucky:24")
own = threading.local()


def view(turn: float) -> tetralux.Image:
    if not hasattr(own, "renderer"):
        own.renderer = tetralux.Renderer(mesh, transfer_function="plasma", size=(160, 160), threads=1)
    angle = 2 * math.pi * turn
    return own.renderer.render(eye=(0.5 + 2.6 * math.sin(angle), 1.2, 0.5 + 2.6 * math.cos(angle)))


with ThreadPoolExecutor(4) as pool:
    for number, image in enumerate(pool.map(view, [i / 16 for i in range(16)])):
        image.save(f"view_{number:02}.png")
