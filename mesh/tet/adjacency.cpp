// SPDX-License-Identifier: Apache-2.0
/// \file
/// Faces are matched in buckets by their smallest vertex, and every bucket is sorted on its own. No hash table, 4 bytes
/// per face, any number of threads, and the result does not depend on how the threads ran.
#include <mesh/tet/adjacency.h>

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <mesh/tet/vertex_buckets.h>

namespace tetralux::mesh {
namespace {

/// The vertices of a face in ascending order, and whether outward order is an odd permutation of them.
struct SortedFace {
    PointIndex low, middle, high;
    bool odd;
};

SortedFace sortedFace(const Tetrahedron& cell, std::size_t k) {
    PointIndex a = cell[static_cast<std::size_t>(faceVertices[k][0])];
    PointIndex b = cell[static_cast<std::size_t>(faceVertices[k][1])];
    PointIndex c = cell[static_cast<std::size_t>(faceVertices[k][2])];
    bool odd = false;
    const auto order = [&odd](PointIndex& x, PointIndex& y) {
        if (y < x) {
            std::swap(x, y);
            odd = !odd;
        }
    };
    order(a, b);
    order(b, c);
    order(a, b);
    return {a, b, c, odd};
}

PointIndex smallestVertex(const Tetrahedron& cell, std::size_t k) {
    return std::min({cell[static_cast<std::size_t>(faceVertices[k][0])],
                     cell[static_cast<std::size_t>(faceVertices[k][1])],
                     cell[static_cast<std::size_t>(faceVertices[k][2])]});
}

struct FaceEntry {
    std::uint64_t key;   ///< middle and high vertex; all entries of a bucket share the low one
    std::uint64_t face;  ///< 4 · cell + k
    bool odd;
    bool operator<(const FaceEntry& other) const { return key != other.key ? key < other.key : face < other.face; }
};

struct Counts {
    std::uint64_t boundary = 0, nonManifold = 0, folded = 0;
};

/// Links the cells of equal faces in one sorted bucket.
void linkBucket(const std::vector<FaceEntry>& bucket, Adjacency& adjacency, Counts& counts) {
    for (std::size_t first = 0; first < bucket.size();) {
        std::size_t last = first + 1;
        while (last < bucket.size() && bucket[last].key == bucket[first].key) {
            ++last;
        }
        const std::size_t sharing = last - first;
        if (sharing == 1) {
            ++counts.boundary;
        } else if (sharing > 2) {
            ++counts.nonManifold;
        } else if (bucket[first].odd == bucket[first + 1].odd) {
            ++counts.folded;  // both cells lie on the same side
        } else {
            const std::uint64_t one = bucket[first].face;
            const std::uint64_t other = bucket[first + 1].face;
            adjacency.neighbours[one >> 2][one & 3] = static_cast<CellIndex>(other >> 2);
            adjacency.neighbours[other >> 2][other & 3] = static_cast<CellIndex>(one >> 2);
        }
        first = last;
    }
}

/// `FaceId` numbers faces as 4 · cell + k: 32 bits where they suffice, as this is the largest array here.
template <class FaceId>
void linkFaces(std::span<const Tetrahedron> cells, std::size_t pointCount, Adjacency& adjacency) {
    const VertexBuckets<FaceId> buckets(4 * cells.size(), pointCount,
                                        [&](std::size_t face) { return smallestVertex(cells[face >> 2], face & 3); });
    struct Worker {
        std::vector<FaceEntry> bucket;
        Counts counts;
    };
    tbb::enumerable_thread_specific<Worker> workers;
    using Range = tbb::blocked_range<std::size_t>;
    tbb::parallel_for(Range(0, pointCount, 1024), [&](const Range& range) {
        Worker& worker = workers.local();
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
            worker.bucket.clear();
            for (std::size_t slot = buckets.begin(p); slot < buckets.end(p); ++slot) {
                const std::uint64_t id = buckets.item(slot);
                const SortedFace face = sortedFace(cells[id >> 2], id & 3);
                worker.bucket.push_back({std::uint64_t{face.middle} << 32 | face.high, id, face.odd});
            }
            std::sort(worker.bucket.begin(), worker.bucket.end());
            linkBucket(worker.bucket, adjacency, worker.counts);
        }
    });
    for (const Worker& worker : workers) {
        adjacency.boundaryFaces += worker.counts.boundary;
        adjacency.nonManifoldFaces += worker.counts.nonManifold;
        adjacency.foldedFaces += worker.counts.folded;
    }
}

}  // namespace

Adjacency buildAdjacency(std::span<const Tetrahedron> cells, std::size_t pointCount) {
    constexpr CellIndex none = Adjacency::noNeighbour;
    Adjacency adjacency;
    adjacency.neighbours.assign(cells.size(), {none, none, none, none});
    if (cells.size() < (std::size_t{1} << 30)) {
        linkFaces<std::uint32_t>(cells, pointCount, adjacency);
    } else {
        linkFaces<std::uint64_t>(cells, pointCount, adjacency);
    }
    return adjacency;
}

}  // namespace tetralux::mesh
