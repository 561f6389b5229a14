# SPDX-License-Identifier: Apache-2.0
"""What vertices carry for light, once more from the definitions (projection/modes.md): transmittance to the lights, by brute force, and
gradients fitted to their neighbours. `carry` gives it to every Cell of ray_caster.py, corner by corner; the functions behind read it at a
place in a cell.
"""
import math

from vectors import along, cross, dot, sub, unit

BESIDE = 1e-7  # how far from a vertex, within its largest cell, lines to lights begin: beside every face and edge


def carry(points, scalars, tetrahedra, cells, tf, mode, look):
    if look.get("shadows"):
        _carry_shadows(points, tetrahedra, cells, tf, mode, look["lights"])
    if look.get("normals") == "smooth":
        gradients = _gradients(points, scalars, tetrahedra)
        for tet, cell in zip(tetrahedra, cells):
            cell.gradients = [gradients[i] for i in tet]


def smooth_gradient(cell, place):
    weights = cell.coordinates(place)
    return tuple(sum(w * g[k] for w, g in zip(weights, cell.gradients)) for k in range(3))


def light_left(cell, tf, k, towards, place, front, back):
    """Of light k at the middle `place` of a segment: what the corners carry, and the cell's isosurfaces that stand beyond both ends."""
    left = sum(w * t for w, t in zip(cell.coordinates(place), cell.shadows[k]))
    rises = dot(cell.gradient, towards) > 0
    for peak in _surfaces_in(cell, tf):
        if (front < peak["value"]) == (back < peak["value"]) == rises:
            left *= 1 - peak["opacity"]
    return left


def _extinction_integral(tf, front, back):
    """∫ τ ds from the lower to the higher of two scalars; τ is linear between nodes."""
    low, high = min(front, back), max(front, back)
    scalars = [low] + [n for n in tf.nodes if low < n < high] + [high]
    return sum((tf.at(tf.extinction, a, b)[0] + tf.at(tf.extinction, b, a)[0]) / 2 * (b - a) for a, b in zip(scalars, scalars[1:]))


def _transmittance(cells, tf, mode, start, d, reach, passed):
    """From `start` as far as `reach`; the first crossing of each of the isosurfaces `passed` does not count."""
    depth, through, waiting = 0.0, 1.0, list(passed)
    met = sorted(((*interval, cell) for cell in cells if (interval := cell.interval(start, d))), key=lambda m: m[0])
    for enter, leave, cell in met:
        leave = min(leave, reach)
        if not enter < leave:
            continue
        front, back = cell.scalar(along(start, enter, d)), cell.scalar(along(start, leave, d))
        per_length = 1.0 if mode == "scale-invariant" else (leave - enter) / abs(back - front)
        depth += _extinction_integral(tf, front, back) * per_length
        for peak in sorted(tf.peaks, key=lambda p: p["value"], reverse=back < front):
            if (front < peak["value"]) == (back < peak["value"]):
                continue
            if peak in waiting:
                waiting.remove(peak)
            else:
                through *= 1 - peak["opacity"]
    return math.exp(-depth) * through


def _way_to(light, place):
    """Unit direction and distance to a light at infinity or at a place."""
    if light["type"] == "directional":
        return unit(light["towards"]), math.inf
    way = sub(light["position"], place)
    return unit(way), math.sqrt(dot(way, way))


def _surfaces_in(cell, tf):
    low, high = min(cell.scalars), max(cell.scalars)
    return [p for p in tf.peaks if low < p["value"] <= high]


def _carry_shadows(points, tetrahedra, cells, tf, mode, lights):
    """Sets cell.shadows[light][corner]: what comes to the corners; isosurfaces of the cell that stand before a corner do not count there."""
    largest, known = {}, {}
    for tet, cell in zip(tetrahedra, cells):
        a, b, c, d = (points[i] for i in tet)
        volume = abs(dot(sub(b, a), cross(sub(c, a), sub(d, a))))
        for i in tet:
            if volume > largest.get(i, (0,))[0]:
                largest[i] = volume, tuple(sum(points[j][k] for j in tet) / 4 for k in range(3))

    def at(i, k, passed):
        key = i, k, tuple(p["value"] for p in passed)
        if key not in known:
            start = along(points[i], BESIDE, unit(sub(largest[i][1], points[i])))
            known[key] = _transmittance(cells, tf, mode, start, *_way_to(lights[k], points[i]), passed)
        return known[key]

    for tet, cell in zip(tetrahedra, cells):
        middle = tuple(sum(points[j][k] for j in tet) / 4 for k in range(3))
        cell.shadows = []
        for k, light in enumerate(lights):
            if light["type"] == "head":
                cell.shadows.append([1.0] * 4)
                continue
            rises = dot(cell.gradient, _way_to(light, middle)[0]) > 0
            behind = lambda s: [p for p in _surfaces_in(cell, tf) if (s < p["value"]) == rises]
            cell.shadows.append([at(i, k, behind(s)) for i, s in zip(tet, cell.scalars)])


def _gradients(points, scalars, tetrahedra):
    """At every vertex g of the least Σ (g·d − Δs)²/|d|² over its neighbours, one for each cell that they share."""
    gradients = {}
    rows = {}
    for tet in tetrahedra:
        for i in tet:
            rows.setdefault(i, []).extend(j for j in tet if j != i)
    for i, neighbours in rows.items():
        m, r = [[0.0] * 3 for _ in range(3)], [0.0] * 3
        for j in neighbours:
            d = sub(points[j], points[i])
            weight = 1 / dot(d, d)
            for p in range(3):
                r[p] += weight * d[p] * (scalars[j] - scalars[i])
                for q in range(3):
                    m[p][q] += weight * d[p] * d[q]
        whole = dot(m[0], cross(m[1], m[2]))
        gradients[i] = tuple(dot(r, cross(m[(k + 1) % 3], m[(k + 2) % 3])) / whole for k in range(3))
    return gradients
