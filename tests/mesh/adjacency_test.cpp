// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/adjacency.h>

#include <map>
#include <set>

#include <mesh/tet/procedural_field.h>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using FaceKey = std::array<PointIndex, 3>;

FaceKey faceKey(const Tetrahedron& cell, std::size_t k) {
    FaceKey key{};
    for (std::size_t v = 0; v < 3; ++v) {
        key[v] = cell[static_cast<std::size_t>(faceVertices[k][v])];
    }
    std::sort(key.begin(), key.end());
    return key;
}

/// By a map from faces to all that have them: another method, slow and plain.
std::vector<std::array<CellIndex, 4>> neighboursByMap(const std::vector<Tetrahedron>& cells) {
    std::map<FaceKey, std::vector<CellIndex>> sharing;
    for (CellIndex i = 0; i < cells.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            sharing[faceKey(cells[i], k)].push_back(i);
        }
    }
    std::vector<std::array<CellIndex, 4>> neighbours(cells.size());
    for (CellIndex i = 0; i < cells.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& both = sharing[faceKey(cells[i], k)];
            neighbours[i][k] = both.size() != 2 ? Adjacency::noNeighbour : both[0] == i ? both[1] : both[0];
        }
    }
    return neighbours;
}

TEST(Adjacency, AgreesWithAMapOfFaces) {
    TetMesh mesh = sampleOnGrid(proceduralField("coulomb", 9), 9);
    std::mt19937 random(7);
    std::shuffle(mesh.cells.begin(), mesh.cells.end(), random);
    mesh.cells.resize(mesh.cells.size() / 2);  // a ragged boundary
    const Adjacency adjacency = buildAdjacency(mesh.cells, mesh.positions.size());
    EXPECT_EQ(adjacency.neighbours, neighboursByMap(mesh.cells));
    EXPECT_EQ(adjacency.nonManifoldFaces, 0u);
    EXPECT_EQ(adjacency.foldedFaces, 0u);
}

TEST(Adjacency, CountsTheFacesOfACube) {
    const int n = 12;
    const TetMesh mesh = sampleOnGrid(proceduralField("coulomb", n), n);
    const Adjacency adjacency = buildAdjacency(mesh.cells, mesh.positions.size());
    EXPECT_EQ(adjacency.boundaryFaces, 6u * 2u * (n - 1) * (n - 1));
    for (CellIndex i = 0; i < mesh.cells.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const CellIndex other = adjacency.neighbours[i][k];
            if (other != Adjacency::noNeighbour) {
                const auto& back = adjacency.neighbours[other];
                EXPECT_EQ(std::count(back.begin(), back.end(), i), 1) << "cells " << i << " and " << other;
            }
        }
    }
}

TEST(Adjacency, FaceOfThreeCellsHasNoNeighbours) {
    const std::vector<Tetrahedron> cells{{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
    const Adjacency adjacency = buildAdjacency(cells, 6);
    EXPECT_EQ(adjacency.nonManifoldFaces, 1u);
    EXPECT_EQ(adjacency.boundaryFaces, 9u);
    for (const auto& neighbours : adjacency.neighbours) {
        EXPECT_EQ(std::count(neighbours.begin(), neighbours.end(), Adjacency::noNeighbour), 4);
    }
}

TEST(Adjacency, CellsOnTheSameSideAreNoNeighbours) {
    const std::vector<Tetrahedron> cells{{0, 1, 2, 3}, {0, 1, 2, 4}};
    const Adjacency adjacency = buildAdjacency(cells, 5);
    EXPECT_EQ(adjacency.foldedFaces, 1u);
    EXPECT_EQ(adjacency.neighbours[0][3], Adjacency::noNeighbour);
}

TEST(Adjacency, NothingOfNothing) {
    const Adjacency adjacency = buildAdjacency({}, 0);
    EXPECT_TRUE(adjacency.neighbours.empty());
    EXPECT_EQ(adjacency.boundaryFaces, 0u);
}

}  // namespace
}  // namespace tetralux::mesh
