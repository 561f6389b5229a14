#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_scattering.py PROGRAM FOLDER: highlights of every engine against the formulas of Ament & Dachsbacher,
"Anisotropic Ambient Volume Shading" (IEEE Visualization 2015), written down once more.

On a plane isosurface, pixel by pixel: Blinn-Phong, Ward and Lafortune, with and without a phase function, round and
with tensors that the mesh brings along, lit from either side; k_s = |grad tau| in a slab of linear extinction. On an
ellipsoid: how far highlights reach along its axis over across it grows with gamma, for Ward and Lafortune; and what
--keep-anisotropy wrote gives the picture that it was written with. Status 1 if a pixel is off by more than 1e-4 or a
highlight does not grow.
"""
import json
import math
import os
import subprocess
import sys

import exr
from ray_caster import Camera, cross, dot, unit

SIZE, LIMIT = (24, 20), 1e-4
ENGINES = (["reference"], ["cpu"], ["gl", "--context", "egl"], ["gl", "--context", "osmesa"])
FIVE = (((0, 1, 2, 4), (1, 3, 2, 7), (1, 2, 4, 7), (1, 4, 5, 7), (2, 6, 4, 7)), ((1, 0, 3, 5), (0, 2, 3, 6), (0, 3, 5, 6), (0, 5, 4, 6), (3, 5, 6, 7)))
COLOR, AMBIENT, OPACITY = (0.7, 0.4, 0.2), 0.1, 0.6


def grid(points_per_edge, low, high, value):
    """Points of a cube, a scalar at each, and five tetrahedra per box."""
    n, points, tetrahedra = points_per_edge, [], []
    for k in range(n**3):
        points.append(tuple(low + (high - low) * c / (n - 1) for c in (k % n, k // n % n, k // n**2)))
    for k in range((n - 1) ** 3):
        x, y, z = k % (n - 1), k // (n - 1) % (n - 1), k // (n - 1) ** 2
        corner = [(x + (i & 1)) + n * ((y + (i >> 1 & 1)) + n * (z + (i >> 2))) for i in range(8)]
        tetrahedra += [tuple(corner[i] for i in tet) for tet in FIVE[(x + y + z) % 2]]
    return points, [value(p) for p in points], tetrahedra


def write_vtu(path, mesh, tensors=None):
    """`tensors`: (name, six numbers at every point)."""
    points, scalars, tetrahedra = mesh

    def array(kind, name, components, values):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">\n'
                + " ".join(repr(v) for v in values) + "\n</DataArray>\n")

    data = array("Float64", "s", 1, scalars)
    if tensors:
        data += array("Float64", tensors[0], 6, [v for _ in points for v in tensors[1]])
    with open(path, "w") as out:
        out.write('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
                  f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(tetrahedra)}">\n<Points>\n'
                  + array("Float64", "Points", 3, [v for p in points for v in p]) + "</Points>\n<Cells>\n"
                  + array("Int64", "connectivity", 1, [i for t in tetrahedra for i in t])
                  + array("Int64", "offsets", 1, [4 * (i + 1) for i in range(len(tetrahedra))])
                  + array("UInt8", "types", 1, [10] * len(tetrahedra))
                  + "</Cells>\n<PointData>\n" + data + "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def draw(program, folder, mesh, transfer, lighting, camera, options, size=SIZE):
    names = {name: os.path.join(folder, name) for name in ("transfer.json", "lighting.json", "picture.exr")}
    for name, content in (("transfer.json", transfer), ("lighting.json", lighting)):
        with open(names[name], "w") as out:
            json.dump(content, out)

    def triple(values):
        return ",".join(map(repr, values))

    view = ["--eye=" + triple(camera.eye), "--target=" + triple(camera.target), "--up=" + triple(camera.up_hint)]
    view += ["--height", repr(camera.height)] if camera.height else ["--fov", repr(camera.fov)]
    subprocess.run([program, "render", mesh, "-o", names["picture.exr"], "--tf", names["transfer.json"], "--lighting", names["lighting.json"],
                    "--size", "%dx%d" % size, "--quiet", *view, *options], check=True)
    return exr.read(names["picture.exr"])


def camera_at(eye, target, up=(0, 1, 0), **more):
    camera = Camera(eye, target, up, **more)
    camera.up_hint = up
    return camera


def specular(model, n, v, l, kappa, gamma, ratio, fibre):
    """f_s; Equations 8, 9 to 11 with 32 and 33, 12 with 34 and 35. n to the eye's side."""
    h = unit(tuple(a + b for a, b in zip(l, v)))
    across = cross(n, fibre)
    if model == "blinn-phong":
        return dot(n, h) ** kappa
    if model == "ward":
        rough = min(kappa * ratio**gamma, max(10.0, kappa))  # the program's bound of u
        lean = (dot(h, fibre) ** 2 / rough + dot(h, across) ** 2 / kappa) / dot(h, n) ** 2
        return math.exp(-lean) / (4 * math.pi * math.sqrt(rough * kappa * dot(n, l) * dot(n, v)))
    stretch = 2 * (1 - math.exp(gamma * (1 - ratio))) - 1
    value = stretch * dot(l, fibre) * dot(v, fibre) - dot(l, across) * dot(v, across) + dot(l, n) * dot(v, n)
    return max(value, 0.0) ** kappa


def scattered(case, n, v, alpha):
    """Colour per alpha: Equation 4 over all lights, with Kraus's diffuse terms where there is no phase function."""
    out = [AMBIENT * c for c in COLOR]
    if dot(n, v) < 0:
        n = tuple(-x for x in n)
    for l in map(unit, case["lights"]):
        facing = dot(n, l)
        g = case["phase"]
        if g is not None:
            diffuse = (1 - g * g) / (1 + g * g + 2 * g * dot(l, v)) ** 1.5
        else:
            diffuse = abs(facing) * (1 if facing > 0 else 1 - alpha)
        lobe = [case[key] for key in ("kappa", "gamma", "ratio", "fibre")]
        light = case["specular"] * specular(case["model"], n, v, l, *lobe) if facing > 0 else 0
        if case["model"] != "blinn-phong" or g is not None:
            light *= facing  # beside Kraus's diffuse terms Blinn and Phong's highlight has no cosine
        for i in range(3):
            out[i] += diffuse * COLOR[i] + light
    return out


def lighting_of(case):
    material = {"specular": case["specular"]}
    if case["phase"] is not None:
        material["phase_asymmetry"] = case["phase"]
    if case["by_gradient"]:
        material["specular_by_gradient"] = case["by_gradient"]
    anisotropy = {"gamma": case["gamma"]}
    if case["model"] != "blinn-phong":
        anisotropy["kappa"] = case["kappa"]
    return {"ambient": AMBIENT, "exponent": case["kappa"], "reflectance": case["model"], "anisotropy": anisotropy, "material": material,
            "lights": [{"type": "directional", "towards": l} for l in case["lights"]]}


FRONT, BACK = [[0.6, 0.5, 1.4], [-0.9, 0.2, 0.9]], [[-0.5, -0.3, -1.2]]


def cases():
    plain = {"lights": FRONT, "phase": None, "gamma": 10, "ratio": 1, "specular": 1, "by_gradient": False}
    for model, kappa in (("blinn-phong", 12), ("ward", 0.2), ("ward", 0.05), ("lafortune", 12)):
        yield f"{model} {kappa}", dict(plain, model=model, kappa=kappa)
        if kappa != 0.05:
            yield f"{model} {kappa} and a phase function", dict(plain, model=model, kappa=kappa, phase=0.4, lights=FRONT + BACK, specular=0.5)
        if model != "blinn-phong":
            yield f"{model} {kappa} along a fibre", dict(plain, model=model, kappa=kappa, ratio=1.25, gamma=8)
            yield f"{model} {kappa} lit from both sides", dict(plain, model=model, kappa=kappa, ratio=1.1, gamma=3, lights=FRONT + BACK)


def check_planes(program, folder):
    n, failures = unit((0.3, 0.2, 1.0)), 0
    fibre = unit(cross(n, (0.4, 1.0, 0.1)))
    across = cross(n, fibre)
    mesh, name = grid(4, 0.0, 1.0, lambda p: dot(n, p)), "anisotropy(radius=4,interval=0.05,samples=4,smoothing=0) of s"
    transfer = {"color": [[0, *COLOR]], "extinction": [[0, 0]], "isosurfaces": [{"value": 0.7, "opacity": OPACITY, "color": COLOR}]}
    camera = camera_at((0.9, 0.8, 2.4), (0.5, 0.5, 0.5), fov=26.0)
    for title, case in cases():
        case["fibre"], path = fibre, os.path.join(folder, "plane.vtu")
        tensor = [0.1 * (case["ratio"] * fibre[i] * fibre[k] + across[i] * across[k]) for i, k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        write_vtu(path, mesh, (name, tensor) if case["ratio"] != 1 else None)  # without one: the program's own, of a plane
        for engine in ENGINES:
            rows, worst, seen = draw(program, folder, path, transfer, lighting_of(case), camera, ["--engine", *engine]), 0.0, 0
            for y in range(SIZE[1]):
                for x in range(SIZE[0]):
                    *color, alpha = rows[y][x]
                    if abs(alpha - OPACITY) > 1e-3:
                        continue  # beside the surface
                    seen += 1
                    _, d = camera.ray(x, y, SIZE)
                    wanted = scattered(case, n, tuple(-c for c in d), OPACITY)
                    worst = max(worst, *(abs(c - OPACITY * w) for c, w in zip(color, wanted)))
            wrong = not worst <= LIMIT or seen < 100
            failures += wrong
            print(f"{'WRONG ' if wrong else ''}plane, {title}: {' '.join(engine)} {worst:.1e} in {seen} pixels, limit {LIMIT:.0e}")
    return failures


def check_gradient_specular(program, folder):
    """Extinction 3·s of a linear s: |grad tau| = 3·|grad s| everywhere, 1 over its largest. One colour: C = alpha·(light per alpha)."""
    n, failures = unit((0.3, 0.2, 1.0)), 0
    path, slope = os.path.join(folder, "slab.vtu"), 0.5
    write_vtu(path, grid(4, 0.0, 1.0, lambda p: slope * dot(n, p)))
    transfer = {"color": [[0, *COLOR]], "extinction": [[0, 0], [1, 3]]}
    camera = camera_at((0.9, 0.8, 2.4), (0.5, 0.5, 0.5), fov=26.0)
    for how, wanted_specular in ((True, 1.0), ("absolute", 3 * slope)):
        case = {"lights": FRONT, "phase": None, "gamma": 0, "ratio": 1, "specular": 0.5, "model": "ward", "kappa": 0.2, "fibre": unit(cross(n, (1, 0, 0))), "by_gradient": how}
        for engine in ENGINES:
            rows, worst = draw(program, folder, path, transfer, lighting_of(case), camera, ["--engine", *engine]), 0.0
            for y in range(6, SIZE[1] - 6):
                for x in range(6, SIZE[0] - 6):
                    _, d = camera.ray(x, y, SIZE)
                    wanted = scattered(dict(case, specular=wanted_specular), n, tuple(-c for c in d), 0)
                    worst = max(worst, *(abs(c - rows[y][x][3] * w) for c, w in zip(rows[y][x], wanted)))
            wrong = not worst <= LIMIT
            failures += wrong
            print(f"{'WRONG ' if wrong else ''}k_s by gradient {how}: {' '.join(engine)} {worst:.1e}, limit {LIMIT:.0e}")
    return failures


def extent(lit, unlit):
    """Root mean square reach of what light adds, upwards over sideways."""
    total = mean_x = mean_y = xx = yy = 0.0
    for y, row in enumerate(lit):
        for x, value in enumerate(row):
            w = value[1] - unlit[y][x][1]
            total, mean_x, mean_y, xx, yy = total + w, mean_x + w * x, mean_y + w * y, xx + w * x * x, yy + w * y * y
    return math.sqrt((yy / total - (mean_y / total) ** 2) / (xx / total - (mean_x / total) ** 2))


def check_ellipsoid(program, folder):
    """Axes 0.4, 0.4, 0.85, the longest upwards; extinction and diffuse light as in the unlit picture."""
    path, failures, size = os.path.join(folder, "ellipsoid.vtu"), 0, (64, 96)
    write_vtu(path, grid(25, -1.0, 1.0, lambda p: math.sqrt((p[0] / 0.4) ** 2 + (p[1] / 0.4) ** 2 + (p[2] / 0.85) ** 2)))
    transfer = {"color": [[0, *COLOR]], "extinction": [[0, 0]], "isosurfaces": [{"value": 1, "opacity": 1, "color": COLOR}]}
    camera = camera_at((4.0, 0.0, 0.0), (0.0, 0.0, 0.0), up=(0, 0, 1), height=2.0)
    lighting = {"ambient": AMBIENT, "normals": "smooth", "lights": [{"type": "directional", "towards": [1, 0.35, 0.2]}]}
    kept = os.path.join(folder, "kept.vtu")
    lobe = dict(lighting, reflectance="ward", anisotropy={"radius": 5, "gamma": 10})
    first = draw(program, folder, path, transfer, lobe, camera, ["--engine", "cpu", "--keep-anisotropy", kept], size)
    # the kept one does where nothing or the same is asked of neighbourhoods; another radius is computed
    for radius, same in ((None, True), (5, True), (3, False)):
        lobe["anisotropy"] = {"gamma": 10} | ({"radius": radius} if radius else {})
        again = draw(program, folder, kept, transfer, lobe, camera, ["--engine", "cpu"], size)
        wrong = (again == first) != same
        failures += wrong
        print(f"{'WRONG ' if wrong else ''}kept anisotropy, radius {radius}: the picture is {'the same' if again == first else 'another'}")
    unlit = draw(program, folder, path, transfer, dict(lighting, reflectance="none"), camera, ["--engine", "cpu"], size)
    for model, kappa in (("ward", 0.2), ("ward", 0.05), ("lafortune", 10), ("lafortune", 30)):
        reach = []
        for gamma in (0, 10, 60):
            anisotropy = {"gamma": gamma, "kappa": kappa}
            lit = draw(program, folder, kept, transfer, dict(lighting, reflectance=model, anisotropy=anisotropy), camera, ["--engine", "cpu"], size)
            reach.append(extent(lit, unlit))
        wrong = not reach[0] * 1.05 < reach[1] < reach[2] / 1.05
        failures += wrong
        print(f"{'WRONG ' if wrong else ''}ellipsoid, {model} {kappa}: along over across {' '.join('%.2f' % r for r in reach)} for gamma 0, 10, 60")
    return failures


def main(program, folder):
    os.makedirs(folder, exist_ok=True)
    return 1 if check_planes(program, folder) + check_gradient_specular(program, folder) + check_ellipsoid(program, folder) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
