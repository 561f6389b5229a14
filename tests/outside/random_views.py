# SPDX-License-Identifier: Apache-2.0
"""Cameras and looks drawn at random, and the command line's words for them."""
import numpy as np

from array_caster import Look, unit_double
from array_geometry import Camera

MODES = ("standard", "scale-invariant", "mip", "minimum", "average", "additive", "additive-scale-invariant", "emission", "absorption", "first-hit", "depth")
CAMERAS = ("around", "near", "inside", "on_vertex", "on_face_plane", "along_axis", "orthographic", "orthographic_axis", "orthographic_inside", "far",
           "narrow", "wide", "beside_face", "away", "on_edge_line")
AXES = np.eye(3)


def _direction(rng):
    return unit_double(rng.normal(size=3))


def _corner_of_cell(rng, mesh, count):
    cell = mesh.cells[rng.integers(len(mesh.cells))]
    return mesh.points[rng.permutation(cell)[:count]]


def random_camera(rng, kind, mesh):
    """Words for Camera: eye, target, up, and fov or height."""
    centre, radius = mesh.bounding_sphere()
    away, up = _direction(rng), _direction(rng)
    eye, target, view = centre + 3 * radius * away, centre + 0.2 * radius * _direction(rng), {"fov": 45.0}
    if kind == "near":
        eye = centre + rng.uniform(1.05, 1.6) * radius * away
    elif kind == "inside":
        eye, view = rng.dirichlet(np.ones(4)) @ _corner_of_cell(rng, mesh, 4), {"fov": 80.0}
    elif kind == "on_vertex":
        eye, view = _corner_of_cell(rng, mesh, 1)[0], {"fov": 80.0}
    elif kind == "on_face_plane":
        a, b, c = _corner_of_cell(rng, mesh, 3)
        eye, target = a + rng.uniform(-3, 3) * (b - a) + rng.uniform(-3, 3) * (c - a), (a + b + c) / 3
    elif kind == "on_edge_line":
        a, b = _corner_of_cell(rng, mesh, 2)
        eye, target = a + rng.choice([2.0, 3.0, -1.0]) * (b - a), a
    elif kind == "along_axis":
        axis = rng.integers(3)
        eye, target, up = centre + 3 * radius * AXES[axis], centre, AXES[(axis + 1) % 3]
    elif kind == "orthographic":
        view = {"height": 2.2 * radius}
    elif kind == "orthographic_axis":
        axis = rng.integers(3)
        eye, target, up = centre + 2 * radius * AXES[axis], centre, AXES[(axis + 1) % 3]
        view = {"height": float(rng.choice([2.0, 2.0 * radius, 1.0]))} if radius < 10 and radius > 0.1 else {"height": 2 * radius}
    elif kind == "orthographic_inside":
        eye, view = centre + 0.3 * radius * _direction(rng), {"height": 2 * radius}
        target = eye - away
    elif kind == "far":
        distance = 10.0 ** rng.uniform(2, 6)
        eye, target, view = centre + distance * radius * away, centre, {"fov": float(np.degrees(2.2 / distance))}
    elif kind == "narrow":
        target, view = rng.dirichlet(np.ones(4)) @ _corner_of_cell(rng, mesh, 4), {"fov": 10.0 ** rng.uniform(-2, 0.5)}
    elif kind == "wide":
        eye, view = centre + rng.uniform(0.3, 1.2) * radius * away, {"fov": rng.uniform(110, 170)}
    elif kind == "beside_face":
        a, b, c = _corner_of_cell(rng, mesh, 3)
        normal = np.cross(b - a, c - a)
        eye = (a + b + c) / 3 + 10.0 ** rng.uniform(-8, -1) * radius * normal / np.sqrt((normal * normal).sum())
        view = {"fov": 80.0}
    elif kind == "away":
        eye, target = centre + rng.uniform(0.2, 1.0) * radius * away, centre + 3 * radius * away
    if np.abs(np.cross(unit_double(target - eye), up)).max() < 1e-3:
        up = up[[1, 2, 0]] + 0.1
    return {"eye": tuple(map(float, eye)), "target": tuple(map(float, target)), "up": tuple(map(float, up)), **view}


def _generic_plane(rng, mesh):
    centre, radius = mesh.bounding_sphere()
    return tuple(map(float, centre + 0.4 * radius * rng.uniform(-1, 1, 3))), tuple(map(float, _direction(rng)))


def _clip(rng, mesh, look):
    """One of plane, axis plane, box and slab; the words for it."""
    centre, radius = mesh.bounding_sphere()
    kind = rng.integers(4)
    if kind <= 1:
        point, normal = _generic_plane(rng, mesh)
        if kind == 1:
            normal = tuple(map(float, rng.choice([-1.0, 1.0]) * AXES[rng.integers(3)]))
        look.half_spaces.append((point, normal))
        return ["--clip-plane=" + triple(point + normal)]
    if kind == 2:
        low, high = centre - radius * rng.uniform(0.1, 0.7, 3), centre + radius * rng.uniform(0.1, 0.7, 3)
        look.half_spaces += [(tuple(low), tuple(AXES[k])) for k in range(3)] + [(tuple(high), tuple(-AXES[k])) for k in range(3)]
        return ["--clip-box=" + triple([v for pair in zip(low, high) for v in pair])]
    point, normal = _generic_plane(rng, mesh)
    thickness = float(radius * rng.uniform(0.1, 0.8))
    n = unit_double(normal)
    for sign in (1, -1):
        look.half_spaces.append((tuple(np.array(point) - sign * thickness / 2 * n), tuple(sign * n)))
    return ["--slab=" + triple(point + normal + (thickness,))]


def _meets(mesh, point, normal):
    above = (mesh.points - np.array(point)) @ np.array(normal) > 0
    return any(0 < above[cell].sum() < 4 for cell in mesh.cells)


def _slice(rng, mesh, look):
    point, normal = _generic_plane(rng, mesh)
    while not _meets(mesh, point, normal):  # the program refuses slices that miss the mesh
        point, normal = _generic_plane(rng, mesh)
    opacity = round(float(rng.choice([1.0, rng.random()])), 3)
    look.slices.append((point, normal, opacity))
    return ["--slice=" + triple(point + normal), "--slice-opacity=%r" % opacity]


def _lights(rng, mesh, look):
    words = []
    for _ in range(int(rng.integers(1, 3))):
        kind = rng.integers(4)
        if kind == 0 and "head" not in look.lights:  # there is one head
            look.lights.append("head")
            words.append("--headlight")
        elif kind <= 1:
            centre, radius = mesh.bounding_sphere()
            look.point_lights.append(tuple(map(float, centre + 1.5 * radius * _direction(rng))))
            words.append("--point-light=" + triple(look.point_lights[-1]))
        else:
            look.lights.append(tuple(map(float, _direction(rng))))
            words.append("--light=" + triple(look.lights[-1]))
    look.ambient, look.exponent = round(float(rng.random()), 3), float(rng.integers(1, 40))
    words += ["--ambient=%r" % look.ambient, "--exponent=%r" % look.exponent]
    if rng.integers(3) == 0:
        look.transmission = False
        words.append("--no-transmission")
    return words


def _silhouette(rng, mesh, look):
    look.silhouette = str(rng.choice(["exact", "approximate"]))
    return ["--silhouette", look.silhouette]


def _classification(rng, mesh, look):
    look.classification = str(rng.choice(["post", "post-linear", "pre"]))
    return ["--classification", look.classification]


def _gradient_opacity(rng, mesh, look):
    look.gradient_opacity = round(float(10.0 ** rng.uniform(-1, 0.5)), 4)
    return ["--gradient-opacity=%r" % look.gradient_opacity]


def _depth_color(rng, mesh, look):
    look.depth_color = tuple(round(float(v), 3) for v in rng.random(4))
    return ["--depth-color=" + triple(look.depth_color)]


INTEGRATING = (_clip, _slice, _lights, _silhouette, _classification, _gradient_opacity, _depth_color)
OPTIONS = {"standard": INTEGRATING, "scale-invariant": INTEGRATING, "first-hit": INTEGRATING, "absorption": (_clip, _slice), "depth": (_clip,),
           "mip": (_clip,), "minimum": (_clip,), "average": (_clip,), "additive": (_clip, _depth_color),
           "additive-scale-invariant": (_clip, _depth_color), "emission": (_clip, _depth_color)}


def random_look(rng, mode, mesh, overlapping):
    """A Look, and the words for it. Where cells overlap a slice has the colours of either."""
    look, words = Look(mode=mode), ["--mode", mode]
    choices = OPTIONS[mode]
    count = int(rng.choice([0, 1, 2, 3], p=[0.35, 0.3, 0.2, 0.15]))
    chosen = [choices[k] for k in sorted(rng.permutation(len(choices))[:count])]
    if _lights in chosen and _clip in chosen:
        chosen.remove(_clip)  # the caster knows no layer that is lit by a cut's normal
    if _slice in chosen and overlapping:
        chosen.remove(_slice)
    for choose in chosen:
        words += choose(rng, mesh, look)
    return look, words


def triple(values):
    return ",".join(repr(float(v)) for v in values)


def camera_words(view, size):
    words = ["--size", "%dx%d" % size, *("--%s=%s" % (name, triple(view[name])) for name in ("eye", "target", "up"))]
    return words + (["--height=%r" % view["height"]] if "height" in view else ["--fov=%r" % view["fov"]])


def camera_of(view):
    return Camera(**view)
