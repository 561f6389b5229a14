#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""random_scenes.py PROGRAM FOLDER [--scenes N] [--seed S] [--only NUMBER]: random scenes drawn by every engine, held to array_caster.py.

Meshes, fields, transfer functions, cameras, modes and options are drawn from the kinds that random_*.py name. A pixel is wrong where an
engine differs by more than LIMITS, relative to 1 or the value if that is larger, unless the engine's report counts it (`pixels.wrong`).
Pixels in which the definition itself jumps within rounding of a ray are left out and counted. What goes wrong is written to
FOLDER/NUMBER as mesh.vtu, tf.json and options.txt. Status 1 where anything did, 77 where there is no numpy.
"""
import argparse
import collections
import json
import os
import subprocess
import sys
import time

try:
    import numpy as np
except ImportError:
    print("random_scenes.py: there is no numpy; install python3-numpy")
    sys.exit(77)

import array_exr
from array_caster import pictures
from array_geometry import Mesh
from array_transfer import TransferFunction
from random_functions import FIELDS, FUNCTIONS, random_field, random_function
from random_meshes import KINDS, random_mesh
from random_views import CAMERAS, MODES, camera_of, camera_words, random_camera, random_look

SIZES = ((16, 16), (15, 13), (17, 12))
LIMITS = {"reference": 2e-6, "cpu": 1e-4, "gl": 1e-4}
JUMP = 2e-6  # pixels whose rays a billionth of a pixel aside differ by more are not judged


class Scene:
    """All of one scene follows from the two numbers."""

    def __init__(self, seed, number):
        rng = np.random.default_rng([seed, number])
        pick = lambda names: str(rng.choice(list(names)))
        self.kinds = [pick(KINDS), pick(FIELDS), pick(FUNCTIONS), pick(CAMERAS), pick(MODES)]
        mesh, field, function, camera, mode = self.kinds
        points, cells = random_mesh(rng, mesh)
        self.mesh = Mesh(points, cells, *random_field(rng, field, points, cells))
        scalars = self.mesh.point_scalars if self.mesh.cell_scalars is None else self.mesh.cell_scalars
        over_scalar = mode in ("scale-invariant", "additive-scale-invariant")
        self.function = random_function(rng, function, scalars, None if over_scalar else 1 / self.mesh.bounding_sphere()[1], 1.0 if over_scalar else None)
        self.size = SIZES[rng.integers(len(SIZES))]
        self.view = random_camera(rng, camera, self.mesh)
        self.look, self.words = random_look(rng, mode, self.mesh, mesh == "overlapping")
        self.gl_words = ["--context", pick(("egl", "osmesa")), "--gl-path", pick(("stream", "stream", "resident", "tiles"))]

    def wanted(self):
        """Right pictures, one per way of standing beside the rays, and which pixels can be judged."""
        found = pictures(self.mesh, TransferFunction(self.function), camera_of(self.view), self.look, self.size)
        scale = np.maximum(1.0, np.abs(found).max(0))
        return found, (np.ptp(found, axis=0) <= JUMP * scale).all(-1)

    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        write_vtu(os.path.join(folder, "mesh.vtu"), self.mesh)
        with open(os.path.join(folder, "tf.json"), "w") as out:
            json.dump(self.function, out)
        with open(os.path.join(folder, "options.txt"), "w") as out:
            out.write(" ".join(self.words + camera_words(self.view, self.size)) + "\n")


def write_vtu(path, mesh):
    def array(name, kind, values, components=""):
        return f'<DataArray type="{kind}" Name="{name}"{components} format="ascii">' + " ".join(map(repr, values.reshape(-1).tolist())) + "</DataArray>"

    count = len(mesh.cells)
    field = "".join(f"<{place}>{array('s', 'Float64', values)}</{place}>"
                    for place, values in (("PointData", mesh.point_scalars), ("CellData", mesh.cell_scalars)) if values is not None)
    points, cells = array("p", "Float64", mesh.points, ' NumberOfComponents="3"'), array("connectivity", "Int64", mesh.cells)
    with open(path, "w") as out:
        out.write(f'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>'
                  f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{count}">{field}<Points>{points}</Points><Cells>{cells}'
                  f'{array("offsets", "Int64", 4 * np.arange(1, count + 1))}{array("types", "UInt8", np.full(count, 10))}</Cells></Piece></UnstructuredGrid></VTKFile>')


def draw(program, folder, scene, engine, words):
    """The picture and the report, or a line about what went wrong."""
    out, report = (os.path.join(folder, name) for name in ("picture.exr", "report.json"))
    if os.path.exists(out):
        os.remove(out)
    command = [program, "render", os.path.join(folder, "mesh.vtu"), "--tf", os.path.join(folder, "tf.json"), "-o", out, "--report", report, "--quiet",
               "--threads", "1", "--background", "none", "--engine", engine, *words, *scene.words, *camera_words(scene.view, scene.size)]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return None, None, f"status {done.returncode}: {done.stderr.strip()[:200]}"
    with open(report) as file:
        return array_exr.read(out).reshape(-1, 4).astype(float), json.load(file), ""


def judge(picture, report, wanted, judged, limit):
    """What is wrong with a picture, or an empty line; and its largest error where it is judged."""
    if not np.isfinite(picture).all():
        return f"{int((~np.isfinite(picture)).any(1).sum())} pixels are not finite", np.inf
    scale = np.maximum(1.0, np.abs(wanted).max(0))
    error = (np.abs(picture - wanted) / scale).max(-1).min(0)  # by the ray that is nearest
    error = np.where(judged, error, 0.0)
    wrong, counted = int((error > limit).sum()), report["pixels"]["wrong"] or 0
    if wrong <= counted:
        return "", float(error.max())
    at = int(error.argmax())
    repaired = report["pixels"]["repaired"]
    return f"{wrong} of {int(judged.sum())} wrong, {counted} counted, {repaired} repaired; the worst by {error[at]:.2e}, pixel {at}", float(error[at])


def check(program, scene, folder, keep, number, tally):
    scene.write(folder)
    wanted, judged = scene.wanted()
    tally["pixels"] += judged.size
    tally["left out"] += int((~judged).sum())
    tally["empty"] += not np.abs(wanted).max() > 0
    name, failures = " ".join(map(str, scene.kinds)), 0
    for engine, words in (("reference", []), ("cpu", []), ("gl", scene.gl_words)):
        picture, report, problem = draw(program, folder, scene, engine, words)
        worst = 0.0
        if picture is not None:
            problem, worst = judge(picture, report, wanted, judged, LIMITS[engine])
        tally["worst " + engine] = max(tally["worst " + engine], worst if not problem else 0)
        if problem:
            failures += 1
            print(f"WRONG {number}: {name}: {' '.join([engine, *words])}: {problem}; {' '.join(scene.words)}", flush=True)
    if failures:
        scene.write(os.path.join(keep, f"{number:05}"))
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, help="one scene, by its number")
    options = parser.parse_args()
    work = os.path.join(options.folder, "work")
    os.makedirs(work, exist_ok=True)
    tally, failed, begin = collections.defaultdict(float), 0, time.time()
    numbers = [options.only] if options.only is not None else range(options.first, options.first + options.scenes)
    for done, number in enumerate(numbers, 1):
        failed += check(options.program, Scene(options.seed, number), work, options.folder, number, tally) > 0
        if done % 200 == 0:
            print(f"{done} scenes, {failed} failed, {time.time() - begin:.0f} s", flush=True)
    print(f"{len(numbers)} scenes, {failed} failed; {tally['left out']:.0f} of {tally['pixels']:.0f} pixels not judged, {tally['empty']:.0f} scenes empty; "
          + ", ".join(f"{k} {v:.1e}" for k, v in sorted(tally.items()) if k.startswith("worst")))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
