// SPDX-License-Identifier: Apache-2.0
/// \file
/// Sides of faces from planes in 16 bits: a filter before the exact predicate (Fortune & Van Wyk 1996). What it says is
/// certain; of some faces in ten thousand it says nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>
#include <projection/core/diagonal_units.h>

namespace tetralux::projection {

class RoundedPlanes {
public:
    RoundedPlanes() = default;
    /// 32 bytes per cell.
    explicit RoundedPlanes(const mesh::ScalarMesh& mesh);

    bool empty() const { return x_.empty(); }

    /// An eye and by how much a plane's value there may err, in steps of the planes' numbers.
    struct Eye {
        float x, y, z, w, error;
    };
    Eye eye(const CameraFrame& frame) const;

    /// Of `count` cells from `first` on. Bit k: face k certainly shows its outside to the eye; bit 4 + k: certainly its
    /// inside. The two cells of a face are told opposite things, or nothing.
    void sides(mesh::CellIndex first, std::size_t count, const Eye& eye, std::uint8_t* sides) const;

private:
    DiagonalUnits units_;
    // per face: unit normal, inwards, and constant over positions in mesh diagonals, in steps of 1/32767
    std::vector<std::int16_t> x_, y_, z_, w_;
};

}  // namespace tetralux::projection
