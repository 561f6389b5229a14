# SPDX-License-Identifier: Apache-2.0
"""Meshes of tetrahedra of the kinds that people bring, drawn at random: `KINDS` by name, each a function of a numpy random generator that
gives points and cells."""
import itertools

import numpy as np

FIVE = (((0, 1, 2, 4), (1, 3, 2, 7), (1, 2, 4, 7), (1, 4, 5, 7), (2, 6, 4, 7)), ((1, 0, 3, 5), (0, 2, 3, 6), (0, 3, 5, 6), (0, 5, 4, 6), (3, 5, 6, 7)))
SIX = tuple(tuple(sum(1 << a for a in order[:k]) for k in range(4)) for order in itertools.permutations(range(3)))


def lattice(nx, ny, nz, six=False):
    """Points at whole numbers and the cubes between them in five tetrahedra each, or six."""
    z, y, x = (v.reshape(-1) for v in np.mgrid[0:nz, 0:ny, 0:nx])
    cells = []
    for k, j, i in itertools.product(range(nz - 1), range(ny - 1), range(nx - 1)):
        corner = [(i + (c & 1)) + nx * ((j + (c >> 1 & 1)) + ny * (k + (c >> 2))) for c in range(8)]
        cells += [[corner[c] for c in tet] for tet in (SIX if six else FIVE[(i + j + k) % 2])]
    return np.column_stack([x, y, z]).astype(float), np.array(cells)


def sides(rng, most=5):
    return [int(n) for n in rng.integers(2, most, 3)]


def unit_cube(rng, most=5, six=False):
    n = sides(rng, most)
    points, cells = lattice(*n, six)
    return points / (np.array(n) - 1), cells


def used(points, cells):
    kept, numbers = np.unique(cells, return_inverse=True)
    return points[kept], numbers.reshape(-1, 4)


def volumes(points, cells):
    a, b, c, d = (points[cells[:, k]] for k in range(4))
    return ((b - a) * np.cross(c - a, d - a)).sum(1)


def whole(points, cells, least=1e-9):
    """Without cells that have hardly a volume (a grid that was moved may turn some of them over: they stay)."""
    size = np.ptp(points[cells], axis=1).max(1)
    return used(points, cells[np.abs(volumes(points, cells)) > least * size**3])


def jitter(rng, points, amount):
    return points + rng.uniform(-amount, amount, points.shape)


def grid(rng):
    return unit_cube(rng)


def kuhn_grid(rng):
    return unit_cube(rng, six=True)


def jittered(rng):
    points, cells = unit_cube(rng, six=bool(rng.integers(2)))
    return jitter(rng, points, 0.05), cells


def delaunay(rng):
    """Bowyer and Watson's insertion of random points."""
    count = int(rng.integers(6, 26))
    points = np.concatenate([rng.random((count, 3)), np.array([[-50, -50, -50], [150, -50, -50], [-50, 150, -50], [-50, -50, 150]], float)])
    cells = [tuple(range(count, count + 4))]
    for p in range(count):
        corners = points[np.array(cells)]
        a = corners[:, 1:] - corners[:, :1]
        centre = np.linalg.solve(2 * a, (a * a).sum(2)[..., None])[..., 0]
        bad = ((points[p] - corners[:, 0] - centre) ** 2).sum(1) < (centre**2).sum(1)
        faces = {}
        for cell, gone in zip(cells, bad):
            for face in itertools.combinations(sorted(cell), 3):
                faces[face] = faces.get(face, 0) + bool(gone)
        cells = [c for c, gone in zip(cells, bad) if not gone] + [(*f, p) for f, n in faces.items() if n == 1]
    cells = np.array([c for c in cells if max(c) < count])
    return whole(points, cells, 1e-7)


def slivers(rng):
    points, cells = unit_cube(rng)
    points = jitter(rng, points, 0.02)
    moved = rng.random(len(points)) < 0.3
    targets = rng.integers(0, len(points), len(points))
    near = 10.0 ** rng.uniform(-6, -2)
    points = np.where(moved[:, None], points[targets] + near * (points - points[targets]), points)
    return whole(points, cells, 1e-12)


def flat_layers(rng):
    n = [int(v) for v in rng.integers(2, 5, 3)]
    points, cells = lattice(*n, six=bool(rng.integers(2)))
    points = points / (np.array(n) - 1)
    points[:, :2] = jitter(rng, points, 0.04)[:, :2]
    return points * np.array([1.0, 1.0, 10.0 ** rng.uniform(-5, -1)]), cells


def nonconvex(rng):
    n = [3, 3, int(rng.integers(2, 4))]
    points, cells = lattice(*n)
    middle = points[cells].mean(1)
    points, cells = used(points, cells[~((middle[:, 0] > 1) & (middle[:, 1] > 1))])
    return jitter(rng, points / 2, 0.03 * rng.integers(2)), cells


def cheese(rng):
    points, cells = unit_cube(rng, six=bool(rng.integers(2)))
    points = jitter(rng, points, 0.06)
    kept = rng.random(len(cells)) < rng.uniform(0.3, 0.9)
    kept[0] = True
    return used(points, cells[kept])


def disconnected(rng):
    p, c = unit_cube(rng, 3)
    q, d = unit_cube(rng, 4)
    shift = (np.array([1.0, 1.0, 1.0]), np.array([1.3, 0.2, 0.1]), np.array([0.0, 0.0, 1.5]))[rng.integers(3)]  # the first: corner to corner
    return np.concatenate([p, q + shift]), np.concatenate([c, d + len(p)])


def twisted_ring(rng):
    """A ring of beams, each over the next at one end and under it at the other: no order from far to near exists."""
    count, points, cells = int(rng.integers(3, 7)), [], []
    lift = rng.uniform(0.15, 0.35)
    for k in range(count):
        a, b = 2 * np.pi * k / count, 2 * np.pi * (k + 1.35) / count
        begin, end = np.array([np.cos(a), np.sin(a), -lift]), np.array([np.cos(b), np.sin(b), lift])
        out = np.array([np.cos((a + b) / 2), np.sin((a + b) / 2), 0]) * 0.3
        points += [begin, begin + out, end, end + out + np.array([0, 0, 0.06])]
        cells.append([4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3])
    return np.array(points), np.array(cells)


def nonconforming(rng):
    """Grids of different spacing side by side: corners of one stand in faces of the other."""
    p, c = lattice(2, 2, 2)
    q, d = lattice(3, 3, 3)
    return np.concatenate([p, q / 2 + np.array([1.0, 0, 0])]), np.concatenate([c, d + len(p)])


def overlapping(rng):
    p, c = unit_cube(rng, 4)
    q, d = unit_cube(rng, 4)
    return np.concatenate([jitter(rng, p, 0.02), jitter(rng, q, 0.02) + rng.uniform(0.1, 0.7, 3)]), np.concatenate([c, d + len(p)])


def stretched(rng):
    points, cells = unit_cube(rng)
    return jitter(rng, points, 0.04) * 10.0 ** rng.uniform(-2, 2, 3), cells


def tiny_or_huge(rng):
    points, cells = jittered(rng)
    return points * 10.0 ** rng.integers(-9, 10) , cells


def far_from_origin(rng):
    points, cells = jittered(rng)
    return points + 10.0 ** rng.uniform(1, 5) * rng.choice([-1.0, 1.0], 3), cells


def single(rng):
    if rng.integers(2):
        points, cells = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.0]]), np.array([[0, 1, 2, 3], [1, 2, 3, 4]])
    else:
        points, cells = rng.random((4, 3)), np.array([[0, 1, 2, 3]])
    points, cells = used(points, cells[: rng.integers(1, len(cells) + 1)])
    return points, cells


KINDS = {f.__name__: f for f in (grid, kuhn_grid, jittered, delaunay, slivers, flat_layers, nonconvex, cheese, disconnected, twisted_ring,
                                 nonconforming, overlapping, stretched, tiny_or_huge, far_from_origin, single)}


def random_mesh(rng, kind):
    points, cells = KINDS[kind](rng)
    if kind not in ("tiny_or_huge", "far_from_origin", "stretched") and rng.integers(4) == 0:  # no axis of the mesh is one of space
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        points = points @ turn.T
    return points, cells
