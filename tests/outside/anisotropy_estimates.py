#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""anisotropy_estimates.py PROGRAM FOLDER: the program's tensors against the estimate of Ament & Dachsbacher (2015),
Equations 14 to 25, at points of a sphere, an ellipsoid and a cylinder whose directions are known, for three radii.
Needs numpy. Points are drawn anew, so the numbers are near those of projection/modes.md, not the same.

The paper's: random points of the ball whose scalar is within epsilon, projected onto the tangent plane, covariance
about their centroid with the weight 1 - x^2 of the distance there. The program's: read from what `render
--keep-anisotropy` wrote.
"""
import os
import re
import subprocess
import sys

import numpy as np

from check_scattering import grid, write_vtu

N, SAMPLES, EPSILON = 33, 20000, 0.05
SHAPES = {"sphere": (0.6, 0.6, 0.6), "ellipsoid": (0.4, 0.4, 0.8), "cylinder": (0.4, 0.4, 1e9)}


def kept_tensors(path):
    """Positions and the six components at every point of a file with raw appended arrays."""
    with open(path, "rb") as file:
        data = file.read()
    base = data.index(b"_", data.index(b"<AppendedData")) + 1
    def array(pattern, components):
        offset = int(re.search(pattern + rb'.*? offset="(\d+)"', data).group(1)) + base
        size = int(np.frombuffer(data, "<u8", 1, offset)[0])
        return np.frombuffer(data, "<f8", size // 8, offset + 8).reshape(-1, components)
    return array(rb'Name="Points"', 3), array(rb'Name="anisotropy\(', 6)


def frame(gradient):
    n = gradient / np.linalg.norm(gradient)
    a = np.cross(n, (1, 0, 0) if abs(n[0]) < 0.6 else (0, 1, 0))
    a /= np.linalg.norm(a)
    return a, np.cross(n, a)


def ratio_and_direction(matrix, a, b):
    values, vectors = np.linalg.eigh(matrix)
    return values[1] / values[0], vectors[0, 1] * a + vectors[1, 1] * b


def paper(field, span, place, a, b, radius, rng):
    u = rng.random((SAMPLES, 3))
    d, z, phi = radius * np.cbrt(u[:, 0]), 1 - 2 * u[:, 2], 2 * np.pi * u[:, 1]
    across = np.sqrt(1 - z * z)
    x = d[:, None] * np.stack([across * np.cos(phi), across * np.sin(phi), z], 1)
    x = x[np.abs(field(place + x) - field(place)) <= EPSILON * span]
    y = np.stack([x @ a, x @ b], 1)
    y -= y.mean(0)
    w = np.maximum(1 - (y * y).sum(1) / radius**2, 0)
    return ratio_and_direction((w[:, None, None] * y[:, :, None] * y[:, None, :]).sum(0), a, b)


def main(program, folder):
    os.makedirs(folder, exist_ok=True)
    rng, spacing = np.random.default_rng(1), 2 / (N - 1)
    edge = spacing * (4 * (3 + 3 * 2**0.5) + 6 * 2**0.5) / 30  # mean over the cells of a cube: four at corners, one amid them
    print("| shape | radius (edges; of the radius of the waist) | estimate | λ₂/λ₁, mean ± deviation | off the axis, mean, largest |\n| --- | --- | --- | --- | --- |")
    for shape, axes in SHAPES.items():
        axes = np.array(axes)
        def field(p):
            return np.sqrt(((p / axes) ** 2).sum(-1))
        mesh = grid(N, -1.0, 1.0, lambda p: float(field(np.array(p))))
        span = max(mesh[1]) - min(mesh[1])
        path, kept = (os.path.join(folder, name) for name in ("shape.vtu", "kept.vtu"))
        write_vtu(path, mesh)
        for edges in (3, 5, 8):
            radius = edges * edge
            subprocess.run([program, "render", path, "-o", os.path.join(folder, "shape.png"), "--size", "8x8", "--quiet", "--anisotropy",
                            f"radius={edges},interval={EPSILON}", "--keep-anisotropy", kept], check=True)
            points, tensors = kept_tensors(kept)
            scalars = field(points)
            free = np.abs(points[:, 2]) < (0.35 if shape == "ellipsoid" else 0.5)  # where the axis is the direction, and no border
            chosen = rng.choice(np.flatnonzero((np.abs(scalars - 1) < 0.15) & free & (np.abs(points[:, :2]).max(1) < 0.75)), 60, False)
            found = {"paper": [], "program": []}
            for i in chosen:
                a, b = frame(points[i] / axes**2)
                t = tensors[i]
                matrix = np.array([[t[0], t[3], t[4]], [t[3], t[1], t[5]], [t[4], t[5], t[2]]])
                basis = np.stack([a, b], 1)
                along = basis @ (basis.T @ np.array((0.0, 0.0, 1.0)))
                along /= np.linalg.norm(along)
                for name, (ratio, direction) in (("paper", paper(field, span, points[i], a, b, radius, rng)),
                                                 ("program", ratio_and_direction(basis.T @ matrix @ basis, a, b))):
                    found[name].append((ratio, np.degrees(np.arccos(min(1, abs(direction @ along))))))
            for name, values in found.items():
                ratio, angle = np.array(values).T
                off = "" if shape == "sphere" else f"{angle.mean():.1f}°, {angle.max():.1f}°"
                print(f"| {shape} | {edges}; {radius / axes[0]:.2f} | {name} | {ratio.mean():.3f} ± {ratio.std():.3f} | {off} |")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
