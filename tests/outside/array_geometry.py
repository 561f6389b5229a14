# SPDX-License-Identifier: Apache-2.0
"""Rays through tetrahedra, many at once, in extended precision: where each ray enters and leaves each cell, and the scalars there.

On which side of a ray an edge passes is computed once per edge, and where it meets a face once per face, so two cells that share a face
agree about it to the bit: no ray slips through a seam, and an isosurface on a face is crossed in exactly one of them.
"""
import numpy as np

REAL = np.longdouble  # 64 bits of mantissa on x86: rounding is 2000 times finer than that of what is tested


class Camera:
    """`height` makes it orthographic, else `fov` degrees from the top to the bottom of the picture."""

    def __init__(self, eye, target, up=(0.0, 1.0, 0.0), fov=30.0, height=None):
        self.eye, self.target, self.up = (np.array(v, REAL) for v in (eye, target, up))
        self.fov, self.height = fov, height
        self.forward = unit(self.target - self.eye)
        self.right = unit(np.cross(self.forward, self.up))
        self.upward = np.cross(self.right, self.forward)

    def rays(self, size, offset=(0.0, 0.0)):
        """Origins and unit directions of the pixels, row by row from the top, `offset` pixels beside their centres."""
        width, height = size
        y, x = np.mgrid[0:height, 0:width].astype(REAL)
        half = REAL(self.height) / 2 if self.height else np.tan(np.pi * REAL(self.fov) / 360)
        across = ((2 * (x + 0.5 + REAL(offset[0])) - width) / height * half).reshape(-1, 1)
        upward = ((height - 2 * (y + 0.5 + REAL(offset[1]))) / height * half).reshape(-1, 1)
        moved = across * self.right + upward * self.upward
        if self.height:
            return self.eye + moved, np.broadcast_to(self.forward, moved.shape)
        return np.broadcast_to(self.eye, moved.shape), unit(self.forward + moved)

    def pixel_at(self, distance, size):
        """Width of a pixel at a distance from the eye."""
        return float(self.height if self.height else 2 * distance * np.tan(np.pi * self.fov / 360)) / size[1]


def unit(v):
    return v / np.sqrt((v * v).sum(-1, keepdims=True))


def dot(a, b):
    return (a * b).sum(-1)


class Mesh:
    """Tetrahedra with scalars of points, or of cells."""

    def __init__(self, points, cells, point_scalars=None, cell_scalars=None):
        self.points, self.cells = np.array(points, np.float64), np.array(cells, np.int64)
        self.point_scalars = None if point_scalars is None else np.array(point_scalars, np.float64)
        self.cell_scalars = None if cell_scalars is None else np.array(cell_scalars, np.float64)
        corners = np.sort(self.cells, axis=1)
        faces = corners[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]]  # k is opposite to corner k
        self.faces, numbers = np.unique(faces.reshape(-1, 3), axis=0, return_inverse=True)
        self.cell_faces = numbers.reshape(-1, 4)
        edges = self.faces[:, [[1, 2], [2, 0], [0, 1]]]
        self.edges, numbers = np.unique(np.sort(edges.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
        self.face_edges = numbers.reshape(-1, 3)
        self.edge_turn = np.where(edges[..., 0] < edges[..., 1], 1, -1)
        p = self.points.astype(REAL)
        a, b, c = (p[faces[..., k]] for k in range(3))
        volumes = dot(p[corners] - a, np.cross(b - a, c - a))
        self.outward = np.where(volumes > 0, -1, 1)  # whether the sorted face turns its back on the opposite corner
        self.size = float((p.max(0) - p.min(0)).max())
        self.reach = float(np.abs(p).max())

    def corner_scalars(self):
        if self.cell_scalars is not None:
            return np.repeat(self.cell_scalars[:, None], 4, axis=1)
        return self.point_scalars[self.cells]

    def gradients(self):
        p, s = self.points.astype(REAL)[self.cells], self.corner_scalars().astype(REAL)
        e, ds = p[:, 1:] - p[:, :1], s[:, 1:] - s[:, :1]
        n = np.stack([np.cross(e[:, 1], e[:, 2]), np.cross(e[:, 2], e[:, 0]), np.cross(e[:, 0], e[:, 1])], axis=1)
        return (ds[..., None] * n).sum(1) / dot(e[:, 0], n[:, 0])[:, None]

    def bounding_sphere(self):
        low, high = self.points.min(0), self.points.max(0)
        return (low + high) / 2, float(np.sqrt(((high - low) ** 2).sum()) / 2)

    def diagonal(self):
        return 2 * self.bounding_sphere()[1]

    def scalar_range(self):
        s = self.point_scalars if self.cell_scalars is None else self.cell_scalars
        return float(s.min()), float(s.max())


class Segments:
    """What rays and cells have in common: parallel arrays."""

    names = ("ray", "cell", "t_in", "t_out", "s_in", "s_out")

    def __init__(self, *arrays):
        for name, array in zip(self.names, arrays):
            setattr(self, name, array)

    def where(self, which):
        return Segments(*(getattr(self, name)[which] for name in self.names))

    def joined(self, other):
        return Segments(*(np.concatenate([getattr(self, name), getattr(other, name)]) for name in self.names))

    def limited(self, nearest, farthest):
        """Cut to distances between two, each one number per segment. An end that is not cut keeps its bits."""
        t_in, t_out = np.maximum(self.t_in, nearest), np.minimum(self.t_out, farthest)
        cut = Segments(self.ray, self.cell, t_in, t_out, self.s_in, self.s_out)
        for end, t, moved in (("s_in", t_in, t_in > self.t_in), ("s_out", t_out, t_out < self.t_out)):
            inside = moved & (t_out > t_in)
            share = (t - self.t_in)[inside] / (self.t_out - self.t_in)[inside]
            value = getattr(self, end).copy()
            value[inside] = self.s_in[inside] + (self.s_out - self.s_in)[inside] * share
            setattr(cut, end, value)
        return cut.where(t_out > t_in)


def across_rays(points, origins, directions):
    """The points' coordinates beside each ray, and along it: (rays, points) each."""
    axis = np.abs(directions).argmin(1)
    beside = unit(np.cross(directions, np.eye(3, dtype=REAL)[axis]))
    above = np.cross(directions, beside)
    way = points[None, :, :] - origins[:, None, :]
    return tuple(sum(way[..., k] * v[:, None, k] for k in range(3)) for v in (beside, above, directions))


def segments_of(mesh, origins, directions):
    """All segments at distances t >= 0. `t` and `s` are in extended precision.

    Rays are moved aside by a hundredth of what double precision can tell of the points: where a ray meets an edge exactly it is on one
    side of it then, the same for all cells. What remains of cells that were only touched is shorter than that by far, and left out.
    """
    moved = REAL(1e-18) * (mesh.reach + float(np.abs(origins).max()))
    x, y, t = across_rays(mesh.points.astype(REAL), origins, directions)
    x, y = x + REAL(0.7310585) * moved, y + REAL(0.4142136) * moved
    a, b = mesh.edges.T
    side = x[:, a] * y[:, b] - y[:, a] * x[:, b]
    weights = side[:, mesh.face_edges] * mesh.edge_turn
    turn = np.where((weights > 0).all(-1), 1, np.where((weights < 0).all(-1), -1, 0))
    met = turn[:, mesh.cell_faces] * mesh.outward
    ray, cell = np.nonzero((met > 0).any(-1) & (met < 0).any(-1))
    ends = []
    for sign in (-1, 1):  # enters, leaves
        face = mesh.cell_faces[cell, (met[ray, cell] == sign).argmax(1)]
        w = weights[ray, face]
        w = w / w.sum(1, keepdims=True)
        corners = mesh.faces[face]
        at = dot(w, t[ray[:, None], corners])
        if mesh.cell_scalars is not None:
            value = mesh.cell_scalars[cell].astype(REAL)
        else:
            s = mesh.point_scalars.astype(REAL)[corners]
            value = s[:, 0] + w[:, 1] * (s[:, 1] - s[:, 0]) + w[:, 2] * (s[:, 2] - s[:, 0])
        ends.append((at, value))
    (t0, s0), (t1, s1) = ends
    found = Segments(ray, cell, t0, t1, s0, s1)
    touch = 1e-15 * mesh.size + 1e4 * float(moved)  # where faces graze a ray they are that much longer than it was moved
    found = found.where((found.t_out - found.t_in > touch) & (found.t_out > touch))
    return found.limited(REAL(0), REAL(np.inf))
