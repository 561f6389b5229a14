# SPDX-License-Identifier: Apache-2.0
"""Figure 4 of Ament and Dachsbacher: how the ratio of the eigenvalues becomes a parameter of the lobes, as SVG."""
import math
import os

COLORS = ("#0072b2", "#009e73", "#e69f00", "#d55e00")
WIDTH, HEIGHT, LEFT, TOP = 512, 360, 62, 28


def ward(ratio, gamma):
    return 0.2 * ratio ** gamma  # Equation 32: a roughness, κ = 0.2


def lafortune(ratio, gamma):
    return 2 * (1 - math.exp(gamma * (1 - ratio))) - 1  # Equation 34


def plot(path, title, label, function, gammas, low, high, ticks):
    right, bottom = WIDTH - 20, HEIGHT - 48

    def at(ratio, value):
        return LEFT + (ratio - 1) / 2 * (right - LEFT), bottom - (value - low) / (high - low) * (bottom - TOP)

    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="13">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/><text x="{LEFT}" y="18">{title}</text>']
    for tick in ticks:
        x, y = at(1, tick)
        lines.append(f'<path d="M{x} {y}H{right}" stroke="#ddd"/><text x="{x - 6}" y="{y + 4}" text-anchor="end">{tick:g}</text>')
    for ratio in (1, 1.5, 2, 2.5, 3):
        x, _ = at(ratio, low)
        lines.append(f'<path d="M{x} {bottom}v5" stroke="#444"/><text x="{x}" y="{bottom + 19}" text-anchor="middle">{ratio:g}</text>')
    lines.append(f'<path d="M{LEFT} {TOP}V{bottom}H{right}" fill="none" stroke="#444"/>')
    lines.append(f'<text x="{(LEFT + right) / 2}" y="{HEIGHT - 10}" text-anchor="middle">λ₂/λ₁</text><text x="16" y="{(TOP + bottom) / 2}" '
                 f'transform="rotate(-90 16 {(TOP + bottom) / 2})" text-anchor="middle">{label}</text>')
    for color, gamma in zip(COLORS, gammas):
        points = [at(r, min(max(function(r, gamma), low), high)) for r in (1 + 2 * i / 400 for i in range(401)) if function(r, gamma) <= high]
        lines.append(f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="none" stroke="{color}" stroke-width="2"/>')
        x, y = points[-1] if points[-1][1] < TOP + 8 else points[len(points) // 3]
        lines.append(f'<text x="{x + 6:.1f}" y="{y + 12:.1f}" fill="{color}">γ = {gamma:g}</text>')
    with open(path, "w") as out:
        out.write("\n".join(lines) + "\n</svg>\n")


def mapping_functions(folder):
    plot(os.path.join(folder, "ament-4a.svg"), "Ward: roughness along the fibre", "u = κ (λ₂/λ₁)^γ, κ = 0.2", ward, (0, 1, 2, 4), 0, 4, (0, 1, 2, 3, 4))
    plot(os.path.join(folder, "ament-4b.svg"), "Lafortune: weight along the fibre", "u = 2(1 − exp(γ(1 − λ₂/λ₁))) − 1", lafortune, (0.5, 1, 3, 10), -1, 1,
         (-1, -0.5, 0, 0.5, 1))
