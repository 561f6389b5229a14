#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_pictures.py PROGRAM FOLDER: holds pictures of every engine to an implementation that shares nothing with them (ray_caster.py).

A jittered grid of tetrahedra with holes (not convex) and a random scalar, both integrals, jumps and isosurfaces, silhouettes, light
(all terms of Kraus 2005, Equation 19: from the front, from behind, from the side, two-sided, coloured, fading),
perspective and orthographic, the eye inside and outside. Status 1 and the worst pixel when an engine is farther off than it may be.
"""
import json
import math
import os
import random
import subprocess
import sys

import exr
import vertex_light
from ray_caster import Camera, Cell, TransferFunction, pixel

SIZE = (48, 40)
PIXELS = 24  # per case
# largest difference of a component. reference: an EXR holds floats; cpu: float sums, closed forms to 1e-6, half-way vectors of nearly opposite ones; gl: tables made for 1e-4
LIMITS = {"reference": 1e-7, "cpu": 1e-5, "gl": 1e-4}
NOT_OF_LIGHT = ("silhouette", "clips", "clip_options", "cut_layer")
# silhouettes multiply what tables are off by k; ways to lights begin at points of one's own choice beside vertices
SMOOTH_LIMITS, SHADOW_LIMITS = {"reference": 1e-6, "cpu": 2e-5, "gl": 3e-4}, {"reference": 1e-4, "cpu": 1e-4, "gl": 2e-4}
CONTEXTS = {"gl": ["egl", "osmesa"]}
FIVE = (((0, 1, 2, 4), (1, 3, 2, 7), (1, 2, 4, 7), (1, 4, 5, 7), (2, 6, 4, 7)), ((1, 0, 3, 5), (0, 2, 3, 6), (0, 3, 5, 6), (0, 5, 4, 6), (3, 5, 6, 7)))

TRANSFER = {
    "color": [[0, 0.1, 0.2, 0.6], [0.4, 1, 0.8, 0.4], [0.4, 0.2, 0.9, 0.3], [1, 0.9, 0.2, 0.05]],
    "extinction": [[0.05, 0.3], [0.3, 2.0], [0.5, 0.1], [0.7, 0.1], [0.7, 4.0], [0.95, 1.0]],
}
PEAKS = [{"value": v, "opacity": a, "color": c} for v, a, c in ((0.21, 0.3, [1, 0.5, 0.1]), (0.52, 0.6, [0.2, 0.9, 0.3]), (0.83, 0.95, [0.1, 0.1, 1]))]


def jittered_grid(points_per_edge, seed, flat_middle=False):
    """Points, scalars and tetrahedra; `flat_middle`: the middle points of z stay in their plane, so that a cut can run along faces."""
    rng, n = random.Random(seed), points_per_edge
    points, scalars = [], []
    for z in range(n):
        for y in range(n):
            for x in range(n):
                moved = [(c + rng.uniform(-0.12, 0.12)) / (n - 1) for c in (x, y, z)]
                if flat_middle and 2 * z == n - 1:
                    moved[2] = 0.5
                points.append(tuple(moved))
                scalars.append(rng.random())
    tetrahedra = []
    for z in range(n - 1):
        for y in range(n - 1):
            for x in range(n - 1):
                corner = [(x + (i & 1)) + n * ((y + (i >> 1 & 1)) + n * (z + (i >> 2))) for i in range(8)]
                cube = FIVE[(x + y + z) % 2]
                tetrahedra += [tuple(corner[i] for i in tet) for tet in cube if rng.random() > 0.15]
    return points, scalars, tetrahedra


def write_vtk(path, points, scalars, tetrahedra):
    with open(path, "w") as out:
        out.write("# vtk DataFile Version 3.0\na jittered grid with holes\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n" + "\n".join("%r %r %r" % p for p in points))
        out.write(f"\nCELLS {len(tetrahedra)} {5 * len(tetrahedra)}\n" + "\n".join("4 %d %d %d %d" % t for t in tetrahedra))
        out.write(f"\nCELL_TYPES {len(tetrahedra)}\n" + "10\n" * len(tetrahedra))
        out.write(f"POINT_DATA {len(points)}\nSCALARS s double 1\nLOOKUP_TABLE default\n" + "\n".join(map(repr, scalars)) + "\n")


def towards(x, y, z, color=(1, 1, 1)):
    return {"type": "directional", "towards": [x, y, z], "color": list(color)}


def look_of(lights, exponent=32.0, reflectance="phong", **material):
    """A lighting file in full, and whether there are silhouettes."""
    whole = {"diffuse": 1, "specular": 1, "diffuse_transmission": 1, "specular_transmission": 1,
             "front": {"specular": [1, 1, 1], "exponent": exponent}, "back": {"specular": [1, 1, 1], "exponent": exponent}}
    return {"silhouette": False, "lights": lights, "ambient": [0.2, 0.2, 0.2], "reflectance": reflectance, "material": dict(whole, **material)}


def lights():
    """What Equation 19 tells apart, as the eye at (1.9, 1.4, 2.3) sees it."""
    back, side = towards(-1.4, -0.9, -1.8), towards(2, -1, -0.8)
    two_sided = {"front": {"specular": [1, 0.5, 0.2], "exponent": 24}, "back": {"specular": [0.1, 0.6, 0.9], "exponent": 6},
                 "diffuse": 0.7, "specular": 0.9, "diffuse_transmission": 0.8, "specular_transmission": 0.6}
    lamps = [{"type": "point", "position": [-0.6, -0.3, -0.9], "color": [1.2, 0.9, 0.5], "attenuation": [0.5, 0.2, 0.3]},
             {"type": "point", "position": [1.6, 1.2, 1.9], "color": [0.4, 0.9, 1.3], "attenuation": [1, 0, 0.5]}]
    head = {"type": "head", "color": [0.9, 1, 1.1], "attenuation": [1, 0.1, 0.05]}
    return {"front light": look_of([towards(1.4, 0.9, 1.8)]), "back light": look_of([back]), "side light": look_of([side], exponent=4.5),
            "back light, low exponent": look_of([back], exponent=3),
            "colored back light": look_of([towards(-1.4, -0.7, -1.9, (1.3, 0.7, 0.4)), side], exponent=6),
            "two-sided": look_of([back, side], **two_sided), "point lights": look_of(lamps, exponent=7), "head light": look_of([head]),
            "two-sided point lights": look_of([*lamps, head], **two_sided), "head and back light": look_of([head, back], exponent=5),
            "Blinn-Phong": look_of([back, side], 5, "blinn-phong"), "Blinn-Phong lamps": look_of(lamps, 9, "blinn-phong"),
            "Blinn-Phong two-sided": look_of([*lamps, back], reflectance="blinn-phong", **two_sided)}


def cuts(lit):
    """Clip planes, as options and as planes; what lies close behind the one through which a ray comes in is lit by its normal."""
    oblique, along_faces = ((0.5, 0.5, 0.5), (-1.0, -0.4, 0.3)), ((0.5, 0.5, 0.5), (0.0, 0.0, -1.0))
    option = lambda plane: "--clip-plane=" + triple(plane[0] + plane[1])
    box = [((0.2, 0.1, 0.1), (1, 0, 0)), ((0.8, 0.9, 0.7), (-1, 0, 0)), ((0.2, 0.1, 0.1), (0, 1, 0)), ((0.8, 0.9, 0.7), (0, -1, 0)),
           ((0.2, 0.1, 0.1), (0, 0, 1)), ((0.8, 0.9, 0.7), (0, 0, -1))]
    slab = [((0.5, 0.5, 0.35), (0, 0, 1)), ((0.5, 0.5, 0.65), (0, 0, -1))]
    for name, planes, options, layer in (
            ("oblique", [oblique], [option(oblique)], 0.05), ("along faces", [along_faces], [option(along_faces)], 0.05),
            ("along faces, thin", [along_faces], [option(along_faces)], 1e-3), ("along faces, none", [along_faces], [option(along_faces)], 0.0),
            ("along faces, all", [along_faces], [option(along_faces)], 2.0), ("box", box, ["--clip-box=0.2,0.8,0.1,0.9,0.1,0.7"], 0.03),
            ("slab", slab, ["--slab=0.5,0.5,0.5,0,0,1,0.3"], 0.02)):
        yield name, dict(lit, clips=planes, clip_options=options, cut_layer=layer)


def carried(lit):
    """What vertices carry: shadows of the volume and of isosurfaces, which shade others but not themselves, and smoothed gradients."""
    lamp = {"type": "point", "position": [0.6, 0.9, 1.4], "color": [1, 0.9, 0.8], "attenuation": [1, 0, 0.2]}
    back, side = towards(-1.4, -0.9, -1.8), towards(2, -1, -0.8)
    yield "shadows", dict(lit, shadows=True)
    yield "shadows of lamps", dict(lit, lights=[lamp, back], shadows=True)
    yield "shadows along the axes", dict(lit, lights=[towards(0, 0, 1), towards(-1, 0, 0)], shadows=True, silhouette=True)
    yield "shadows on smooth normals", dict(lit, lights=[side, lamp], shadows=True, normals="smooth")
    yield "smooth silhouettes", dict(look_of([]), silhouette=True, normals="smooth")
    yield "smooth silhouettes in light", dict(lit, silhouette=True, normals="smooth")


def cases():
    outside, inside = Camera((1.9, 1.4, 2.3), (0.5, 0.5, 0.5)), Camera((0.43, 0.55, 0.61), (0.9, 0.2, 0.1), fov=70.0)
    flat = Camera((0.5, 0.5, 3.0), (0.5, 0.5, 0.5), height=1.3)
    plain = look_of([])
    lit = look_of([towards(1, 2, 3), towards(-3, 1, 0.5)], exponent=8)
    for mode in ("standard", "scale-invariant"):
        for peaks in ([], PEAKS):
            for name, camera in (("outside", outside), ("inside", inside), ("orthographic", flat)):
                yield f"{mode} {'isosurfaces ' if peaks else ''}{name}", mode, peaks, camera, plain
        yield f"{mode} light", mode, PEAKS, outside, lit
        yield f"{mode} silhouettes", mode, PEAKS, outside, dict(plain, silhouette=True)
    for k, (name, look) in enumerate(lights().items()):
        mode, camera = ("standard", "scale-invariant")[k % 2], (outside, outside, flat)[k % 3]
        yield f"{mode} {name}", mode, PEAKS[:2], camera, dict(look, silhouette=k % 4 > 1)
    for mode in ("standard", "scale-invariant"):
        for peaks in ([], PEAKS):
            for name, look in carried(lit):
                yield f"{mode} {'isosurfaces ' if peaks else ''}{name}", mode, peaks, outside, look
    for k, (name, look) in enumerate(cuts(lit)):
        for camera in (outside, (flat, inside)[k % 2]):
            yield f"{'standard' if k % 2 else 'scale-invariant'} cut {name}", "standard" if k % 2 else "scale-invariant", PEAKS, camera, look
    yield "scale-invariant silhouettes light", "scale-invariant", PEAKS, outside, dict(lit, silhouette=True)


def triple(values):
    return ",".join(map(repr, values))


def draw(program, mesh, transfer, out, mode, camera, look, engine):
    command = [program, "render", mesh, "-o", out, "--tf", transfer, "--mode", mode, "--size", "%dx%d" % SIZE, "--quiet", *engine,
               "--eye=" + triple(camera.eye), "--target=" + triple(camera.target)]
    command += ["--height", repr(camera.height)] if camera.height else ["--fov", repr(camera.fov)]
    command += ["--silhouette"] if look["silhouette"] else []
    command += ["--normals", look["normals"]] if "normals" in look else []
    if look["lights"]:
        lighting = out + ".lighting.json"
        with open(lighting, "w") as file:
            json.dump({key: value for key, value in look.items() if key not in NOT_OF_LIGHT}, file)
        command += ["--lighting", lighting]
    command += look.get("clip_options", [])
    command += ["--cut-layer", repr(look["cut_layer"])] if "cut_layer" in look else []
    subprocess.run(command, check=True)
    return exr.read(out)


def difference(a, b):
    """The largest of a pixel's components; infinite where one is not a number."""
    return max(abs(p - q) if math.isfinite(p) else math.inf for p, q in zip(a, b))


def main(program, folder):
    os.makedirs(folder, exist_ok=True)
    transfer, picture = (os.path.join(folder, name) for name in ("transfer.json", "picture.exr"))
    meshes = {}
    for flat_middle in (False, True):
        points, scalars, tetrahedra = jittered_grid(5, 3, flat_middle)
        path = os.path.join(folder, "flat_middle.vtk" if flat_middle else "mesh.vtk")
        write_vtk(path, points, scalars, tetrahedra)
        cells = [Cell([points[i] for i in tet], [scalars[i] for i in tet]) for tet in tetrahedra]
        meshes[flat_middle] = path, points, scalars, tetrahedra, cells
    failures, rng = 0, random.Random(7)
    for name, mode, peaks, camera, look in cases():
        description, (mesh, *parts, cells) = dict(TRANSFER, isosurfaces=peaks), meshes["clips" in look]
        vertex_light.carry(*parts, cells, TransferFunction(description), mode, look)
        with open(transfer, "w") as out:
            json.dump(description, out)
        wanted = {}
        for _ in range(PIXELS):
            x, y = rng.randrange(SIZE[0] // 4, 3 * SIZE[0] // 4), rng.randrange(SIZE[1] // 4, 3 * SIZE[1] // 4)
            wanted[x, y] = pixel(cells, camera, TransferFunction(description), mode, look, x, y, SIZE)
        limits = SHADOW_LIMITS if look.get("shadows") else SMOOTH_LIMITS if "normals" in look else LIMITS
        for engine, limit in limits.items():
            for context in CONTEXTS.get(engine, [None]):
                options = ["--engine", engine] + (["--context", context] if context else [])
                rows = draw(program, mesh, transfer, picture, mode, camera, look, options)
                worst, at = max((difference(rows[y][x], value), (x, y)) for (x, y), value in wanted.items())
                wrong = worst > limit
                failures += wrong
                print(f"{'WRONG ' if wrong else ''}{name}: {engine}{' ' + context if context else ''} {worst:.1e} at {at}, limit {limit:.0e}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
