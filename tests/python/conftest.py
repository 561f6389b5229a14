# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python package share. TETRALUX_PROGRAM names the command line program, for comparisons with it."""

from __future__ import annotations

import os
import pathlib
import subprocess

import numpy as np
import pytest

import tetralux

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program() -> str:
    path = os.environ.get("TETRALUX_PROGRAM", "")
    if not path:
        pytest.skip("TETRALUX_PROGRAM does not name the program tetralux")
    return path


@pytest.fixture
def drawn_by_program(program, tmp_path):
    """The picture of `tetralux render` with these arguments, as an array: what the file holds, a float for a float."""

    def draw(*arguments: str) -> np.ndarray:
        picture = tmp_path / "program.exr"
        subprocess.run([program, "render", *arguments, "-o", str(picture), "--quiet"], check=True)
        return read_exr(picture)

    return draw


def read_exr(path: pathlib.Path) -> np.ndarray:
    """(h, w, 4) float32 of an .exr without compression or with ZIP, as tetralux writes it."""
    import struct
    import zlib

    data = path.read_bytes()
    assert data[:4] == b"\x76\x2f\x31\x01"
    at, header = 8, {}
    while data[at]:
        name, at = data[at : (end := data.index(0, at))].decode(), end + 1
        at = data.index(0, at) + 1
        (size,) = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    at += 1
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels, place = [], 0
    while header["channels"][place]:
        end = header["channels"].index(0, place)
        channels.append(header["channels"][place:end].decode())
        assert struct.unpack_from("<i", header["channels"], end + 1)[0] == 2  # float
        place = end + 17
    lines = {0: 1, 2: 1, 3: 16}[header["compression"][0]]
    image = np.empty((height, width, 4), np.float32)
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        rows = min(lines, height - (y - top))
        raw = data[offset + 8 : offset + 8 + size]
        expected = rows * width * 4 * len(channels)
        if size != expected:
            coded = np.frombuffer(zlib.decompress(raw), np.uint8).astype(np.int64)
            coded[1:] -= 128
            plain = (np.cumsum(coded) & 255).astype(np.uint8)
            half = (expected + 1) // 2
            both = np.empty(expected, np.uint8)
            both[0::2], both[1::2] = plain[:half], plain[half:]
            raw = both.tobytes()
        block = np.frombuffer(raw, "<f4").reshape(rows, len(channels), width)
        for i, channel in enumerate(channels):
            image[y - top : y - top + rows, :, "RGBA".index(channel)] = block[:, i]
    return image


def grid_of_tetrahedra(n: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Points (n³, 3) in [0, 1] and tetrahedra, five to a cube turned so that faces fit: float64, int64."""
    axis = np.linspace(0, 1, n)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    i, j, k = (a.ravel() for a in np.meshgrid(*[np.arange(n - 1)] * 3, indexing="ij"))

    def corner(x: int, y: int, z: int) -> np.ndarray:
        return ((i + x) * n + j + y) * n + k + z

    corners = [corner(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    even = [(0, 4, 2, 1), (6, 2, 4, 7), (5, 4, 1, 7), (3, 1, 2, 7), (1, 2, 4, 7)]
    # an odd cube is an even one mirrored through its middle
    is_even = ((i + j + k) % 2 == 0)[:, None]
    cells = [np.stack([np.where(is_even[:, 0], corners[a], corners[7 - a]) for a in cell], axis=1) for cell in even]
    cells = np.concatenate(cells).astype(np.int64)
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    inverted = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
    cells[inverted] = cells[inverted][:, [0, 1, 3, 2]]
    return points, cells


@pytest.fixture(scope="session")
def bucky() -> tetralux.Mesh:
    return tetralux.read("bucky:16")


def waves(points: np.ndarray) -> np.ndarray:
    return np.sin(7 * points[:, 0]) + np.cos(5 * points[:, 1]) * points[:, 2]
