# SPDX-License-Identifier: Apache-2.0
"""Pictures straight from the definition of an image and of the modes, in numpy, with nothing of the program's.

`picture` takes a mesh (array_geometry.Mesh), a transfer function (array_transfer.TransferFunction), a camera and a Look, and gives linear
premultiplied RGBA over nothing in double precision. Where a ray runs within rounding of an edge the definition itself may jump:
`pictures` gives several pictures whose rays stand a billionth of a pixel beside each other, which tells where.
"""
from dataclasses import dataclass, field
from typing import Optional

import numpy as np

from array_geometry import REAL, dot, segments_of, unit
from array_transfer import Integrals

ADDING = ("additive", "additive-scale-invariant", "emission")
OVER_SCALAR = ("scale-invariant", "additive-scale-invariant")


@dataclass
class Look:
    """Everything besides mesh, function and camera. Vectors are triples in mesh units."""

    mode: str = "standard"
    classification: str = "preintegrated"
    silhouette: Optional[str] = None  # exact, approximate
    gradient_opacity: float = 0.0
    lights: list = field(default_factory=list)  # unit vectors towards them, or "head"
    point_lights: list = field(default_factory=list)  # positions
    ambient: float = 0.1
    exponent: float = 32.0
    transmission: bool = True
    depth_color: Optional[tuple] = None  # r, g, b, strength
    half_spaces: list = field(default_factory=list)  # (point, normal): what is shown
    slices: list = field(default_factory=list)  # (point, normal, opacity)


def unit_double(v):
    v = np.array(v, float)
    return v / np.sqrt((v * v).sum())


def pictures(mesh, function, camera, look, size):
    """One picture per way of standing beside the pixels' centres: (ways, height·width, 4)."""
    aside = 1e-9 + 64 * 2e-16 * (mesh.reach + float(np.abs(camera.eye).max())) / camera.pixel_at(distance_to(mesh, camera), size)
    ways = [(0.0, 0.0), (0.9 * aside, 0.5 * aside), (-0.6 * aside, -0.8 * aside)]
    rays = [camera.rays(size, way) for way in ways]
    origins, directions = (np.concatenate([r[k] for r in rays]) for k in (0, 1))
    result = picture(mesh, function, camera, look, origins, directions)
    return result.reshape(len(ways), -1, 4)


def distance_to(mesh, camera):
    centre, radius = mesh.bounding_sphere()
    return max(float(np.sqrt(((camera.eye - centre) ** 2).sum())), 1e-3 * radius)


def picture(mesh, function, camera, look, origins, directions):
    segments = segments_of(mesh, origins, directions)
    if look.half_spaces:
        nearest, farthest = clip_interval(look.half_spaces, origins, directions)
        segments = segments.limited(nearest[segments.ray], farthest[segments.ray])
    rays = len(origins)
    if look.mode in ("mip", "minimum", "average"):
        return order_free(function, look.mode, segments, rays)
    slices = [slice_hits(segments, s, origins, directions, function) for s in look.slices]
    for t, *_ in slices:
        at = t[segments.ray]
        segments = segments.limited(-np.inf, at).joined(segments.limited(np.where(np.isfinite(at), at, np.inf), np.inf))
    depths = depth_range(mesh, camera)
    if look.mode == "depth":
        return first_distance(function, segments, depths, rays)
    color, opacity, depth = shaded(mesh, function, look, segments, origins, directions, depths)
    if look.mode in ADDING:
        return np.column_stack([np.column_stack([sums(segments.ray, color[:, k], rays) for k in range(3)]),
                                0 * sums(segments.ray, depth, rays) if look.mode == "emission"
                                else np.minimum(1.0, sums(segments.ray, depth, rays))])
    if look.mode == "absorption":
        color = np.zeros_like(color)
    if look.mode == "first-hit":
        color, opacity = color / np.where(opacity > 0, opacity, 1)[:, None], np.where(opacity > 0, 1.0, 0.0)
    entries = [(segments.ray, segments.t_in, segments.t_out, color, opacity)]
    entries += [(r, t[r], t[r], o[:, None] * c, o) for t, r, c, o in slices]
    return composited(*(np.concatenate(parts) for parts in zip(*entries)), rays)


def clip_interval(half_spaces, origins, directions):
    nearest, farthest = np.zeros(len(origins), REAL), np.full(len(origins), REAL(np.inf))
    for point, normal in half_spaces:
        n = np.array(normal, REAL)
        slope, height = directions @ n, (origins - np.array(point, REAL)) @ n
        with np.errstate(divide="ignore", invalid="ignore"):
            t = -height / slope
        nearest = np.where(slope > 0, np.maximum(nearest, t), nearest)
        farthest = np.where(slope < 0, np.minimum(farthest, t), farthest)
        farthest = np.where((slope == 0) & (height < 0), REAL(-1), farthest)
    return nearest, farthest


def slice_hits(segments, one, origins, directions, function):
    """Distance of each ray to the slice (infinite where it does not meet it in the mesh), rays that meet it, colours, opacities."""
    point, normal, opacity = one
    n = np.array(normal, REAL)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = -((origins - np.array(point, REAL)) @ n) / (directions @ n)
    at = t[segments.ray]
    inside = segments.where((segments.t_in <= at) & (at < segments.t_out))
    at = t[inside.ray]
    s = inside.s_in + (inside.s_out - inside.s_in) * ((at - inside.t_in) / (inside.t_out - inside.t_in))
    ray, first = np.unique(inside.ray, return_index=True)
    distances = np.full(len(origins), REAL(np.inf))
    distances[ray] = t[ray]
    color = function.at(s[first].astype(float))[1]
    return distances, ray, color, np.full(len(ray), float(opacity))


def depth_range(mesh, camera):
    centre, radius = mesh.bounding_sphere()
    way = centre - camera.eye
    distance = float(dot(way, camera.forward)) if camera.height else float(np.sqrt(dot(way, way)))
    return max(distance - radius, 0.0), max(distance + radius, 0.0)


def sums(ray, values, rays):
    return np.bincount(ray, weights=values, minlength=rays)


def order_free(function, mode, segments, rays):
    lengths = (segments.t_out - segments.t_in).astype(float)
    total = sums(segments.ray, lengths, rays)
    if mode == "average":
        s = sums(segments.ray, (0.5 * segments.s_in + 0.5 * segments.s_out).astype(float) * lengths, rays) / np.where(total > 0, total, 1)
    else:
        gather = np.maximum if mode == "mip" else np.minimum
        s = np.full(rays, -np.inf if mode == "mip" else np.inf)
        for ends in (segments.s_in, segments.s_out):
            gather.at(s, segments.ray, ends.astype(float))
    met = np.bincount(segments.ray, minlength=rays) > 0
    color = function.at(np.where(met, s, 0.0))[1]
    return np.where(met[:, None], np.column_stack([color, np.ones(rays)]), 0.0)


def integrals(function, look, segments):
    s_in, s_out = segments.s_in.astype(float), segments.s_out.astype(float)
    length = (segments.t_out - segments.t_in).astype(float)
    variation = np.abs((segments.s_out - segments.s_in).astype(float))
    path = variation if look.mode in OVER_SCALAR else length
    return Integrals(function, s_in, s_out, length, path, hides=look.mode not in ADDING), path, length, variation


def first_distance(function, segments, depths, rays):
    found, *_ = integrals(function, Look(mode="standard"), segments)
    t = segments.t_in + (segments.t_out - segments.t_in) * found.first.clip(0, 1)
    nearest = np.full(rays, REAL(np.inf))
    shows = np.isfinite(found.first)
    np.minimum.at(nearest, segments.ray[shows], t[shows])
    met = np.isfinite(nearest)
    grey = (depths[1] - np.where(met, nearest, 0).astype(float)) / (depths[1] - depths[0])
    return np.where(met[:, None], np.column_stack([grey, grey, grey, np.ones(rays)]), 0.0)


def middle_of(segments, origins, directions):
    at = 0.5 * segments.t_in + 0.5 * segments.t_out
    return at, origins[segments.ray] + at[:, None] * directions[segments.ray]


def sampled(mesh, function, look, segments, middle):
    """Extinction and colour of a classification that takes one sample in the middle of a segment."""
    if look.classification != "pre":
        return function.at((0.5 * segments.s_in + 0.5 * segments.s_out).astype(float))
    tau, color = function.at(mesh.corner_scalars())
    p = mesh.points.astype(REAL)[mesh.cells[segments.cell]]
    weights = []
    for k in range(4):
        q = p.copy()
        q[:, k] = middle
        weights.append(dot(q[:, 1] - q[:, 0], np.cross(q[:, 2] - q[:, 0], q[:, 3] - q[:, 0])))
    weights = np.stack(weights, 1)
    weights = (weights / dot(p[:, 1] - p[:, 0], np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 0]))[:, None]).astype(float)
    return (weights * tau[segments.cell]).sum(1), (weights[..., None] * color[segments.cell]).sum(1)


def shaded(mesh, function, look, segments, origins, directions, depths):
    """Premultiplied colour, opacity and depth of each segment after silhouette, light and depth-based colouring."""
    at, middle = middle_of(segments, origins, directions)
    direction = directions[segments.ray]
    adds = look.mode in ADDING
    found, path, length, variation = integrals(function, look, segments)
    gradient = mesh.gradients()[segments.cell]
    steepness = np.sqrt(dot(gradient, gradient))
    has_slope = steepness > 0
    normal = np.where(has_slope[:, None], gradient / np.where(has_slope, steepness, 1)[:, None], 0)
    cosine = dot(normal, direction).astype(float)
    steepness = steepness.astype(float)
    factor = 1.0
    if look.gradient_opacity > 0:  # Kraus 2005, Equation 18
        low, high = mesh.scalar_range()
        factor = look.gradient_opacity * steepness * mesh.diagonal() / ((high - low) if high > low else 1.0)
    if look.classification == "preintegrated":
        smooth, peaks = found.smooth * factor, found.peak_depth
        peaks = np.where(peaks > 0, peaks * factor, 0.0)
        plain = -np.expm1(-(found.smooth + found.peak_depth)) if not adds else found.smooth + found.peak_depth
        mean = found.color / np.where(plain > 0, plain, 1)[:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            extinction = np.where(variation > 0, found.smooth / variation, 0.0)
        level = variation == 0
        tau, color = function.at(segments.s_in.astype(float))
        extinction = np.where(level, tau, extinction)
    else:
        extinction, mean = sampled(mesh, function, look, segments, middle)
        extinction = np.maximum(extinction, 0.0)
        smooth, peaks = extinction * path * factor, np.zeros(len(path))
        level, color = variation == 0, mean
    if look.classification == "post-linear":
        bend = _linear_bend(smooth)
        smooth = smooth * bend
    else:
        bend = 1.0
    depth = smooth + peaks
    opacity = -np.expm1(-depth)
    if look.silhouette:
        depth, opacity, mean = _silhouetted(look, smooth, peaks, bend, extinction * factor, steepness * length, cosine, has_slope,
                                            np.where((level & has_slope)[:, None] & (look.mode in OVER_SCALAR), color, mean))
    mean = mean if not (look.lights or look.point_lights) else lit(look, mean, opacity, normal, direction, cosine, middle, has_slope)
    if look.depth_color:
        share = np.clip((at.astype(float) - depths[0]) / (depths[1] - depths[0]), 0, 1) * look.depth_color[3]
        mean = mean * (1 - share)[:, None] + share[:, None] * np.array(look.depth_color[:3])
    weight = depth if adds else opacity
    weighted = np.where(weight[:, None] > 0, mean * np.where(np.isfinite(weight), weight, 1)[:, None], 0)
    return weighted, opacity, depth


def _linear_bend(depth):
    """−ln(1 − min(1, D))/D: what makes of a depth D one whose exponential opacity is min(1, D)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(depth > 1e-8, -np.log1p(-np.minimum(depth, 1.0)) / depth, 1.0)


def _silhouetted(look, smooth, peaks, bend, extinction, rise, cosine, has_slope, mean):
    """Kraus 2005, Equations 15 to 17, in the form that stays finite where the gradient is across the ray."""
    with np.errstate(divide="ignore", invalid="ignore"):
        k = 1 / np.abs(cosine)
        if look.mode in OVER_SCALAR:
            raised = np.where(extinction > 0, bend * extinction * rise, 0.0)
            raised = raised + np.where(peaks > 0, peaks * k, 0.0)
        else:
            raised = np.where(smooth + peaks > 0, (smooth + peaks) * k, 0.0)
        raised = np.where(has_slope, raised, smooth + peaks)
        if look.silhouette == "exact":
            return raised, -np.expm1(-raised), mean
        plain = smooth + peaks
        per_depth = np.where(plain > 1e-12, -np.expm1(-plain) / np.where(plain > 0, plain, 1), 1.0)
        per_depth = np.where(np.isinf(plain), 0.0, per_depth)
        opacity = np.where(np.isinf(plain), 1.0, np.minimum(1.0, per_depth * raised))
    return raised, np.where(has_slope, opacity, -np.expm1(-plain)), mean


def lit(look, mean, opacity, normal, direction, cosine, middle, has_slope):
    """Equation 19 per unit of α: lights of intensity 1, C_spec = 1, transmission in the colour of the material."""
    normal, view = normal.astype(float), -direction.astype(float)
    out = look.ambient * mean
    for light in list(look.lights) + [("point", p) for p in look.point_lights]:
        if isinstance(light, str):
            towards = view
        elif light[0] == "point":
            towards = unit(np.array(light[1], float) - middle.astype(float))
        else:
            towards = np.broadcast_to(np.array(light, float), view.shape)
        side = dot(towards, normal)
        facing = side * -cosine
        mirrored = 2 * side[:, None] * normal - towards
        shine = np.maximum(dot(mirrored, view), 0.0) ** look.exponent
        through = np.maximum(-dot(towards, view), 0.0) ** look.exponent
        reflected = mean * np.abs(side)[:, None] + shine[:, None]
        passed = mean * (np.abs(side) + through)[:, None] * ((1 - opacity) * look.transmission)[:, None]
        out = out + np.where((facing > 0)[:, None], reflected, np.where((facing < 0)[:, None], passed, 0.0))
    return out


def composited(ray, t_in, t_out, color, opacity, rays):
    order = np.lexsort((t_out, t_in, ray))
    ray, color, opacity = ray[order], color[order], opacity[order]
    place = np.arange(len(ray)) - np.searchsorted(ray, np.arange(rays))[ray]
    result, through = np.zeros((rays, 3)), np.ones(rays)
    for k in range(int(place.max()) + 1 if len(place) else 0):
        now = place == k
        result[ray[now]] += through[ray[now]][:, None] * color[now]
        through[ray[now]] *= 1 - opacity[now]
    return np.column_stack([result, 1 - through])
