#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_surfaces.py PROGRAM FOLDER: holds the surfaces that `tetralux extract` writes to what a mesh and a value define.

The files are read here byte by byte from their formats' descriptions. Of an isosurface: every edge once in either direction (but at the mesh's
sides), the volume inside that of the cells' parts above the value, in closed form; of all: fields as they are at the place. Plain Python.
"""
import itertools
import math
import os
import random
import re
import struct
import subprocess
import sys

N = 9  # points along each edge
VALUE = 0.2


def make_mesh():
    rng = random.Random(7)
    points, scalars = [], []
    for z in range(N):
        for y in range(N):
            for x in range(N):
                inner = [0 < c < N - 1 for c in (x, y, z)]
                p = tuple((c + (rng.uniform(-0.2, 0.2) if free else 0)) / (N - 1) for c, free in zip((x, y, z), inner))
                points.append(p)
                scalars.append(0.45 - math.dist(p, (0.5, 0.5, 0.5)) + rng.uniform(-0.04, 0.04))
    cells = []
    for z, y, x in itertools.product(range(N - 1), repeat=3):
        for axes in itertools.permutations((1, N, N * N)):  # Kuhn's six tetrahedra along the diagonal
            a = x + N * (y + N * z)
            cells.append((a, a + axes[0], a + axes[0] + axes[1], a + sum(axes)))
    return points, scalars, cells


def write_vtk(path, points, scalars, cells):
    with open(path, "w") as out:
        out.write("# vtk DataFile Version 3.0\nbumpy ball\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n" + "\n".join("%r %r %r" % p for p in points))
        out.write(f"\nCELLS {len(cells)} {5 * len(cells)}\n" + "\n".join("4 %d %d %d %d" % c for c in cells))
        out.write(f"\nCELL_TYPES {len(cells)}\n" + "10\n" * len(cells))
        out.write(f"POINT_DATA {len(points)}\nSCALARS s double 1\nLOOKUP_TABLE default\n" + "\n".join(map(repr, scalars)))
        out.write("\nVECTORS place double\n" + "\n".join("%r %r %r" % p for p in points))
        out.write(f"\nCELL_DATA {len(cells)}\nSCALARS cube double 1\nLOOKUP_TABLE default\n" + "\n".join(str(i // 6) for i in range(len(cells))) + "\n")


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def triple(a, b, c):
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def volume_above(points, scalars, cells, value):
    total = 0.0
    for cell in cells:
        a, b, c, d = (points[i] for i in cell)
        s = [scalars[i] for i in cell]
        share = sum(max(0.0, s[i] - value) ** 3 / math.prod(s[i] - s[j] for j in range(4) if j != i) for i in range(4))
        total += share * abs(triple(sub(b, a), sub(c, a), sub(d, a))) / 6
    return total


def read_vtp(path):
    data = open(path, "rb").read()
    marker = data.index(b'<AppendedData encoding="raw">')
    head, start = data[:marker].decode(), data.index(b"_", marker) + 1
    assert 'byte_order="LittleEndian"' in head and 'header_type="UInt64"' in head
    sections = {tag: re.search(f"<{tag}>(.*?)</{tag}>", head, re.S).group(1) for tag in ("Points", "Polys", "PointData", "CellData")}

    def arrays(tag):
        found = {}
        for kind, name, count, offset in re.findall(r'type="(\w+)" Name="(.*?)" NumberOfComponents="(\d+)" format="appended" offset="(\d+)"', sections[tag]):
            at = start + int(offset)
            size = struct.unpack_from("<Q", data, at)[0]
            values = struct.unpack_from("<%d%s" % (size // 8, {"Float64": "d", "Int64": "q"}[kind]), data, at + 8)
            k = int(count)
            found[name] = [values[i:i + k] for i in range(0, len(values), k)]
        return found

    points, polys = arrays("Points")["Points"], arrays("Polys")
    corners = [v[0] for v in polys["connectivity"]]
    assert [v[0] for v in polys["offsets"]] == [3 * (i + 1) for i in range(len(corners) // 3)]
    return points, [tuple(corners[i:i + 3]) for i in range(0, len(corners), 3)], arrays("PointData"), arrays("CellData")


def read_ply(path):
    data = open(path, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().split("\n")
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    counts, names, element = {}, {"vertex": [], "face": []}, None
    for line in lines[2:]:
        words = line.split()
        if words[:1] == ["element"]:
            element = words[1]
            counts[element] = int(words[2])
        elif words[:2] == ["property", "double"]:
            names[element].append(words[2])
        elif words[:1] == ["property"]:
            assert words == ["property", "list", "uchar", "int", "vertex_indices"] and not names["face"]
    width = len(names["vertex"])
    rows = [struct.unpack_from("<%dd" % width, data, end + 8 * width * i) for i in range(counts["vertex"])]
    at, triangles, cells = end + 8 * width * counts["vertex"], [], []
    for _ in range(counts["face"]):
        assert data[at] == 3
        triangles.append(struct.unpack_from("<3i", data, at + 1))
        cells.append(struct.unpack_from("<%dd" % len(names["face"]), data, at + 13))
        at += 13 + 8 * len(names["face"])
    assert at == len(data)
    assert names["vertex"] == ["x", "y", "z", "s", "place_x", "place_y", "place_z"] and names["face"] == ["cube"], names
    return [r[:3] for r in rows], triangles, {"s": [r[3:4] for r in rows], "place": [r[4:] for r in rows]}, {"cube": cells}


def read_stl(path):
    data = open(path, "rb").read()
    count = struct.unpack_from("<I", data, 80)[0]
    assert len(data) == 84 + 50 * count and not data.startswith(b"solid")
    numbers, points, triangles = {}, [], []
    for i in range(count):
        values = struct.unpack_from("<12f", data, 84 + 50 * i)
        corners = []
        for k in (3, 6, 9):
            place = values[k:k + 3]
            if place not in numbers:
                numbers[place] = len(points)
                points.append(place)
            corners.append(numbers[place])
        triangles.append(tuple(corners))
    return points, triangles, {}, {}


def open_edges(triangles):
    ways = {}
    for t in triangles:
        for k in range(3):
            edge = (t[k], t[(k + 1) % 3])
            ways[edge] = ways.get(edge, 0) + 1
    return [e for e, n in ways.items() if n != ways.get(e[::-1], 0)], max(ways.values())


def enclosed(points, triangles):
    return sum(triple(*(points[i] for i in t)) for t in triangles) / 6


def check(what, good, detail=""):
    if not good:
        print(f"FAILED: {what} {detail}")
        check.failed = True


check.failed = False


def check_fields(name, surface):
    points, triangles, on_points, on_cells = surface
    off = max(max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(points, on_points["place"]))
    check(f"{name}: a vector that is the place", off < 1e-15, off)
    for t, (cube,) in zip(triangles, on_cells["cube"]):
        middle = [sum(points[i][axis] for i in t) / 3 * (N - 1) for axis in range(3)]
        x, y, z = int(cube) % (N - 1), int(cube) // (N - 1) % (N - 1), int(cube) // (N - 1) ** 2
        check(f"{name}: a triangle lies in the cell that it has the value of", all(c - 0.25 < m < c + 1.25 for c, m in zip((x, y, z), middle)))


def main():
    program, folder = sys.argv[1:3]
    os.makedirs(folder, exist_ok=True)
    points, scalars, cells = make_mesh()
    mesh = os.path.join(folder, "ball.vtk")
    write_vtk(mesh, points, scalars, cells)

    def extract(ending, *options):
        out = os.path.join(folder, "surface." + ending)
        subprocess.run([program, "extract", mesh, "-o", out, "--quiet", *options], check=True)
        return {"vtp": read_vtp, "ply": read_ply, "stl": read_stl}[ending](out)

    inside = volume_above(points, scalars, cells, VALUE)
    for ending in ("vtp", "ply", "stl"):
        for name, options, volume in (("isosurface", ["--isosurface", str(VALUE)], inside), ("boundary", ["--boundary"], 1.0)):
            surface = extract(ending, *options)
            edges, most = open_edges(surface[1])
            check(f"{ending} {name}: every edge once either way", not edges and most == 1, (len(edges), most))
            off = abs(enclosed(*surface[:2]) - volume)
            check(f"{ending} {name}: volume", off < (1e-6 if ending == "stl" else 1e-13), off)
            if ending != "stl":
                check_fields(f"{ending} {name}", surface)
                if name == "isosurface":
                    off = max(abs(s - VALUE) for (s,) in surface[2]["s"])
                    check(f"{ending}: the scalar has the value", off < 1e-15, off)
        surface = extract(ending, "--slice", "0.5,0.5,0.5,1,1,1")
        area = [0.0, 0.0, 0.0]
        for t in surface[1]:
            a, b, c = (surface[0][i] for i in t)
            u, v = sub(b, a), sub(c, a)
            area = [s + 0.5 * w for s, w in zip(area, (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]))]
        off = max(abs(a - 0.75) for a in area)  # a regular hexagon of area √(27/16) across (1, 1, 1)/√3
        check(f"{ending} slice: area and way round", off < (1e-6 if ending == "stl" else 1e-13), off)
    sys.exit(1 if check.failed else 0)


main()
