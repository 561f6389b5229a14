# SPDX-License-Identifier: Apache-2.0
"""Fields on meshes and transfer functions for them, drawn at random: the kinds by which engines went wrong somewhere, and plain ones."""
import numpy as np


def _along(rng, p):
    way = rng.normal(size=3)
    return p @ (way / np.sqrt((way * way).sum()))


def _scaled(s):
    spread = np.ptp(s)
    return (s - s.min()) / spread if spread > 0 else np.zeros_like(s)


# each takes a generator and points scaled to the unit cube, and gives scalars
FIELDS = {
    "linear": lambda rng, p: _along(rng, p),
    "along_an_axis": lambda rng, p: p[:, rng.integers(3)].copy(),
    "constant": lambda rng, p: np.full(len(p), float(rng.choice([0.0, 0.3, 1.0, -7.25, 1e5]))),
    "plateaus": lambda rng, p: np.clip(2 * _scaled(_along(rng, p)) - 0.5, 0, 1),
    "labels": lambda rng, p: rng.integers(0, 4, len(p)).astype(float),
    "two_values": lambda rng, p: rng.integers(0, 2, len(p)).astype(float),
    "decades": lambda rng, p: 10.0 ** (rng.uniform(2, 8) * (_scaled(_along(rng, p)) - 1)),
    "negative": lambda rng, p: -5 + 3 * _along(rng, p),
    "steep": lambda rng, p: np.tanh(rng.uniform(3, 40) * (_scaled(_along(rng, p)) - 0.5)),
    "noise": lambda rng, p: rng.random(len(p)),
    "levels": lambda rng, p: np.round(4 * p[:, rng.integers(3)]) / 4,
    "radial": lambda rng, p: np.sqrt(((p - rng.random(3)) ** 2).sum(1)),
    "saddle": lambda rng, p: (p[:, 0] - 0.5) * (p[:, 1] - 0.5),
    "waves": lambda rng, p: np.sin(rng.uniform(2, 9) * p[:, 0]) * np.cos(rng.uniform(2, 9) * p[:, 1]) + p[:, 2],
    "far_from_zero": lambda rng, p: 300.0 + 0.5 * _along(rng, p),
}


def random_field(rng, kind, points, cells):
    """Scalars of points, or of cells: (point_scalars, cell_scalars), one of them None."""
    low, high = points.min(0), points.max(0)
    where = (points - low) / np.where(high > low, high - low, 1)
    if rng.integers(5) == 0:
        return None, FIELDS[kind](rng, where[cells].mean(1))
    return FIELDS[kind](rng, where), None


FUNCTIONS = ("ramp", "constant", "jumps", "jump_at_values", "peaks", "peaks_at_values", "peaks_in_fog", "window", "many_nodes", "decades",
             "opaque", "colors_jump")


def _color(rng):
    return [round(float(v), 3) for v in rng.random(3)]


def _colors(rng, scalars):
    return [[float(s), *_color(rng)] for s in scalars]


def _peaks(rng, values):
    return [{"value": float(v), "opacity": round(float(rng.choice([rng.uniform(0.05, 0.95), 1.0], p=[0.85, 0.15])), 3), "color": _color(rng)} for v in values]


def random_function(rng, kind, scalars, per_length, per_scalar):
    """Absolute transfer function for a field's scalars. Extinction is `per_length` (or `per_scalar`, whichever is given) times numbers
    from a tenth to ten: optical depths of pictures that show something."""
    low, high = float(scalars.min()), float(scalars.max())
    span = high - low if high > low else max(abs(low), 1.0)
    unit = per_length if per_length else per_scalar / span
    values = np.unique(scalars)
    some = lambda n: sorted(low + span * float(f) for f in rng.random(n))
    picked = lambda n: sorted(float(v) for v in rng.choice(values, min(n, len(values)), replace=False))
    tau = lambda: float(unit * 10.0 ** rng.uniform(-1, 1))
    if kind == "constant":
        return {"color": _colors(rng, [low]), "extinction": [[low, tau()]], "isosurfaces": []}
    color = _colors(rng, [low, *some(2), high if high > low else low + span])
    extinction, peaks = [[low, 0.0], [low + span, tau()]], []
    if kind == "jumps":
        a, b = some(2)
        extinction = [[a, 0.0], [a, tau()], [b, tau()], [b, tau()]]
    elif kind == "jump_at_values":
        extinction = []
        for i, v in enumerate(picked(int(rng.integers(1, 3)))):
            extinction += [[v, 0.0 if i == 0 else tau()], [v, tau()]]
    elif kind.startswith("peaks"):
        peaks = _peaks(rng, picked(int(rng.integers(1, 4))) if kind == "peaks_at_values" else some(int(rng.integers(1, 5))))
        extinction = [[low, 0.0]] if kind == "peaks" or rng.integers(2) and kind == "peaks_at_values" else extinction
    elif kind == "window":
        middle, half = some(1)[0], span * 10.0 ** rng.uniform(-3, -1)
        extinction = [[middle - half, 0.0], [middle, 10 * tau()], [middle + half, 0.0]]
    elif kind == "many_nodes":
        at = np.linspace(low, low + span, int(rng.integers(60, 140)))
        color = _colors(rng, at) if rng.integers(2) else color
        extinction = [[float(s), tau() * float(rng.integers(2))] for s in at]
    elif kind == "decades":
        least = 10.0 ** rng.uniform(-6, -1)
        at = low + span * np.geomspace(least, 1, 7)
        extinction = [[float(s), tau()] for s in at]
    elif kind == "opaque":
        extinction = [[low, 0.0], *([s, 30 * tau()] for s in some(2)), [low + span, 100 * tau()]]
    elif kind == "colors_jump":
        at = picked(1)[0] if rng.integers(2) else some(1)[0]
        color = [[low - span, *_color(rng)], [at, *_color(rng)], [at, *_color(rng)], [low + 2 * span, *_color(rng)]]
    return {"color": color, "extinction": extinction, "isosurfaces": peaks}
