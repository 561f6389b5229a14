# SPDX-License-Identifier: Apache-2.0
"""check_installed.py CMAKE BUILD FOLDER TETRALUX COMPILER: installs the library of the build folder into FOLDER, builds programs of others
with it and runs them."""
import math
import os
import re
import shutil
import struct
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "outside"))
import exr

HERE = os.path.dirname(os.path.abspath(__file__))
CMAKE, BUILD, FOLDER, TETRALUX, COMPILER = sys.argv[1:6]
PREFIX = os.path.join(FOLDER, "prefix")
TRANSFER = '{"normalized": true, "color": [[0, 0.1, 0.2, 0.6], [1, 0.9, 0.2, 0.05]], "extinction": [[0, 0], [1, 6]]}'


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}:\n{done.stdout}")
    return done.stdout


def expect(what, good):
    print(what, "yes" if good else "NO")
    if not good:
        sys.exit(1)


def build(source, *options):
    folder = os.path.join(FOLDER, source)
    run(CMAKE, "-S", os.path.join(HERE, source), "-B", folder, "-G", "Ninja", "-DCMAKE_PREFIX_PATH=" + PREFIX, "-DCMAKE_CXX_COMPILER=" + COMPILER,
        "-DCMAKE_BUILD_TYPE=Release", *options)
    run(CMAKE, "--build", folder)
    return folder


def cube(n):
    """Points, values and the six tetrahedra about one diagonal of each of (n - 1)^3 cubes."""
    points, values, cells = [], [], []
    number = lambda x, y, z: x + n * (y + n * z)
    for i in range(n**3):
        x, y, z = i % n, i // n % n, i // n**2
        point = tuple(c / (n - 1) for c in (x, y, z))
        points.append(point)
        values.append(math.sin(9 * point[0]) * math.cos(7 * point[1]) + point[2])
        if max(x, y, z) == n - 1:
            continue
        ring = [number(x + a, y + b, z + c) for a, b, c in ((1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1), (1, 0, 1))]
        cells += [(i, ring[k], ring[(k + 1) % 6], number(x + 1, y + 1, z + 1)) for k in range(6)]
    return points, values, cells


def write(points, values, cells):
    def binary(name, kind, numbers):
        with open(os.path.join(FOLDER, name), "wb") as out:
            out.write(struct.pack("<%d%s" % (len(numbers), kind), *numbers))
    binary("points.f64", "d", [c for p in points for c in p])
    binary("values.f64", "d", values)
    binary("cells.u32", "I", [c for t in cells for c in t])
    with open(os.path.join(FOLDER, "transfer.json"), "w") as out:
        out.write(TRANSFER)
    path = os.path.join(FOLDER, "mesh.vtk")
    with open(path, "w") as out:
        out.write("# vtk DataFile Version 3.0\na cube\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        out.write(f"POINTS {len(points)} double\n" + "".join("%r %r %r\n" % p for p in points))
        out.write(f"CELLS {len(cells)} {5 * len(cells)}\n" + "".join("4 %d %d %d %d\n" % t for t in cells))
        out.write(f"CELL_TYPES {len(cells)}\n" + "10\n" * len(cells))
        out.write(f"POINT_DATA {len(points)}\nSCALARS s double 1\nLOOKUP_TABLE default\n" + "".join("%r\n" % v for v in values))
    return path


shutil.rmtree(FOLDER, ignore_errors=True)
os.makedirs(FOLDER)
run(CMAKE, "--install", BUILD, "--prefix", PREFIX, "--component", "library")
headers = sorted(os.listdir(os.path.join(PREFIX, "include", "tetralux")))
expect("only public headers are installed: " + " ".join(headers),
       headers == ["appearance.h", "error.h", "io.h", "mesh.h", "tetralux.h"] and os.listdir(os.path.join(PREFIX, "include")) == ["tetralux"])

outside = build("outside", "-DEXAMPLE=" + os.path.join(HERE, "..", "..", "..", "apps", "example.cpp"), "-DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON")
said = run(os.path.join(outside, "example"))
expect("the example draws, verifies and stops:\n" + said, "error: " in said and "stopped: yes" in said)
expect("it needs no VTK", "vtk" not in run("ldd", os.path.join(outside, "example")).lower())

points, values, cells = cube(12)
mesh = write(points, values, cells)
run(os.path.join(outside, "two_threads"), FOLDER)
picture = os.path.join(FOLDER, "picture.exr")
run(TETRALUX, "render", mesh, "-o", picture, "--tf", os.path.join(FOLDER, "transfer.json"), "--eye=2.3,1.7,2.9", "--target=0.5,0.5,0.5",
    "--up=0,1,0", "--fov", "30", "--size", "96x64", "--engine", "cpu", "--quiet")
drawn = [c for row in exr.read(picture) for pixel in row for c in pixel]
expect("the command line drew something", max(drawn) > 0.1)
for number in (0, 1):
    with open(os.path.join(FOLDER, "picture%d.f32" % number), "rb") as file:
        floats = struct.unpack("<%df" % len(drawn), file.read())
    expect("thread %d drew the command line's picture to the bit" % number, list(floats) == drawn)

with_io = build("with_io")
said = run(os.path.join(with_io, "with_io"), mesh)
found = re.match(r"(\d+) tetrahedra, (\d+) values from (\S+) to (\S+)\n", said)
expect("the readers read:\n" + said, found is not None and [float(number) for number in found.groups()] ==
       [len(cells), len(points), min(values), max(values)] and "not-there.vtu: " in said)
