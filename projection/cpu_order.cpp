// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu_order.h>

#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <projection/boundary_reentry.h>
#include <projection/power_order.h>

namespace tetralux::projection {

CpuOrder::CpuOrder(const mesh::ScalarMesh& mesh) : mesh_(mesh) {
    {
        const mesh::Adjacency adjacency = mesh::buildAdjacency(mesh.cells, mesh.positions.size());
        const bool wellFormed = adjacency.nonManifoldFaces == 0 && adjacency.foldedFaces == 0;
        if (wellFormed && boundaryIsConvex(mesh, boundaryFaces(adjacency))) {
            const PowerOrder power(mesh, adjacency);
            if (power.failingFaces() == 0) buildPowerPlanes(power.heights());
        }
    }
    if (powerPlanes_.empty()) sorter_ = std::make_unique<VisibilitySorter>(mesh);
}

void CpuOrder::buildPowerPlanes(const std::vector<double>& heights) {
    powerPlanes_.resize(mesh_.cells.size());
    const double perLength = 1.0 / mesh_.bounds.diagonal();
    const glm::dvec3 centre = mesh_.bounds.centre();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh_.cells.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const mesh::Tetrahedron& cell = mesh_.cells[i];
            auto scaled = [&](std::size_t k) { return (mesh_.positions[cell[k]] - centre) * perLength; };
            const glm::dvec3 a = scaled(0), ab = scaled(1) - a, ac = scaled(2) - a, ad = scaled(3) - a;
            const glm::dvec3 cd = glm::cross(ac, ad), db = glm::cross(ad, ab), bc = glm::cross(ab, ac);
            const double h = heights[cell[0]];
            const glm::dvec3 gradient =
                ((heights[cell[1]] - h) * cd + (heights[cell[2]] - h) * db + (heights[cell[3]] - h) * bc) /
                glm::dot(ab, cd);
            powerPlanes_[i] = glm::dvec4(gradient, h - glm::dot(gradient, a));
        }
    });
}

CpuFrameOrder CpuOrder::orderOf(const CameraFrame& frame) const {
    CpuFrameOrder order;
    if (!powerPlanes_.empty()) {
        order.method = "power";
        order.keys.planes = powerPlanes_.data();
        order.keys.eye = frame.orthographic
                             ? glm::dvec4(-frame.forward, 0.0)
                             : glm::dvec4((frame.eye - mesh_.bounds.centre()) / mesh_.bounds.diagonal(), 1.0);
        return order;
    }
    VisibilityOrder sorted = sorter_->sort(frame);
    order.method = std::move(sorted.method);
    order.cyclicCells = sorted.cyclicCells;
    order.doubtfulPixels = std::move(sorted.doubtfulPixels);
    // cells that the order leaves out lie behind the eye
    order.places.assign(mesh_.cells.size(), static_cast<std::uint32_t>(mesh_.cells.size()));
    for (std::uint32_t i = 0; i < sorted.frontToBack.size(); ++i) order.places[sorted.frontToBack[i]] = i;
    order.keys.places = order.places.data();
    return order;
}

}  // namespace tetralux::projection
