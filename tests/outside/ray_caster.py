# SPDX-License-Identifier: Apache-2.0
"""What an image is, written down once more from the definitions alone and in another language, to hold the program's pictures to.

Nothing of the program's is used: every cell is cut by every ray through its barycentric coordinates, cells are sorted along the ray, and the
integrals are sums of Gauss-Legendre quadrature between the transfer function's nodes. Slow, and without a single shortcut.
"""
import math

import vertex_light
from vectors import along, cross, dot, sub, unit

# Gauss-Legendre, eight points on [-1, 1]: exact for polynomials of degree 15.
_POINTS = [0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363]
_WEIGHTS = [0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763]
QUADRATURE = [(0.5 + 0.5 * s * x, 0.5 * w) for x, w in zip(_POINTS, _WEIGHTS) for s in (-1, 1)]


class Camera:
    """`height` makes it orthographic, else `fov` degrees from the top to the bottom of the image."""

    def __init__(self, eye, target, up=(0, 1, 0), fov=30.0, height=None):
        self.eye, self.target, self.fov, self.height = eye, target, fov, height
        self.forward = unit(sub(target, eye))
        self.right = unit(cross(self.forward, up))
        self.up = cross(self.right, self.forward)

    def ray(self, x, y, size):
        width, height = size
        half = self.height / 2 if self.height else math.tan(math.radians(self.fov) / 2)
        across, upward = (2 * (x + 0.5) - width) / height * half, (height - 2 * (y + 0.5)) / height * half
        moved = along(along(self.eye if self.height else self.forward, across, self.right), upward, self.up)
        return (moved, self.forward) if self.height else (self.eye, unit(moved))


class Cell:
    """A tetrahedron with a linear scalar: barycentric coordinate i at p is dot(normals[i], p − corners[0]) + (1 for i = 0)."""

    def __init__(self, corners, scalars):
        self.origin, self.scalars = corners[0], scalars
        e = [sub(c, corners[0]) for c in corners[1:]]
        volume = dot(e[0], cross(e[1], e[2]))
        n = [tuple(v / volume for v in cross(e[i], e[(i + 1) % 3])) for i in (1, 2, 0)]
        self.normals = [tuple(-(n[0][k] + n[1][k] + n[2][k]) for k in range(3))] + n
        self.gradient = tuple(sum((scalars[i + 1] - scalars[0]) * n[i][k] for i in range(3)) for k in range(3))

    def interval(self, origin, d):
        enter, leave, offset = 0.0, math.inf, sub(origin, self.origin)
        for i, normal in enumerate(self.normals):
            here, slope = dot(normal, offset) + (i == 0), dot(normal, d)
            if slope > 0:
                enter = max(enter, -here / slope)
            elif slope < 0:
                leave = min(leave, -here / slope)
            elif here < 0:
                return None
        return (enter, leave) if enter < leave else None

    def coordinates(self, p):
        offset = sub(p, self.origin)
        return [dot(normal, offset) + (i == 0) for i, normal in enumerate(self.normals)]

    def scalar(self, p):
        return self.scalars[0] + dot(self.gradient, sub(p, self.origin))


class TransferFunction:
    """`description` as in a transfer function file (not normalized)."""

    def __init__(self, description):
        self.color, self.extinction = description["color"], description["extinction"]
        self.peaks = description.get("isosurfaces", [])
        self.nodes = sorted({n[0] for n in self.color} | {n[0] for n in self.extinction})

    @staticmethod
    def at(nodes, s, towards):
        """Value at s; where a node is given twice, the one on the side of `towards`."""
        if s < nodes[0][0] or (s == nodes[0][0] and towards <= s):
            return nodes[0][1:]
        for a, b in zip(nodes, nodes[1:]):
            if a[0] <= s <= b[0] and a[0] < b[0] and not (s == b[0] and towards > s) and not (s == a[0] and towards < s):
                f = (s - a[0]) / (b[0] - a[0])
                return [(1 - f) * p + f * q for p, q in zip(a[1:], b[1:])]
        return nodes[-1][1:]


def _piece(tf, front, back, length):
    """Colour and optical depth of a run between two neighbouring nodes, where colour and extinction are linear."""
    t0, t1 = tf.at(tf.extinction, front, back)[0], tf.at(tf.extinction, back, front)[0]
    c0, c1 = tf.at(tf.color, front, back), tf.at(tf.color, back, front)
    parts = max(1, math.ceil((t0 + t1) / 2 * length))  # the integrand falls by 1/e at most within a part
    color = [0.0, 0.0, 0.0]
    for k in range(parts):
        for x, weight in QUADRATURE:
            f = (k + x) / parts
            emitted = weight / parts * length * (t0 + (t1 - t0) * f) * math.exp(-length * (t0 * f + (t1 - t0) * f * f / 2))
            for i in range(3):
                color[i] += emitted * (c0[i] + (c1[i] - c0[i]) * f)
    return color, (t0 + t1) / 2 * length


def segment(tf, mode, front, back, length):
    """Colour, optical depth without the peaks, transparency of the peaks (design: "The two integrals")."""
    if mode == "scale-invariant":
        length = abs(back - front)
    crossed = [p for p in tf.peaks if (front < p["value"]) != (back < p["value"])]
    low, high = min(front, back), max(front, back)
    events = [(n, None) for n in tf.nodes if low < n < high] + [(p["value"], p) for p in crossed]
    events.sort(key=lambda e: e[0], reverse=back < front)
    color, depth, through, here = [0.0, 0.0, 0.0], 0.0, 1.0, front
    for value, peak in events + [(back, None)]:
        run = length * (abs(value - here) / abs(back - front) if back != front else 1.0)
        if run > 0:
            emitted, d = _piece(tf, here, value, run)
            for i in range(3):
                color[i] += through * math.exp(-depth) * emitted[i]
            depth += d
        here = value
        if peak:
            for i in range(3):
                color[i] += through * math.exp(-depth) * peak["opacity"] * peak["color"][i]
            through *= 1 - peak["opacity"]
    return color, depth, through


def arriving(light, place, view, from_eye):
    """Unit direction to a light and its colour after attenuation, I·f_att. `light` as in a lighting file."""
    if light["type"] == "directional":
        return unit(light["towards"]), light["color"]
    if light["type"] == "head":
        towards, distance = view, from_eye
    else:
        way = sub(light["position"], place)
        distance = math.sqrt(dot(way, way))
        towards = unit(way)
    constant, linear, quadratic = light.get("attenuation", (1, 0, 0))
    return towards, [c / (constant + distance * (linear + distance * quadratic)) for c in light["color"]]


def _lit(color, opacity, normal, d, facing, look, place, from_eye, left):
    """Equation 19, all five terms. `facing` has the sign of v·n; lights are taken at the segment's middle, `place`, where left(k, towards)
    is what of light k is left by shadows."""
    diffuse, material, view = [c / opacity for c in color], look["material"], tuple(-x for x in d)
    out = [look["ambient"][i] * color[i] for i in range(3)]
    if normal is None:
        return out
    for k, light in enumerate(look["lights"]):
        towards, intensity = arriving(light, place, view, from_eye)
        intensity = [left(k, towards) * c for c in intensity]
        side = dot(towards, normal)
        if side * facing > 0:
            seen = material["front" if facing > 0 else "back"]
            if look["reflectance"] == "blinn-phong":
                lobe = abs(dot(unit(tuple(l + v for l, v in zip(towards, view))), normal))
            else:
                lobe = dot(tuple(2 * side * n - l for n, l in zip(normal, towards)), view)
            specular = max(lobe, 0.0) ** seen["exponent"]
            term = [material["diffuse"] * diffuse[i] * abs(side) + material["specular"] * seen["specular"][i] * specular for i in range(3)]
        elif side * facing < 0:
            mean = (material["front"]["exponent"] + material["back"]["exponent"]) / 2
            specular = max(-dot(towards, view), 0.0) ** mean
            through = material["diffuse_transmission"] * abs(side) + material["specular_transmission"] * specular
            term = [(1 - opacity) * through * c for c in diffuse]
        else:
            continue
        for i in range(3):
            out[i] += intensity[i] * opacity * term[i]
    return out


def clipped(planes, layer, origin, d):
    """Where a ray is within all planes, each (point, normal to the side that stays), and up to where the normal of the one through which
    it comes in is lit: begin, end, end of the layer, that normal to the eye's side."""
    begin, end, layer_end, cut = -math.inf, math.inf, -math.inf, None
    for point, normal in planes:
        normal = unit(normal)
        inside, rate = dot(sub(origin, point), normal), dot(d, normal)
        if rate > 0 and -inside / rate > begin:
            begin, layer_end, cut = -inside / rate, (layer - inside) / rate, tuple(-n for n in normal)
        elif rate < 0:
            end = min(end, -inside / rate)
        elif rate == 0 and inside < 0:
            begin = math.inf
    return begin, end, layer_end, cut


def pieces(cells, look, origin, d):
    """The cells along a ray from front to back, as (enter, leave, cell, normal of the cut in whose layer that lies or None)."""
    begin, end, layer_end, cut = clipped(look.get("clips", []), look.get("cut_layer", 0.0), origin, d)
    met = sorted(((*interval, cell) for cell in cells if (interval := cell.interval(origin, d))), key=lambda m: m[0] + m[1])
    for enter, leave, cell in met:
        enter, leave = max(enter, begin), min(leave, end)
        middle = min(max(enter, layer_end), leave) if look["lights"] else enter
        for first, last, normal in ((enter, middle, cut), (middle, leave, None)):
            if first < last:
                yield first, last, cell, normal


def pixel(cells, camera, tf, mode, look, x, y, size):
    """Premultiplied (r, g, b, a) over nothing. `look`: a lighting file with every key there, "silhouette", and what is cut off."""
    origin, d = camera.ray(x, y, size)
    color, transparency = [0.0, 0.0, 0.0], 1.0
    for enter, leave, cell, cut in pieces(cells, look, origin, d):
        front, back = cell.scalar(along(origin, enter, d)), cell.scalar(along(origin, leave, d))
        emitted, depth, through = segment(tf, mode, front, back, leave - enter)
        opacity = 1 - math.exp(-depth) * through
        if opacity <= 0:
            continue
        size_of_gradient = math.sqrt(dot(cell.gradient, cell.gradient))
        middle = (enter + leave) / 2
        place, gradient = along(origin, middle, d), cell.gradient
        if look.get("normals") == "smooth":
            gradient = vertex_light.smooth_gradient(cell, place)
            size_of_gradient = math.sqrt(dot(gradient, gradient))
        slope = dot(gradient, d)
        if look["silhouette"] and slope != 0:
            k = size_of_gradient / abs(slope)
            if mode == "scale-invariant" and front != back:  # the depth as that of a segment with this gradient
                depth *= abs(slope) * (leave - enter) / abs(back - front)
            enhanced = 1 - math.exp(-k * depth) * through**k
            emitted = [c * enhanced / opacity for c in emitted]
            opacity = enhanced
        if look["lights"]:
            normal, facing = unit(gradient) if size_of_gradient > 0 else None, (front > back) - (front < back)
            if cut:
                normal, facing = cut, 1
            left = lambda k, towards: vertex_light.light_left(cell, tf, k, towards, place, front, back) if look.get("shadows") else 1.0
            emitted = _lit(emitted, opacity, normal, d, facing, look, place, middle, left)
        for i in range(3):
            color[i] += transparency * emitted[i]
        transparency *= 1 - opacity
    return (*color, 1 - transparency)
