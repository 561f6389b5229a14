# SPDX-License-Identifier: Apache-2.0
"""exr.read for numpy: the same file format, the same restrictions."""
import struct
import zlib

import numpy as np

import exr


def read(path):
    """Picture as an array of float32: (height, width, 4), rows from the top."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = exr._header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height, names = x1 - x0 + 1, y1 - y0 + 1, exr._channels(attributes["channels"])
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    picture = np.zeros((height, width, 4), np.float32)
    for k in range((height + lines - 1) // lines):
        offset = struct.unpack_from("<Q", data, at + 8 * k)[0]
        y, size = struct.unpack_from("<ii", data, offset)
        count = min(lines, y1 - y + 1)
        block = _unzip(data[offset + 8 : offset + 8 + size], 4 * width * len(names) * count)
        rows = np.frombuffer(block, "<f4").reshape(count, len(names), width)
        for channel, name in enumerate("RGBA"):
            picture[y - y0 : y - y0 + count, :, channel] = rows[:, names.index(name)]
    return picture


def _unzip(block, size):
    if len(block) == size:
        return block
    raw = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    raw[1:] -= 128
    raw = np.cumsum(raw).astype(np.uint8)
    half = (len(raw) + 1) // 2
    out = np.empty(len(raw), np.uint8)
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out.tobytes()
