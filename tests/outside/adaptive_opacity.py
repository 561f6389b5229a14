# SPDX-License-Identifier: Apache-2.0
"""Locally adaptive opacity written down from Marchesin, Dischler & Mongenet, "Feature Enhancement using Locally Adaptive Volume Rendering"
(Volume Graphics 2007): relevance is binary, the opacity follows from the number of contributions along the ray. Nothing of the program's is used.
"""
import math

from ray_caster import QUADRATURE, TransferFunction, along


class Relevance:
    """delta(s): 1 where the extinction is above a share of its largest value."""

    def __init__(self, tf, threshold):
        self.tf, self.limit = tf, threshold * max(node[1] for node in tf.extinction)
        self.nodes = tf.nodes + [peak["value"] for peak in tf.peaks]

    def at(self, s):
        """At one scalar, by the side from above where the function jumps."""
        return self.tf.at(self.tf.extinction, s, math.inf)[0] > self.limit

    def parts(self, front, back):
        """Where delta is 1 along a segment whose scalar goes linearly from front to back, cut at all nodes and isosurfaces: (from, to) as shares
        of its length, and the scalars there."""
        if front == back:
            return [(0.0, 1.0, front, back)] if self.at(front) else []
        low, high = min(front, back), max(front, back)
        scalars = sorted({front, back} | {n for n in self.nodes if low < n < high}, reverse=back < front)
        share = lambda s: (s - front) / (back - front)
        found = []
        for s, e in zip(scalars, scalars[1:]):
            a, b = share(s), share(e)
            p, q = self.tf.at(self.tf.extinction, s, e)[0] - self.limit, self.tf.at(self.tf.extinction, e, s)[0] - self.limit
            if p > 0 and q > 0:
                found.append((a, b, s, e))
            elif p > 0 or q > 0:  # linear between: it passes the limit once
                f = p / (p - q)
                middle, scalar = a + (b - a) * f, s + (e - s) * f
                found.append((a, middle, s, scalar) if p > 0 else (middle, b, scalar, e))
        return [part for part in found if part[1] > part[0]]


class Segment:
    """What a ray meets in one cell: relevant runs in order, (length, colour at both ends), and isosurfaces among them (length 0)."""

    def __init__(self, tf, relevance, front, back, length):
        color = lambda s, towards: tf.at(tf.color, s, towards)
        self.runs = []
        for a, b, s, e in relevance.parts(front, back):
            self.runs.append((a, (b - a) * length, color(s, e), color(e, s)))
        for peak in tf.peaks:
            if (front < peak["value"]) != (back < peak["value"]):
                self.runs.append(((peak["value"] - front) / (back - front), None, peak["color"], peak["color"]))
        self.runs.sort(key=lambda run: (run[0], run[1] is not None))  # runs are cut at isosurfaces
        self.length = sum(l for _, l, _, _ in self.runs if l is not None)
        self.peaks = [c for _, l, c, _ in self.runs if l is None]

    def contributions(self):
        """Colours: the mean over what is relevant, and one of each isosurface."""
        smooth = [run for run in self.runs if run[1] is not None]
        colors = list(self.peaks)
        if self.length > 0:
            colors.append([sum(l * (p[i] + q[i]) / 2 for _, l, p, q in smooth) / self.length for i in range(3)])
        return colors


class SampledSegment:
    """The same from one sample in the middle, without pre-integration."""

    def __init__(self, tf, relevance, front, back, length):
        s = (front + back) / 2
        self.peaks, self.length, self.runs = [], 0.0, []
        if relevance.at(s):
            c = tf.at(tf.color, s, math.inf)
            self.length, self.runs = length, [(0.0, length, c, c)]

    def contributions(self):
        return [self.runs[0][2]] if self.runs else []


def met(cells, camera, tf, threshold, sampled, x, y, size):
    """Segments of the ray through a pixel, from the eye on."""
    origin, d = camera.ray(x, y, size)
    relevance, kind = Relevance(tf, threshold), SampledSegment if sampled else Segment
    hits = sorted(((*interval, cell) for cell in cells if (interval := cell.interval(origin, d))), key=lambda h: h[0] + h[1])
    return [kind(tf, relevance, cell.scalar(along(origin, a, d)), cell.scalar(along(origin, b, d)), b - a) for a, b, cell in hits]


def count(segments, unit, piece):
    """N. An isosurface is one contribution."""
    if unit == "cells":
        return sum(len(s.contributions()) for s in segments)
    return sum(s.length / piece + len(s.peaks) for s in segments)


def _over(color, through, added, opacity):
    return [c + through * opacity * a for c, a in zip(color, added)], through * (1 - opacity)


def composited(segments, unit, piece, most):
    """Equation 8 with the bound of section 3.3; by length every run is the volume of extinction -ln(1 - tau)/piece."""
    n = count(segments, unit, piece)
    if n == 0:
        return (0.0, 0.0, 0.0, 0.0)
    tau = min(most, 1 / n)
    color, through = [0.0, 0.0, 0.0], 1.0
    for segment in segments:
        if unit == "cells":
            colors = segment.contributions()
            if colors:
                mean = [sum(c[i] for c in colors) / len(colors) for i in range(3)]
                color, through = _over(color, through, mean, 1 - (1 - tau) ** len(colors))
            continue
        for _, length, first, last in segment.runs:
            if length is None:
                color, through = _over(color, through, first, tau)
                continue
            extinction = -math.log(1 - tau) / piece
            for x, weight in QUADRATURE:
                emitted = through * weight * length * extinction * math.exp(-extinction * length * x)
                color = [c + emitted * (p + (q - p) * x) for c, p, q in zip(color, first, last)]
            through *= (1 - tau) ** (length / piece)
    return (*color, 1 - through)


def mean(segments, unit, piece):
    """Equation 12 (cells) or 13 (length): nothing hides anything, no bound."""
    n = count(segments, unit, piece)
    if n == 0:
        return (0.0, 0.0, 0.0, 0.0)
    total = [0.0, 0.0, 0.0]
    for segment in segments:
        if unit == "cells":
            weighted = [(1.0, c) for c in segment.contributions()]
        else:
            weighted = [(l / piece if l is not None else 1.0, [(a + b) / 2 for a, b in zip(p, q)]) for _, l, p, q in segment.runs]
        for weight, c in weighted:
            total = [t + weight * v for t, v in zip(total, c)]
    return (*(t / n for t in total), 1.0)


def pixel(cells, camera, description, look, x, y, size):
    """`look`: {"mode", "unit", "piece", "most", "threshold", "sampled"}."""
    segments = met(cells, camera, TransferFunction(description), look["threshold"], look["sampled"], x, y, size)
    if look["mode"] == "contributions":
        n = float(count(segments, look["unit"], look["piece"]))
        return (n, n, n, 1.0 if n > 0 else 0.0)
    if look["mode"] == "additive":
        return mean(segments, look["unit"], look["piece"])
    return composited(segments, look["unit"], look["piece"], look["most"])
