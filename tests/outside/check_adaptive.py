#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_adaptive.py PROGRAM FOLDER: holds locally adaptive opacity of every engine to the paper's equations (adaptive_opacity.py).

A jittered grid of tetrahedra with holes and a random scalar; a binary, a ramped and a jumping transfer function, isosurfaces; both units; the
bound, the threshold, samples in the place of integrals, and the map of contributions itself. Status 1 and the worst pixel when an engine is
farther off than it may be.
"""
import json
import os
import random
import subprocess
import sys

import exr
from adaptive_opacity import pixel
from check_pictures import PEAKS, TRANSFER, difference, jittered_grid, triple, write_vtk
from ray_caster import Camera, Cell

SIZE = (48, 40)
PIXELS = 24  # per case
LIMITS = {"reference": 1e-6, "cpu": 1e-5, "gl": 1e-4}
CONTEXTS = {"gl": ["egl", "osmesa"]}
COUNTED = 1e-5  # of N itself, relative to 1 + N

COLORS = [[0, 0.1, 0.2, 0.6], [0.45, 1, 0.8, 0.4], [1, 0.9, 0.2, 0.05]]
FUNCTIONS = {
    "binary": {"color": COLORS, "extinction": [[0.35, 0], [0.35, 3], [0.6, 3], [0.6, 0], [0.8, 0], [0.8, 3], [1, 3]]},
    "ramped": {"color": COLORS, "extinction": [[0, 0], [0.3, 0], [0.5, 2], [0.7, 0], [0.75, 0], [1, 9]]},
    "jumps": TRANSFER,
    "isosurfaces": dict(TRANSFER, extinction=[[0, 0]], isosurfaces=PEAKS),
    "ramped isosurfaces": {"color": COLORS, "extinction": [[0, 0], [0.3, 0], [0.5, 2], [0.7, 0]], "isosurfaces": PEAKS},
}


def cases():
    outside, inside = Camera((1.9, 1.4, 2.3), (0.5, 0.5, 0.5)), Camera((0.43, 0.55, 0.61), (0.9, 0.2, 0.1), fov=70.0)
    flat = Camera((0.5, 0.45, 3.0), (0.5, 0.5, 0.5), height=1.3)
    plain = {"mode": "standard", "unit": "cells", "piece": 0.11, "most": 0.12, "threshold": 0.0, "sampled": False}
    for function in FUNCTIONS:
        for unit in ("cells", "length"):
            for mode in ("standard", "additive"):
                yield function, outside, dict(plain, unit=unit, mode=mode)
    for unit in ("cells", "length"):
        yield "ramped", outside, dict(plain, unit=unit, most=1.0)
        yield "ramped", inside, dict(plain, unit=unit)
        yield "ramped", flat, dict(plain, unit=unit)
        yield "ramped", outside, dict(plain, unit=unit, threshold=0.3)
        for mode in ("standard", "additive", "contributions"):
            yield "ramped", outside, dict(plain, unit=unit, mode=mode, sampled=True)
        yield "ramped isosurfaces", outside, dict(plain, unit=unit, mode="contributions")


def draw(program, mesh, transfer, out, camera, look, engine):
    command = [program, "render", mesh, "-o", out, "--tf", transfer, "--mode", look["mode"], "--size", "%dx%d" % SIZE, "--quiet", *engine,
               "--eye=" + triple(camera.eye), "--target=" + triple(camera.target), "--adaptive", look["unit"]]
    command += ["--height", repr(camera.height)] if camera.height else ["--fov", repr(camera.fov)]
    command += ["--adaptive-max", repr(look["most"]), "--adaptive-threshold", repr(look["threshold"]), "--adaptive-step", repr(look["piece"])]
    command += ["--classification", "post"] if look["sampled"] else []
    subprocess.run(command, check=True)
    return exr.read(out)


def main(program, folder):
    os.makedirs(folder, exist_ok=True)
    mesh, transfer, picture = (os.path.join(folder, name) for name in ("mesh.vtk", "transfer.json", "picture.exr"))
    points, scalars, tetrahedra = jittered_grid(5, seed=3)
    write_vtk(mesh, points, scalars, tetrahedra)
    cells = [Cell([points[i] for i in tet], [scalars[i] for i in tet]) for tet in tetrahedra]
    failures, rng = 0, random.Random(11)
    for function, camera, look in cases():
        with open(transfer, "w") as out:
            json.dump(FUNCTIONS[function], out)
        wanted = {}
        for _ in range(PIXELS):
            x, y = rng.randrange(SIZE[0] // 4, 3 * SIZE[0] // 4), rng.randrange(SIZE[1] // 4, 3 * SIZE[1] // 4)
            wanted[x, y] = pixel(cells, camera, FUNCTIONS[function], look, x, y, SIZE)
        for engine, limit in LIMITS.items():
            for context in CONTEXTS.get(engine, [None]):
                options = ["--engine", engine] + (["--context", context] if context else [])
                rows = draw(program, mesh, transfer, picture, camera, look, options)
                counts = look["mode"] == "contributions"
                bound = COUNTED if counts and engine != "gl" else limit
                worst, at = max((difference(rows[y][x], value) / (1 + value[0] if counts else 1), (x, y)) for (x, y), value in wanted.items())
                wrong = worst > bound
                failures += wrong
                name = f"{function} {look['unit']} {look['mode']}{' samples' if look['sampled'] else ''}{' orthographic' if camera.height else ''}"
                name += f", at most {look['most']}, threshold {look['threshold']}"
                print(f"{'WRONG ' if wrong else ''}{name}: {engine}{' ' + context if context else ''} {worst:.1e} at {at}, limit {bound:.0e}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
