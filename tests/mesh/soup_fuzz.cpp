// SPDX-License-Identifier: Apache-2.0
//
// Feeds validation with cells of any kind and any nonsense: whatever a reader returns must not break it, and what it
// lets through must be a sound mesh.
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <mesh/soup/validation.h>
#include <mesh/tet/mesh_statistics.h>

namespace {

using namespace tetralux::mesh;

class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    std::uint8_t next() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
    bool done() const { return at_ >= size_; }

private:
    const std::uint8_t* data_;
    std::size_t size_;
    std::size_t at_ = 0;
};

CellSoup makeSoup(Bytes& bytes) {
    CellSoup soup;
    const std::size_t points = bytes.next() % 64u;
    for (std::size_t i = 0; i < points; ++i) {
        const double x = bytes.next();
        const double y = bytes.next();
        soup.points.emplace_back(x == 255.0 ? 1.0 / 0.0 : x, y, bytes.next());
    }
    soup.offsets.push_back(0);
    soup.faceOffsets.push_back(0);
    while (!bytes.done() && soup.types.size() < 200) {
        soup.types.push_back(bytes.next());
        const std::size_t count = bytes.next() % 70u;
        for (std::size_t i = 0; i < count; ++i) {
            soup.connectivity.push_back(bytes.next());
        }
        soup.offsets.push_back(soup.connectivity.size());
        const std::size_t stream = soup.types.back() == 42 ? bytes.next() : 0u;
        for (std::size_t i = 0; i < stream; ++i) {
            soup.faceStream.push_back(bytes.next() % 16u);
        }
        soup.faceOffsets.push_back(soup.faceStream.size());
    }
    soup.fields.push_back({"s", Association::Point, 1, std::vector<double>(points, 1.0)});
    soup.fields.push_back({"c", Association::Cell, 2, std::vector<double>(2 * soup.types.size(), 2.0)});
    return soup;
}

void checkSound(const TetMesh& mesh) {
    for (const Tetrahedron& cell : mesh.cells) {
        for (const PointIndex p : cell) {
            if (p >= mesh.positions.size()) {
                __builtin_trap();
            }
        }
        if (!(sixVolumes(mesh.positions[cell[0]], mesh.positions[cell[1]], mesh.positions[cell[2]],
                         mesh.positions[cell[3]]) > 0.0)) {
            __builtin_trap();
        }
    }
    meshStatistics(mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    ReadOptions options;
    const std::uint8_t choice = bytes.next();
    options.subdivision = choice % 4;
    options.smoothCells = (choice & 4) != 0;
    if ((choice & 8) != 0) {
        options.mergeTolerance = 1.5;
    }
    try {
        checkSound(tetMeshFromSoup(makeSoup(bytes), options).mesh);
    } catch (const std::runtime_error&) {
    }
    return 0;
}
