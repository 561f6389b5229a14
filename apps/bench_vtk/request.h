// SPDX-License-Identifier: Apache-2.0
/// \file
/// What `tetralux bench` asks tetralux-bench-vtk to draw. Both sides know these texts: apps/bench_vtk_rows.cpp writes
/// them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tetralux::bench_vtk {

/// The mesh file: three uint64 (points, cells, 1 if there is one scalar per cell), then double x y z per point, uint32
/// a b c d per cell, double scalar per point or cell; all in this machine's byte order.
struct MeshArrays {
    std::vector<double> positions;     ///< x y z
    std::vector<std::uint32_t> cells;  ///< a b c d
    std::vector<double> scalars;
    bool cellData = false;
};
MeshArrays readMeshArrays(const std::string& path);

struct RequestedCamera {
    std::array<double, 3> eye, target, up;
    double fovDegrees;  ///< vertical
};

/// {"mesh", "mapper", "size": [w, h], "cameras": [{"eye", "target", "up", "fov"}], "judged", "budget_seconds",
/// "limit_seconds", "color": [[s, r, g, b]], "attenuation": [[s, a]], "unit_distance", "images": prefix, "result":
/// path}
struct Request {
    std::string mesh, mapper;
    std::array<int, 2> size{};             ///< pixels
    std::vector<RequestedCamera> cameras;  ///< the first is the warm-up's
    int judged = 1;                        ///< images to write: of the cameras after the first
    double budgetSeconds = 20.0;           ///< no further frame once so much time is spent on frames
    unsigned limitSeconds = 1800;          ///< the program ends itself then
    std::vector<std::array<double, 4>> color;
    std::vector<std::array<double, 2>> attenuation;  ///< per unitDistance, at most 1
    double unitDistance = 1.0;                       ///< mesh units
    std::string images;  ///< image k goes to images + "k": float RGBA, linear premultiplied, row 0 at the top
    std::string result;  ///< JSON
};
Request readRequest(const std::string& path);

}  // namespace tetralux::bench_vtk
