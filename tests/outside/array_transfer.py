# SPDX-License-Identifier: Apache-2.0
"""Transfer functions and what they make of a segment along which the scalar is linear, for many segments at once."""
import numpy as np

GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(16)
GAUSS_POINTS, GAUSS_WEIGHTS = 0.5 + 0.5 * GAUSS_POINTS, 0.5 * GAUSS_WEIGHTS
OPAQUE = 45.0  # optical depth behind which nothing is seen in double precision
ROUNDING = 1e-12  # of a scalar: one that is an isosurface's by definition, as in a corner where the eye stands, is not below it


class TransferFunction:
    """`description` as in a transfer function file (not normalized).

    Between neighbouring `breaks` colour and extinction are lines: piece i reaches from breaks[i - 1] to breaks[i], the first and the
    last one are constant and have no end. At a jump a scalar has the value from above.
    """

    def __init__(self, description):
        color = sorted(description["color"], key=lambda n: n[0])
        extinction = sorted(description["extinction"], key=lambda n: n[0])
        self.peaks = sorted((dict(p, value=p["value"] - ROUNDING * abs(p["value"])) for p in description.get("isosurfaces", []) if p["opacity"] > 0),
                            key=lambda p: p["value"])
        self.breaks = np.array(sorted({n[0] for n in color} | {n[0] for n in extinction} | {p["value"] for p in self.peaks}))
        low = np.concatenate([[-np.inf], self.breaks])
        high = np.concatenate([self.breaks, [np.inf]])
        self.low, self.high = low, high
        self.tau = np.array([[_at(extinction, a, b, a)[0], _at(extinction, a, b, b)[0]] for a, b in zip(low, high)])
        self.color = np.array([[_at(color, a, b, a), _at(color, a, b, b)] for a, b in zip(low, high)])

    def values(self, piece, s):
        """Extinction and colour at scalars of given pieces."""
        low, high = self.low[piece], self.high[piece]
        bounded = np.isfinite(low) & np.isfinite(high)
        with np.errstate(invalid="ignore", over="ignore"):
            f = np.where(bounded, (s - low) / np.where(bounded, high - low, 1.0), 0.0)
        f = np.clip(f, 0.0, 1.0)
        tau, color = self.tau[piece], self.color[piece]
        return tau[..., 0] * (1 - f) + tau[..., 1] * f, color[..., 0, :] * (1 - f)[..., None] + color[..., 1, :] * f[..., None]

    def at(self, s):
        return self.values(np.searchsorted(self.breaks, s, side="right"), s)


def _at(nodes, low, high, s):
    """Value at an end `s` of the piece between two neighbouring breaks."""
    if high <= nodes[0][0]:
        return nodes[0][1:]
    if low >= nodes[-1][0]:
        return nodes[-1][1:]
    a, b = next((p, q) for p, q in zip(nodes, nodes[1:]) if p[0] <= low and high <= q[0])
    f = (s - a[0]) / (b[0] - a[0])
    return [(1 - f) * p + f * q for p, q in zip(a[1:], b[1:])]


def emitted(tau0, tau1, color0, color1, length):
    """Colour that leaves the front of runs along which extinction and colour are linear, and their optical depth.

    By parts: C = c0 (1 - exp(-D)) + (c1 - c0)(J - exp(-D)), J = ∫ exp(-depth(x)) dx; thin runs by quadrature of c τ exp(-depth), whose
    colour keeps its digits however faint it is.
    """
    a, b = tau0 * length, (tau1 - tau0) * length / 2
    depth = a + b
    seen = np.ones_like(a)
    discriminant = a * a + 4 * OPAQUE * b
    deep = (depth > OPAQUE) & (discriminant > 0)
    seen[deep] = 2 * OPAQUE / (a[deep] + np.sqrt(discriminant[deep]))
    parts = 4
    x = (np.arange(parts)[:, None] + GAUSS_POINTS).reshape(-1) / parts
    weights = np.tile(GAUSS_WEIGHTS, parts) / parts
    at = seen[:, None] * x
    through = np.exp(-(a[:, None] + b[:, None] * at) * at)
    mean = seen * (through @ weights)
    end = np.exp(-depth)
    by_parts = color0 * -np.expm1(-depth)[:, None] + (color1 - color0) * (mean - end)[:, None]
    source = (a[:, None] + 2 * b[:, None] * at) * through * weights
    direct = color0 * source.sum(1)[:, None] + (color1 - color0) * (source * at).sum(1)[:, None]
    return np.where((depth < 1)[:, None], direct, by_parts), depth


def light(tau0, tau1, color0, color1, length):
    """∫ c τ over the run, and its optical depth."""
    c = (2 * tau0 + tau1)[:, None] * color0 + (tau0 + 2 * tau1)[:, None] * color1
    return c * (length / 6)[:, None], (tau0 + tau1) / 2 * length


class Integrals:
    """Of each segment: colour, optical depth without isosurfaces, depth of the isosurfaces, distance to the first thing that shows.

    `hides`: whether what stands in front hides what is behind; where it does not, an isosurface's depth is its opacity.
    """

    def __init__(self, function, s_in, s_out, length, path, hides):
        n = len(s_in)
        self.function, self.hides = function, hides
        self.s_in, self.s_out, self.path = s_in, s_out, path
        self.color, self.smooth, self.peak_depth = np.zeros((n, 3)), np.zeros(n), np.zeros(n)
        self.first = np.full(n, np.inf)  # as a share of the way along the segment
        self._constant(np.nonzero(s_in == s_out)[0])
        pieces = range(len(function.low))
        self._walk(np.nonzero(s_in < s_out)[0], pieces, rising=True)
        self._walk(np.nonzero(s_in > s_out)[0], reversed(pieces), rising=False)

    def depth(self):
        return self.smooth + self.peak_depth

    def _through(self, which):
        return np.exp(-self.smooth[which] - self.peak_depth[which]) if self.hides else np.ones(len(which))

    def _constant(self, which):
        tau, color = self.function.at(self.s_in[which])
        self.smooth[which] = tau * self.path[which]
        amount = -np.expm1(-self.smooth[which]) if self.hides else self.smooth[which]
        self.color[which] = color * amount[:, None]
        self.first[which[tau > 0]] = 0.0

    def _walk(self, which, pieces, rising):
        if len(which) == 0:
            return
        peaks = {p["value"]: p for p in self.function.peaks}
        for piece in pieces:
            self._piece(which, piece, rising)
            value = self.function.high[piece] if rising else self.function.low[piece]
            if value in peaks:
                self._peak(which, peaks[value])

    def _piece(self, which, piece, rising):
        f = self.function
        low = np.maximum(np.minimum(self.s_in[which], self.s_out[which]), f.low[piece])
        high = np.minimum(np.maximum(self.s_in[which], self.s_out[which]), f.high[piece])
        some = high > low
        which, low, high = which[some], low[some], high[some]
        if len(which) == 0:
            return
        begin, end = (low, high) if rising else (high, low)
        number = np.full(len(which), piece)
        tau0, color0 = f.values(number, begin)
        tau1, color1 = f.values(number, end)
        span = np.abs(self.s_out[which] - self.s_in[which])
        length = self.path[which] * ((high - low) / span)
        through = self._through(which)
        color, depth = (emitted if self.hides else light)(tau0, tau1, color0, color1, length)
        self.color[which] += through[:, None] * color
        self.smooth[which] += depth
        shows = (tau0 > 0) | (tau1 > 0)
        share = np.abs(begin - self.s_in[which]) / span
        self.first[which[shows]] = np.minimum(self.first[which[shows]], share[shows])

    def _peak(self, which, peak):
        v = peak["value"]
        which = which[(self.s_in[which] < v) != (self.s_out[which] < v)]
        through = self._through(which)
        self.color[which] += (through * peak["opacity"])[:, None] * np.array(peak["color"], float)
        with np.errstate(divide="ignore"):
            self.peak_depth[which] += -np.log1p(-peak["opacity"]) if self.hides else peak["opacity"]
        share = np.abs(v - self.s_in[which]) / np.abs(self.s_out[which] - self.s_in[which])
        self.first[which] = np.minimum(self.first[which], share)
