// SPDX-License-Identifier: Apache-2.0
/// \file
/// Meshes that are hard to put in order: nonconvex, cyclic, touching in points, not conforming, overlapping.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <glm/geometric.hpp>

#include <tests/support/analytic_scenes.h>

namespace tetralux::test {

inline double diagonalWave(const glm::dvec3& p) {
    return 0.5 + 0.5 * std::sin(7.0 * p.x + 5.0 * p.y - 6.0 * p.z);
}

/// A mesh cell by cell; scalars are a wave over the places.
class CellHeap {
public:
    mesh::PointIndex point(const glm::dvec3& p) {
        mesh_.positions.push_back(p);
        mesh_.scalars.push_back(diagonalWave(p));
        return static_cast<mesh::PointIndex>(mesh_.positions.size() - 1);
    }
    /// Turned the right way round; left out when it has no volume.
    void cell(mesh::Tetrahedron c) {
        const auto& p = mesh_.positions;
        const double volume = mesh::sixVolumes(p[c[0]], p[c[1]], p[c[2]], p[c[3]]);
        if (volume < 0) std::swap(c[2], c[3]);
        if (volume != 0) mesh_.cells.push_back(c);
    }
    void tetrahedron(const std::array<glm::dvec3, 4>& p) { cell({point(p[0]), point(p[1]), point(p[2]), point(p[3])}); }
    /// Corners as of a VTK hexahedron: six cells around the diagonal from 0 to 6; the diagonals of touching faces
    /// agree.
    void hexahedron(const std::array<mesh::PointIndex, 8>& v) {
        constexpr int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
        for (const auto& [a, b] : path)
            cell({v[0], v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)], v[6]});
    }
    /// A bar of `steps` pieces whose four corners at each step `section(i, corner)` gives; closed: the last is the
    /// first.
    template <class Section>
    void bar(int steps, bool closed, Section section) {
        const auto first = static_cast<mesh::PointIndex>(mesh_.positions.size());
        for (int i = 0; i < (closed ? steps : steps + 1); ++i)
            for (int corner = 0; corner < 4; ++corner) point(section(i, corner));
        const auto at = [&](int i, int corner) {
            return first + static_cast<mesh::PointIndex>(4 * (closed ? i % steps : i) + corner);
        };
        for (int i = 0; i < steps; ++i)
            hexahedron(
                {at(i, 0), at(i, 1), at(i, 2), at(i, 3), at(i + 1, 0), at(i + 1, 1), at(i + 1, 2), at(i + 1, 3)});
    }
    mesh::ScalarMesh& mesh() { return mesh_; }
    mesh::ScalarMesh take() { return finished(std::move(mesh_)); }

private:
    mesh::ScalarMesh mesh_;
};

inline glm::dvec2 squareCorner(int corner) {
    return {corner == 1 || corner == 2 ? 1.0 : -1.0, corner >= 2 ? 1.0 : -1.0};
}

/// A chain of four rings, each through the next.
inline mesh::ScalarMesh interlockedRings() {
    CellHeap heap;
    for (int ring = 0; ring < 4; ++ring) {
        const glm::dvec3 centre(0.14 + 0.24 * ring, 0.5, 0.5);
        heap.bar(14, true, [&](int i, int corner) {
            const double angle = 2 * std::numbers::pi * i / 14;
            const glm::dvec2 c = 0.03 * squareCorner(corner);
            const double r = 0.17 + c.x;
            return centre + (ring % 2 == 0 ? glm::dvec3(r * std::cos(angle), r * std::sin(angle), c.y)
                                           : glm::dvec3(r * std::cos(angle), c.y, r * std::sin(angle)));
        });
    }
    return heap.take();
}

/// Three spiral stairs within one another about one axis.
inline mesh::ScalarMesh helices() {
    CellHeap heap;
    for (int helix = 0; helix < 3; ++helix)
        heap.bar(60, false, [&](int i, int corner) {
            const double angle = 0.35 * i + 2.1 * helix;
            const glm::dvec2 c = squareCorner(corner);
            const double r = 0.25 + 0.2 * c.x;
            return glm::dvec3(0.5 + r * std::cos(angle), 0.05 + 0.015 * i + 0.012 * c.y, 0.5 + r * std::sin(angle));
        });
    return heap.take();
}

/// Needles over one another, each over the next, in groups of `sides`.
inline void addCycle(CellHeap& heap, const glm::dvec3& centre, double size, int sides) {
    for (int i = 0; i < sides; ++i) {
        const double turn = 2 * std::numbers::pi * i / sides;
        const glm::dvec3 along = size * glm::dvec3(std::cos(turn), std::sin(turn), 0.35),
                         out = 0.45 * size * glm::dvec3(std::sin(turn), -std::cos(turn), 0),
                         across = 0.13 * size * glm::dvec3(-std::sin(turn), std::cos(turn), 0), up(0, 0, 0.07 * size);
        const glm::dvec3 m = centre + out;
        heap.tetrahedron({m - along - across, m - along + across, m + along - up, m + along + up});
    }
}

/// A cycle in each of n×n×n places: seen along z none of them has an order.
inline mesh::ScalarMesh manyCycles(int n) {
    CellHeap heap;
    for (int i = 0; i < n * n * n; ++i)
        addCycle(heap, (glm::dvec3(i % n, i / n % n, i / n / n) + 0.5) / static_cast<double>(n), 0.42 / n, 3 + i % 4);
    return heap.take();
}

/// Twisted prisms between two triangles without the inner cells that would make them convex (Schönhardt 1928): three
/// cells around, each behind the next.
inline mesh::ScalarMesh twistedPrisms(int n) {
    CellHeap heap;
    for (int i = 0; i < n * n; ++i) {
        const glm::dvec3 centre((i % n + 0.5) / n, (i / n + 0.5) / n, 0.5);
        std::array<glm::dvec3, 3> low, high;
        for (int k = 0; k < 3; ++k) {
            const double a = 2.0943951 * k, b = a + 0.5;
            const auto at = static_cast<std::size_t>(k);
            low[at] = centre + 0.4 / n * glm::dvec3(std::cos(a), std::sin(a), -0.7);
            high[at] = centre + 0.4 / n * glm::dvec3(std::cos(b), std::sin(b), 0.7);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            heap.tetrahedron({low[k], low[next], high[k], glm::mix(high[next], low[next], 0.25)});
        }
    }
    return heap.take();
}

/// Every other cube of a grid: they share corners and edges, but no face.
inline mesh::ScalarMesh chessCubes(int n) {
    return carved(boxMesh(n + 1, diagonalWave), [n](const glm::dvec3& p) {
        const glm::dvec3 cube = p * static_cast<double>(n);
        return (static_cast<int>(cube.x) + static_cast<int>(cube.y) + static_cast<int>(cube.z)) % 2 == 0;
    });
}

/// Layers of 1, 2, 4 and 8 cubes across, one upon the other: faces of one side against four of the other.
inline mesh::ScalarMesh hangingLayers() {
    CellHeap heap;
    double low = 0.0;
    for (int n = 1; n <= 8; n *= 2) {
        const double high = low + 0.25;
        const auto first = static_cast<mesh::PointIndex>(heap.mesh().positions.size());
        for (int z = 0; z <= 1; ++z)
            for (int y = 0; y <= n; ++y)
                for (int x = 0; x <= n; ++x)
                    heap.point({static_cast<double>(x) / n, static_cast<double>(y) / n, z == 0 ? low : high});
        const auto at = [&](int x, int y, int z) {
            return first + static_cast<mesh::PointIndex>((z * (n + 1) + y) * (n + 1) + x);
        };
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                heap.hexahedron({at(x, y, 0), at(x + 1, y, 0), at(x + 1, y + 1, 0), at(x, y + 1, 0), at(x, y, 1),
                                 at(x + 1, y, 1), at(x + 1, y + 1, 1), at(x, y + 1, 1)});
        low = high;
    }
    return heap.take();
}

/// Every third cell twice, the copy with points of its own or with the same.
inline mesh::ScalarMesh doubledCells(bool ownPoints) {
    mesh::ScalarMesh m = jitteredBoxMesh(5, 0.2, 7, diagonalWave);
    const std::size_t cells = m.cells.size();
    for (std::size_t i = 0; i < cells; i += 3) {
        mesh::Tetrahedron copy = m.cells[i];
        if (ownPoints)
            for (mesh::PointIndex& p : copy) {
                m.positions.push_back(glm::dvec3(m.positions[p]));
                m.scalars.push_back(double{m.scalars[p]});
                p = static_cast<mesh::PointIndex>(m.positions.size() - 1);
            }
        m.cells.push_back(copy);
    }
    return finished(std::move(m));
}

/// Cells of 1e-5 to 1 in size, all about one point far from the origin.
inline mesh::ScalarMesh farAndTiny() {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    CellHeap heap;
    for (int i = 0; i < 400; ++i) {
        const double size = std::pow(10.0, -5.0 + i % 6);
        const glm::dvec3 centre =
            glm::dvec3(0.5) + 0.5 * std::min(1.0, 8 * size) * glm::dvec3(unit(random), unit(random), unit(random));
        std::array<glm::dvec3, 4> p;
        for (auto& q : p) q = centre + 0.1 * size * glm::dvec3(unit(random), unit(random), unit(random));
        heap.tetrahedron(p);
    }
    for (glm::dvec3& p : heap.mesh().positions) p += glm::dvec3(1e7, -1e7, 1e7);
    return heap.take();
}

}  // namespace tetralux::test
