# SPDX-License-Identifier: Apache-2.0
"""Fields of the gallery that `tetralux` does not generate itself, as legacy VTK files of points on a grid. Plain Python."""
import array
import math
import sys


def big_endian(numbers):
    values = array.array("f", numbers)
    if sys.byteorder == "little":
        values.byteswap()
    return values


def write(path, counts, low, high, value, tensor=None, tensors_name=None):
    """`value(x, y, z)` at counts[0] × counts[1] × counts[2] points from low to high, and the six numbers of `tensor(x, y, z)` if there is one."""
    steps = [(h - l) / (n - 1) for l, h, n in zip(low, high, counts)]
    xs, ys, zs = ([l + i * s for i in range(n)] for l, s, n in zip(low, steps, counts))
    values = big_endian(value(x, y, z) for z in zs for y in ys for x in xs)
    with open(path, "wb") as out:
        out.write(b"# vtk DataFile Version 3.0\ngallery\nBINARY\nDATASET STRUCTURED_POINTS\n")
        out.write(("DIMENSIONS %d %d %d\nORIGIN %r %r %r\nSPACING %r %r %r\n" % (*counts, *low, *steps)).encode())
        out.write(("POINT_DATA %d\nSCALARS s float 1\nLOOKUP_TABLE default\n" % len(values)).encode())
        values.tofile(out)
        if tensor is not None:
            out.write(("FIELD tensors 1\n%s 6 %d float\n" % (tensors_name.replace(" ", "%20"), len(values))).encode())
            big_endian(t for z in zs for y in ys for x in xs for t in tensor(x, y, z)).tofile(out)


def ellipsoid(path, a, b, c, points=33):
    """1 − √((x/a)² + (y/b)² + (z/c)²) on [−1, 1]³; a cylinder where c is infinite."""
    write(path, (points,) * 3, (-1,) * 3, (1,) * 3, lambda x, y, z: 1 - math.sqrt((x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2))


def curvature_tensor(value, x, y, z, step=1e-3):
    """(xx, yy, zz, xy, xz, yz) of Σ e eᵀ/√|κ| over the principal curvatures κ and directions e of the level set (Kindlmann et al. 2003), from
    differences of `value`: as long as the axes of Dupin's indicatrix, longest where the level set bends least."""
    at = (x, y, z)

    def moved(*moves):
        point = list(at)
        for axis, by in moves:
            point[axis] += by * step
        return value(*point)

    middle = value(*at)
    gradient = [(moved((i, 1)) - moved((i, -1))) / (2 * step) for i in range(3)]
    length = math.sqrt(sum(g * g for g in gradient))
    if length < 1e-9:
        return (0.0,) * 6
    n = [g / length for g in gradient]
    hessian = [[0.0] * 3 for _ in range(3)]
    for i in range(3):
        hessian[i][i] = (moved((i, 1)) + moved((i, -1)) - 2 * middle) / step ** 2
        for j in range(i):
            hessian[i][j] = hessian[j][i] = (moved((i, 1), (j, 1)) - moved((i, 1), (j, -1)) - moved((i, -1), (j, 1)) + moved((i, -1), (j, -1))) / (4 * step ** 2)
    # two directions within the level set, and the Hessian there
    least = min(range(3), key=lambda k: abs(n[k]))
    u = [(1.0 if k == least else 0.0) - n[least] * n[k] for k in range(3)]
    norm = math.sqrt(sum(c * c for c in u))
    u = [c / norm for c in u]
    v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]
    bend = lambda p, q: sum(p[i] * hessian[i][j] * q[j] for i in range(3) for j in range(3)) / length
    uu, uv, vv = bend(u, u), bend(u, v), bend(v, v)
    turn = 0.5 * math.atan2(2 * uv, uu - vv)
    result = [[0.0] * 3 for _ in range(3)]
    for angle in (turn, turn + math.pi / 2):
        e = [math.cos(angle) * p + math.sin(angle) * q for p, q in zip(u, v)]
        reach = 1 / math.sqrt(max(abs(bend(e, e)), 0.05))
        for i in range(3):
            for j in range(3):
                result[i][j] += reach * e[i] * e[j]
    return (result[0][0], result[1][1], result[2][2], result[0][1], result[0][2], result[1][2])


def packed_ellipsoids(path, tensors_name=None):
    """One layer of ellipsoids side by side, three times as long as wide in the middle of the row and round at its ends; with a name of tensors
    also those of the principal curvatures."""
    columns, rows, pitch = 7, 5, 1.0

    def value(x, y, z):
        i = min(max(round(x / pitch), 0), columns - 1)
        long = 1 + 2 * (1 - abs(i - 3) / 3)  # how much longer than wide
        count = rows * 3 / long
        height = rows * 3 * 0.9 * pitch
        step = height / round(count)
        k = min(max(math.floor(z / step), 0), round(count) - 1)
        dx, dz = (x - i * pitch) / (0.5 * pitch), (z - (k + 0.5) * step) / (0.5 * step)
        return 1 - math.sqrt(dx * dx + (y / (0.5 * pitch)) ** 2 + dz * dz)

    tensor = None if tensors_name is None else lambda x, y, z: curvature_tensor(value, x, y, z)
    write(path, (49, 9, 91), (-0.6, -0.6, -0.2), (6.6, 0.6, 13.7), value, tensor, tensors_name)


def tubes(path, points=41):
    """Tubes that wind about one another along three directions, a tangle as of vortices."""
    strands = []
    for axis in range(3):
        for i in range(2):
            for j in range(2):
                strands.append((axis, -0.5 + i + 0.17 * (axis - 1), -0.5 + j - 0.13 * axis, 1.3 * i + 2.1 * j + 0.9 * axis, 1 if (i + j) % 2 else -1))

    def value(x, y, z):
        most = 0.0
        p = (x, y, z)
        for axis, u0, v0, phase, way in strands:
            t, u, v = p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]
            du = u - u0 - 0.2 * math.cos(4.2 * way * t + phase)
            dv = v - v0 - 0.2 * math.sin(4.2 * way * t + phase)
            most += math.exp(-(du * du + dv * dv) / 0.011)
        return most

    write(path, (points,) * 3, (-1,) * 3, (1,) * 3, value)


def bytes(path, points=65):
    """Whole numbers from 0 to 255: a body of 20 to 60 with a denser frame and a shell in it."""
    def value(x, y, z):
        r = math.sqrt(x * x + y * y + z * z)
        skin = 30 + 12 * math.cos(5 * x) * math.cos(4 * y) if r < 0.9 else 4
        rib = 150 + 40 * math.sin(9 * math.atan2(y, x)) if 0.62 < math.hypot(x, y) < 0.72 and r < 0.9 else 0
        core = 230 if math.hypot(x - 0.15, y + 0.1) < 0.13 and r < 0.9 else 0
        return float(round(max(skin, rib, core, 0)))

    write(path, (points,) * 3, (-1,) * 3, (1,) * 3, value)


def octahedron(path):
    """A surface for the volume: about the middle of the unit cube."""
    with open(path, "w") as out:
        out.write("OFF\n6 8 0\n0.72 0.5 0.5\n0.28 0.5 0.5\n0.5 0.72 0.5\n0.5 0.28 0.5\n0.5 0.5 0.72\n0.5 0.5 0.28\n"
                  "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n")
