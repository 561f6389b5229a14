#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""modes_check.py PROGRAM FOLDER PAGE [NAME ...]: the statements of projection/modes.md, each by its name, in every engine.

A mode of the table is a statement, and so is each paragraph with a heading in bold: STATEMENTS has a check for every one, or names the test
that has it. One that the page has and the list has not is an error. Pictures are held to array_caster.py, which was written from that page.
Status 1 where a picture differs, 77 where there is no numpy.
"""
import json
import os
import re
import sys
from types import SimpleNamespace

try:
    import numpy as np
except ImportError:
    print("modes_check.py: there is no numpy; install python3-numpy")
    sys.exit(77)

from array_caster import Look, pictures
from array_geometry import Mesh
from array_transfer import TransferFunction
from random_meshes import lattice
from random_scenes import draw, judge, write_vtu
from random_views import camera_of, triple, unit_double

SIZE = (20, 16)
LIMITS = {"reference": 1e-6, "cpu": 2e-5, "gl": 1e-4}  # an EXR holds floats; float sums and closed forms to 1e-6; tables made for 1e-4
OUTSIDE = {"eye": (1.9, 1.4, 2.3), "target": (0.5, 0.5, 0.5), "up": (0.0, 1.0, 0.0), "fov": 36.0}
FLAT = {"eye": (1.7, -0.9, 1.1), "target": (0.5, 0.5, 0.5), "up": (0.1, 0.2, 1.0), "height": 1.9}
SMOOTH = {"color": [[0.0, 0.1, 0.2, 0.6], [0.4, 1.0, 0.8, 0.4], [1.0, 0.9, 0.2, 0.05]], "extinction": [[0.0, 0.2], [0.5, 3.0], [1.0, 6.0]]}
JUMPS = {"color": SMOOTH["color"], "extinction": [[0.2, 0.0], [0.3, 2.0], [0.6, 2.0], [0.6, 0.5], [0.8, 0.5]]}
PEAKS = [{"value": 0.37, "opacity": 0.4, "color": [1.0, 0.5, 0.1]}, {"value": 0.71, "opacity": 0.8, "color": [0.2, 0.9, 0.3]}]
THIN = {"color": SMOOTH["color"], "extinction": [[0.0, 0.02], [1.0, 0.3]]}


def jittered_mesh():
    rng = np.random.default_rng(5)
    points, cells = lattice(4, 4, 4)
    points = points / 3 + rng.uniform(-0.04, 0.04, points.shape)
    cells = cells[rng.random(len(cells)) > 0.1]
    kept, cells = np.unique(cells, return_inverse=True)
    points = points[kept]
    field = 0.5 + 0.5 * np.sin(5 * points[:, 0] + 1) * np.cos(4 * points[:, 1]) * np.sin(3 * points[:, 2] + 0.5)
    return Mesh(points, cells.reshape(-1, 4), field)


def with_peaks(function):
    return dict(function, isosurfaces=PEAKS)


class Check:
    """Draws what a statement says by every engine and gathers where they differ from the caster."""

    def __init__(self, program, folder):
        self.program, self.folder, self.mesh = program, folder, jittered_mesh()
        self.problems, self.pictures, self.turn = [], 0, 0
        write_vtu(os.path.join(folder, "mesh.vtu"), self.mesh)

    def same(self, name, words, look, functions=(SMOOTH, with_peaks(JUMPS)), views=(OUTSIDE, FLAT), shown=None):
        """Functions and views take turns. `shown`: the function of the definition where that is not the one that is given."""
        function, view = functions[self.turn % len(functions)], views[(self.turn // 2 + self.turn) % len(views)]
        self.turn += 1
        with open(os.path.join(self.folder, "tf.json"), "w") as out:
            json.dump(function, out)
        wanted = pictures(self.mesh, TransferFunction(shown or function), camera_of(view), look, SIZE)
        judged = (np.ptp(wanted, axis=0) < 2e-6).all(-1)
        if not np.abs(wanted).max() > 0.05:
            self.problems.append(f"{name}: the definition shows nothing: choose another scene")
        scene = SimpleNamespace(words=["--mode", look.mode, *words], view=view, size=SIZE)
        for engine, limit in LIMITS.items():
            self.hold(name, engine, limit, scene, wanted, judged)

    def hold(self, name, engine, limit, scene, wanted, judged):
        picture, report, problem = draw(self.program, self.folder, scene, engine, [])
        self.pictures += 1
        if picture is not None:
            problem, _ = judge(picture, report, wanted, judged, limit)
        if problem:
            self.problems.append(f"{name}: {engine}: {problem}; {' '.join(scene.words)}")


def mode(name):
    def draw_mode(check):
        for _ in range(2):
            check.same(name, [], Look(mode=name))

    return draw_mode


def limits(check):
    point, normal = (0.5, 0.45, 0.5), tuple(unit_double((0.3, -0.4, 0.8)))
    low, high = (0.15, 0.2, 0.1), (0.8, 0.75, 0.9)
    axes = np.eye(3)
    plane = [(point, normal)]
    box = [(low, tuple(axes[k])) for k in range(3)] + [(high, tuple(-axes[k])) for k in range(3)]
    slab = [(tuple(np.array(point) - s * 0.15 * np.array(normal)), tuple(s * np.array(normal))) for s in (1, -1)]
    box_words = ["--clip-box=" + triple([v for pair in zip(low, high) for v in pair])]
    plane_words, slab_words = ["--clip-plane=" + triple(point + normal)], ["--slab=" + triple(point + normal + (0.3,))]
    for name in ("standard", "scale-invariant", "additive", "mip", "depth"):
        check.same("the side that the normal points to", plane_words, Look(mode=name, half_spaces=plane), views=(OUTSIDE,))
        check.same("the inside of a box", box_words, Look(mode=name, half_spaces=box), views=(FLAT,))
        check.same("between two planes", slab_words, Look(mode=name, half_spaces=slab), views=(OUTSIDE,))
    check.same("within each of them", plane_words + box_words, Look(half_spaces=plane + box))


def classification(check):
    for name in ("standard", "scale-invariant", "first-hit"):
        for kind in ("post", "post-linear", "pre"):
            check.same(f"{kind} of {name}", ["--classification", kind], Look(mode=name, classification=kind), functions=(SMOOTH, THIN))
    check.same("samples do not meet isosurfaces", ["--classification", "post"], Look(classification="post"), functions=(with_peaks(SMOOTH),))


def silhouettes(check):
    for name in ("standard", "scale-invariant"):
        for kind in ("exact", "approximate"):
            check.same(f"{kind} in {name}", ["--silhouette", kind], Look(mode=name, silhouette=kind), functions=(THIN, with_peaks(THIN)))
            for sample in ("post", "post-linear", "pre"):
                look = Look(mode=name, silhouette=kind, classification=sample)
                check.same(f"{kind}, {sample} in {name}", ["--silhouette", kind, "--classification", sample], look, (THIN, SMOOTH), (OUTSIDE,))
        words, look = ["--gradient-opacity=0.4"], Look(mode=name, gradient_opacity=0.4)
        check.same(f"gradient opacity in {name}", words, look, functions=(SMOOTH, with_peaks(THIN)))
        look = Look(mode=name, gradient_opacity=0.4, classification="post-linear", silhouette="exact")
        check.same(f"all of them in {name}", words + ["--silhouette", "exact", "--classification", "post-linear"], look, (THIN,), (OUTSIDE,))


def equidistant_isosurfaces(check):
    low, high = check.mesh.scalar_range()
    for count in (1, 5, 12):
        function, step = TransferFunction(SMOOTH), (high - low) / count
        values = low + (np.arange(count) + 0.5) * step
        tau, color = function.at(values)
        peaks = [{"value": float(v), "opacity": float(-np.expm1(-t * step)), "color": list(map(float, c))} for v, t, c in zip(values, tau, color)]
        shown = {"color": SMOOTH["color"], "extinction": [[0.0, 0.0]], "isosurfaces": peaks}
        check.same(f"{count} of them", [f"--isosurfaces={count}", "--unlit"], Look(mode="scale-invariant"), functions=(SMOOTH,), shown=shown)
    convergence(check, low, high)


def convergence(check, low, high):
    """The rmse of N isosurfaces falls by a power of N from 0.8 to 1: by the caster alone, of which the page says it."""
    function = {"color": [[0.0, 1, 1, 1]], "extinction": [[0.0, 1.5]]}
    render = lambda f: pictures(check.mesh, TransferFunction(f), camera_of(OUTSIDE), Look(mode="scale-invariant"), SIZE)[0]
    limit, errors, counts = render(function), [], (32, 64, 128, 256)
    for count in counts:
        step = (high - low) / count
        peaks = [{"value": low + (i + 0.5) * step, "opacity": float(-np.expm1(-1.5 * step)), "color": [1, 1, 1]} for i in range(count)]
        errors.append(np.sqrt(((render({"color": [[0.0, 1, 1, 1]], "extinction": [[0.0, 0.0]], "isosurfaces": peaks}) - limit) ** 2).mean()))
    power = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    if not 0.7 < power < 1.15:
        check.problems.append(f"the error of N isosurfaces falls as N^-{power:.2f}, not as N^-0.8 to N^-1")


def slices(check):
    one, other = ((0.5, 0.45, 0.5), tuple(unit_double((0.3, -0.4, 0.8)))), ((0.4, 0.5, 0.6), tuple(unit_double((0.9, 0.2, 0.1))))
    for name in ("standard", "scale-invariant", "first-hit", "absorption"):
        for opacity in (1.0, 0.35):
            words = ["--slice=" + triple(one[0] + one[1]), "--slice-opacity=%r" % opacity]
            check.same(f"{opacity} in {name}", words, Look(mode=name, slices=[(*one, opacity)]), views=(OUTSIDE,))
    words = ["--slice=" + triple(one[0] + one[1]), "--slice=" + triple(other[0] + other[1]), "--slice-opacity=0.4"]
    check.same("two that cross", words, Look(slices=[(*one, 0.4), (*other, 0.4)]))


def light(check):
    lights = [tuple(unit_double((1, 2, 3))), tuple(unit_double((-3, 1, 0.5)))]
    words = ["--light=" + triple(l) for l in lights] + ["--ambient=0.2", "--exponent=8"]
    for name in ("standard", "scale-invariant", "first-hit"):
        check.same(f"both sides in {name}", words, Look(mode=name, lights=lights, ambient=0.2, exponent=8), functions=(THIN, with_peaks(SMOOTH)))
    look = Look(lights=lights, ambient=0.2, exponent=8, transmission=False)
    check.same("no transmission", words + ["--no-transmission"], look, functions=(with_peaks(THIN),))
    look = Look(lights=["head"], point_lights=[(1.5, 0.2, 0.9)], ambient=0.1, exponent=12)
    check.same("head and point lights", ["--headlight", "--point-light=1.5,0.2,0.9", "--ambient=0.1", "--exponent=12"], look, (with_peaks(THIN),))
    look = Look(lights=lights, ambient=0.2, exponent=8, silhouette="exact")
    check.same("after silhouettes", words + ["--silhouette"], look, functions=(with_peaks(THIN),))


def depth_color(check):
    for name in ("standard", "scale-invariant", "first-hit", "additive", "emission"):
        look = Look(mode=name, depth_color=(0.3, 0.4, 0.9, 0.7))
        check.same(f"in {name}", ["--depth-color=0.3,0.4,0.9,0.7"], look, views=(OUTSIDE,))


MODES = ("standard", "scale-invariant", "first-hit", "depth", "mip", "minimum", "average", "additive", "additive-scale-invariant", "emission", "absorption")
STATEMENTS = {name: mode(name) for name in MODES}
STATEMENTS |= {"Limits": limits, "Classification": classification, "Silhouettes": silhouettes, "Equidistant isosurfaces": equidistant_isosurfaces,
               "Slices": slices, "Depth-based colouring": depth_color, "Light": light,
               "Anisotropic light": "tests/shading, tests/projection/light_test.cpp",
               "Scattering": "tests/outside/check_scattering.py, tests/shading/light_model_test.cpp",
               "phong": "tests/outside/check_pictures.py", "blinn-phong": "tests/outside/check_pictures.py",
               "ward": "tests/outside/check_scattering.py", "lafortune": "tests/outside/check_scattering.py",
               "none": "tests/outside/check_scattering.py", "contributions": "tests/outside/check_adaptive.py",
               "cells": "tests/outside/check_adaptive.py", "length": "tests/outside/check_adaptive.py",
               "Locally adaptive opacity": "tests/outside/check_adaptive.py",
               "Anti-aliasing": "tests/projection/sampled_engine_test.cpp",
               "Scalars that are exactly a node's": "tests/stress/stress_values_test.cpp", "Surfaces": "tests/projection/opaque_layer_test.cpp",
               "The boundary": "tests/projection/boundary_surface_test.cpp",
               "Isolines": "tests/mesh/isolines_test.cpp, tests/projection/isoline_test.cpp",
               "Shadows": "tests/projection/light_test.cpp, tests/projection/opaque_layer_test.cpp",
               "Adaptive opacity": "tests/projection/adaptive_opacity_test.cpp"}


def statements_of(page):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    named = [name for row in re.findall(r"^\| (`.*?) \|", text, re.M) for name in re.findall(r"`([a-z-]+)`", row) if not name.startswith("--")]
    return named + re.findall(r"^\*\*([A-Z][^*]*?)\.?\*\*", text, re.M)


def main(program, folder, page, *only):
    os.makedirs(folder, exist_ok=True)
    found = statements_of(page)
    untested = [name for name in found if name not in STATEMENTS]
    for name in untested:
        print(f"{page}: nothing tests '{name}': add it to STATEMENTS")
    check, failed = Check(program, folder), len(untested)
    for name, test in STATEMENTS.items():
        if isinstance(test, str) or (only and name not in only):
            continue
        check.problems, check.pictures = [], 0
        test(check)
        failed += bool(check.problems)
        print(f"{'WRONG' if check.problems else 'right'} {name}: {check.pictures} pictures", *check.problems, sep="\n  ", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
