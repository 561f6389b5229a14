# SPDX-License-Identifier: Apache-2.0
"""Whatever comes as an array ends in a picture or in a Python exception."""

from __future__ import annotations

import gc
import random
import tracemalloc

import numpy as np
import pytest
from conftest import grid_of_tetrahedra, waves

import tetralux

POINTS, CELLS = grid_of_tetrahedra(4)
VALUES = waves(POINTS)


def picture(points, cells, values):
    return tetralux.render(tetralux.Mesh(points, cells, point_data={"v": values}), "v", size=(24, 18), threads=1)


def resident() -> int:
    """KiB."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


RIGHT = {
    "float32": lambda: (POINTS.astype(np.float32), CELLS, VALUES),
    "int32 cells": lambda: (POINTS, CELLS.astype(np.int32), VALUES),
    "uint32 cells, borrowed": lambda: (POINTS, CELLS.astype(np.uint32), VALUES),
    "uint64 cells": lambda: (POINTS, CELLS.astype(np.uint64), VALUES),
    "Fortran order": lambda: (np.asfortranarray(POINTS), np.asfortranarray(CELLS), VALUES),
    "strides": lambda: (np.repeat(POINTS, 2, axis=0)[::2], np.repeat(CELLS, 2, axis=1)[:, ::2], np.repeat(VALUES, 3)[::3]),
    "reversed twice": lambda: (POINTS[::-1].copy()[::-1], CELLS, VALUES),
    "read-only": lambda: tuple(read_only(each) for each in (POINTS, CELLS, VALUES)),
    "big-endian": lambda: (POINTS.astype(">f8"), CELLS.astype(">i8"), VALUES.astype(">f8")),
    "lists": lambda: (POINTS.tolist(), CELLS.tolist(), VALUES.tolist()),
    "blocks": lambda: (POINTS, {"tetra": CELLS}, VALUES),
    "two blocks": lambda: (POINTS, {"tetra": CELLS, "triangle": CELLS[:, :3]}, VALUES),
    "VTK's arrays": lambda: (POINTS, (np.arange(len(CELLS) + 1) * 4, CELLS.ravel(), np.full(len(CELLS), 10)), VALUES),
    "inverted cells": lambda: (POINTS, CELLS[:, [1, 0, 2, 3]], VALUES),
    "half of a wider array": lambda: (np.hstack([POINTS, POINTS])[:, :3], CELLS, VALUES),
}


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("form", RIGHT)
def test_right_arrays_in_any_form(form):
    points, cells, values = RIGHT[form]()
    expected = picture(POINTS.astype(np.float32).astype(float) if form == "float32" else POINTS, CELLS, VALUES)
    np.testing.assert_array_equal(picture(points, cells, values).rgba, expected.rgba)


def wrongs():
    """What makes (points, cells, values) wrong, each by itself."""
    nan, inf = float("nan"), float("inf")
    yield "flat points", lambda p, c, v: (p.ravel(), c, v)
    yield "two coordinates", lambda p, c, v: (p[:, :2], c, v)
    yield "four coordinates", lambda p, c, v: (np.hstack([p, p[:, :1]]), c, v)
    yield "three dimensions", lambda p, c, v: (p[None], c, v)
    yield "no points", lambda p, c, v: (p[:0], c, v)
    yield "fewer points", lambda p, c, v: (p[:-1], c, v[:-1])
    yield "complex points", lambda p, c, v: (p.astype(complex), c, v)
    yield "points as text", lambda p, c, v: (p.astype(str), c, v)
    yield "points as objects", lambda p, c, v: (p.astype(object), c, v)
    yield "long doubles", lambda p, c, v: (p.astype(np.longdouble), c, v)
    yield "points of NaN", lambda p, c, v: (np.full_like(p, nan), c, v)
    yield "points at infinity", lambda p, c, v: (np.full_like(p, inf), c, v)
    yield "all points one", lambda p, c, v: (np.zeros_like(p), c, v)
    yield "points None", lambda p, c, v: (None, c, v)
    yield "points a text", lambda p, c, v: ("points", c, v)
    yield "points ragged", lambda p, c, v: ([[1, 2, 3], [4, 5]], c, v)
    yield "no cells", lambda p, c, v: (p, c[:0], v)
    yield "flat cells", lambda p, c, v: (p, c.ravel(), v)
    yield "three corners", lambda p, c, v: (p, c[:, :3], v)
    yield "eight corners", lambda p, c, v: (p, np.hstack([c, c]), v)
    yield "cells of floats", lambda p, c, v: (p, c.astype(float), v)
    yield "cells of booleans", lambda p, c, v: (p, c.astype(bool), v)
    yield "corner beyond", lambda p, c, v: (p, np.where(c == c.max(), len(p), c), v)
    yield "corner far beyond", lambda p, c, v: (p, np.where(c == c.max(), 2**40, c), v)
    yield "corner beyond 32 bits", lambda p, c, v: (p, np.where(c == 0, 2**32, c), v)
    yield "corner below 0", lambda p, c, v: (p, np.where(c == 0, -1, c), v)
    yield "corner 2^63", lambda p, c, v: (p, np.where(c == 0, -(2**63), c), v)
    yield "uint32 beyond", lambda p, c, v: (p, np.where(c == 0, 2**32 - 1, c).astype(np.uint32), v)
    yield "all corners one", lambda p, c, v: (p, np.zeros_like(c), v)
    yield "cells None", lambda p, c, v: (p, None, v)
    yield "cells a number", lambda p, c, v: (p, 7, v)
    yield "unknown block", lambda p, c, v: (p, {"tetrahedron": c}, v)
    yield "no blocks", lambda p, c, v: (p, {}, v)
    yield "block of another shape", lambda p, c, v: (p, {"hexahedron": c}, v)
    yield "offsets too few", lambda p, c, v: (p, (np.arange(len(c)) * 4, c.ravel(), np.full(len(c), 10)), v)
    yield "offsets descend", lambda p, c, v: (p, (np.arange(len(c) + 1)[::-1] * 4, c.ravel(), np.full(len(c), 12)), v)
    yield "offsets beyond", lambda p, c, v: (p, (np.arange(len(c) + 1) * 9, c.ravel(), np.full(len(c), 12)), v)
    yield "offsets below 0", lambda p, c, v: (p, (np.arange(len(c) + 1) * 4 - 8, c.ravel(), np.full(len(c), 12)), v)
    yield "connectivity beyond", lambda p, c, v: (p, (np.arange(len(c) + 1) * 4, c.ravel() + 99, np.full(len(c), 12)), v)
    yield "connectivity short", lambda p, c, v: (p, (np.arange(len(c) + 1) * 4, c.ravel()[:-9], np.full(len(c), 10)), v)
    yield "types beyond", lambda p, c, v: (p, (np.arange(len(c) + 1) * 4, c.ravel(), np.full(len(c), 400)), v)
    yield "types unknown", lambda p, c, v: (p, (np.arange(len(c) + 1) * 4, c.ravel(), np.full(len(c), 250)), v)
    yield "types of floats", lambda p, c, v: (p, (np.arange(len(c) + 1) * 4, c.ravel(), np.full(len(c), 10.0)), v)
    yield "offsets of two dimensions", lambda p, c, v: (p, (np.zeros((2, 2), int), c.ravel(), np.full(len(c), 10)), v)
    yield "values too few", lambda p, c, v: (p, c, v[:-1])
    yield "values too many", lambda p, c, v: (p, c, np.append(v, 1.0))
    yield "no values", lambda p, c, v: (p, c, v[:0])
    yield "a number for values", lambda p, c, v: (p, c, 3.0)
    yield "values of NaN", lambda p, c, v: (p, c, np.full_like(v, nan))
    yield "values at infinity", lambda p, c, v: (p, c, np.full_like(v, inf))
    yield "values beyond 1e280", lambda p, c, v: (p, c, np.full_like(v, 1e300))
    yield "complex values", lambda p, c, v: (p, c, v.astype(complex))
    yield "values as text", lambda p, c, v: (p, c, v.astype(str))
    yield "values as objects", lambda p, c, v: (p, c, np.array([None] * len(v)))
    yield "times for values", lambda p, c, v: (p, c, v.astype("datetime64[s]"))


WRONGS = dict(wrongs())


@pytest.mark.parametrize("wrong", WRONGS)
def test_a_wrong_array_is_an_exception(wrong):
    with pytest.raises((ValueError, tetralux.Error)) as caught:
        picture(*WRONGS[wrong](POINTS, CELLS, VALUES))
    text = str(caught.value)
    assert "\n" not in text and len(text) > 10


def only_arrays(change):
    return lambda each: change(each) if isinstance(each, np.ndarray) and each.ndim else each


def test_ten_thousand_wrong_calls():
    """In arrays of random layout: an exception each, no crash, no leak."""
    random.seed(7)
    layouts = [lambda a: a, only_arrays(np.asfortranarray), only_arrays(lambda a: np.repeat(a, 2, axis=0)[::2]), only_arrays(read_only)]
    before = 0
    for turn in range(10_000):
        name = random.choice(list(WRONGS))
        p, c, v = (random.choice(layouts)(each) for each in WRONGS[name](POINTS, CELLS, VALUES))
        try:
            picture(p, c, v)
        except (ValueError, tetralux.Error):
            continue
        finally:
            if turn == 2_000:
                gc.collect()
                before = resident()
        pytest.fail(f"{name} made a picture in turn {turn}")
    gc.collect()
    assert resident() - before < 24 * 1024


def test_random_corners_never_crash():
    rng = np.random.default_rng(3)
    for _ in range(300):
        cells = rng.integers(0, len(POINTS), (rng.integers(1, 200), 4))
        try:
            picture(POINTS, cells, VALUES)
        except (ValueError, tetralux.Error):
            pass


def test_some_values_missing_leaves_their_cells_out():
    values = VALUES.copy()
    values[0] = np.nan
    image = picture(POINTS, CELLS, values)
    assert sum(image.report["cells_skipped"].values()) >= 1
    assert np.isfinite(image.rgba).all() and image.rgba[..., 3].max() > 0


def test_flat_cells_are_counted():
    cells = np.vstack([CELLS, [[0, 1, 2, 2]]])
    mesh = tetralux.Mesh(POINTS, cells)
    assert mesh.n_tetrahedra == len(CELLS) and sum(mesh.report["skipped"].values()) == 1
    assert mesh.n_cells == len(cells)


def test_borrowed_arrays_outlive_their_names():
    mesh = tetralux.Mesh(POINTS.copy(), CELLS.astype(np.uint32), point_data={"v": VALUES.copy()})
    renderer = tetralux.Renderer(mesh, size=(24, 18), threads=1)
    first = renderer.render().rgba.copy()
    del mesh
    gc.collect()
    junk = [np.full(POINTS.shape, 9e9) for _ in range(50)]
    np.testing.assert_array_equal(renderer.render().rgba, first)
    del junk


def test_arrays_are_borrowed_and_let_go():
    import sys

    points, cells, values = POINTS.copy(), CELLS.astype(np.uint32), VALUES.copy()
    counts = [sys.getrefcount(each) for each in (points, cells, values)]
    mesh = tetralux.Mesh(points, cells, point_data={"v": values})
    assert np.shares_memory(mesh.tetrahedra[0], points)
    assert np.shares_memory(mesh.tetrahedra[1], cells)
    renderer = tetralux.Renderer(mesh, "v", size=(8, 8), threads=1)
    renderer.render()
    del mesh, renderer
    gc.collect()
    assert [sys.getrefcount(each) for each in (points, cells, values)] == counts


def test_memory_is_flat_over_a_thousand_renders(bucky):
    renderer = tetralux.Renderer(bucky, size=(32, 24), threads=1)

    def frames(count):
        for i in range(count):
            renderer.transfer_function = "viridis" if i % 2 else "turbo"
            renderer.render(eye=(2, 1 + 0.001 * i, 3))

    frames(100)
    gc.collect()
    before = resident()
    tracemalloc.start()
    frames(20)
    python_before = tracemalloc.get_traced_memory()[0]
    frames(1000)
    gc.collect()
    grown = tracemalloc.get_traced_memory()[0] - python_before
    tracemalloc.stop()
    assert grown < 64 * 1024
    assert resident() - before < 16 * 1024


BAD_OPTIONS = [
    {"size": (0, 10)},
    {"size": (10,)},
    {"size": "big"},
    {"size": (1e9, 1e9)},
    {"size": (10.5, 10)},
    {"eye": (1, 2)},
    {"eye": (float("nan"), 0, 0)},
    {"eye": "above"},
    {"eye": (1, 1, 1), "target": (1, 1, 1)},
    {"up": (0, 0, 0)},
    {"fov": 0},
    {"fov": 180},
    {"fov": "wide"},
    {"height": -1},
    {"height": float("inf")},
    {"view": "top"},
    {"view": 3},
    {"zoom": 0},
    {"zoom": "near"},
    {"mode": "nice"},
    {"mode": 3},
    {"silhouette": "thick"},
    {"lights": 3},
    {"lights": "sun"},
    {"lights": [(0, 0, 0)]},
    {"lights": {"lights": [{"type": "laser"}]}},
    {"lights": {"colour": 1}},
    {"lights": "nowhere.json"},
    {"samples": 0},
    {"samples": 65},
    {"samples": 1.5},
    {"background": "no such colour"},
    {"background": (1, 2, 3)},
    {"transfer_function": "nowhere.json"},
    {"transfer_function": {"color": []}},
    {"transfer_function": {"color": [[0, 1, 1, float("nan")]]}},
    {"transfer_function": 5},
    {"transfer_function": {"color": object()}},
    {"clip": [(1, 2, 3)]},
    {"clip": [((0, 0, 0), (0, 0, 0))]},
    {"clip": 5},
    {"surfaces": [5]},
    {"surfaces": [{"points": POINTS, "triangles": [[0, 1, 999]]}]},
    {"engine": "abacus"},
    {"engine": 4},
    {"threads": -1},
    {"threads": 1.5},
    {"scalars": {"a": 1}},
    {"scalars": np.zeros(7)},
    {"scalars": "nothing"},
]


@pytest.mark.parametrize("options", BAD_OPTIONS, ids=str)
def test_a_wrong_option_is_an_exception(options, bucky):
    with pytest.raises((ValueError, KeyError, tetralux.Error)) as caught:
        tetralux.render(bucky, **{"size": (16, 12), **options})
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("source", [None, 5, [], "no_such_file.vtu", "no_such_file.abc", "bucky:0", "bucky:x", b"\0"])
def test_no_mesh_is_an_exception(source):
    with pytest.raises((ValueError, tetralux.Error)):
        tetralux.render(source, size=(8, 8))


@pytest.mark.parametrize("limit", [np.zeros((3, 3)), np.full((12, 16), np.nan), "deep", np.zeros((12, 16, 1))], ids=str)
def test_a_wrong_depth_limit_is_an_exception(limit, bucky):
    with pytest.raises(ValueError):
        tetralux.Renderer(bucky, size=(16, 12)).render(depth_limit=limit)
