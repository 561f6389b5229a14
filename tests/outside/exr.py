# SPDX-License-Identifier: Apache-2.0
"""Reads the OpenEXR files that tetralux writes: scan lines of float channels, ZIP or no compression (openexr.com, "File Layout")."""
import struct
import zlib


def _header(data):
    """Attributes by name, and where the table of offsets begins."""
    at, attributes = 8, {}
    while data[at] != 0:
        name_end = data.index(b"\0", at)
        type_end = data.index(b"\0", name_end + 1)
        size = struct.unpack_from("<i", data, type_end + 1)[0]
        attributes[data[at:name_end].decode()] = data[type_end + 5 : type_end + 5 + size]
        at = type_end + 5 + size
    return attributes, at + 1


def _channels(attribute):
    names, at = [], 0
    while attribute[at] != 0:
        end = attribute.index(b"\0", at)
        kind = struct.unpack_from("<i", attribute, end + 1)[0]
        if kind != 2:
            raise ValueError("a channel is not float")
        names.append(attribute[at:end].decode())
        at = end + 17
    return names


def _unzip(block, size):
    if len(block) == size:
        return block  # ZIP leaves alone what it cannot make smaller
    raw = bytearray(zlib.decompress(block))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    half = (len(raw) + 1) // 2
    out = bytearray(len(raw))
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return bytes(out)


def read(path):
    """Rows from the top, each a list of pixels (r, g, b, a)."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = _header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height, names = x1 - x0 + 1, y1 - y0 + 1, _channels(attributes["channels"])
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    rows = [None] * height
    for k in range((height + lines - 1) // lines):
        offset = struct.unpack_from("<Q", data, at + 8 * k)[0]
        y, size = struct.unpack_from("<ii", data, offset)
        count = min(lines, y1 - y + 1)
        block = _unzip(data[offset + 8 : offset + 8 + size], 4 * width * len(names) * count)
        floats = struct.unpack("<%df" % (width * len(names) * count), block)
        for line in range(count):
            start = line * width * len(names)
            planes = {name: floats[start + i * width : start + (i + 1) * width] for i, name in enumerate(names)}
            rows[y - y0 + line] = list(zip(planes["R"], planes["G"], planes["B"], planes["A"]))
    return rows
