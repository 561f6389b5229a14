// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/grid_soup.h>

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {

void addGridCells(CellSoup& soup, const std::array<std::size_t, 3>& points, std::uint8_t type) {
    const auto [nx, ny, nz] = points;
    if (nx < 2 || ny < 2 || nz < 2) {
        throw std::runtime_error(
            fmt::format("a grid of {} x {} x {} points has no volume; give one of at least 2 x 2 x 2", nx, ny, nz));
    }
    if (nx > CellSoup::invalidPoint / ny / nz) {
        throw std::runtime_error(fmt::format(
            "a grid of {} x {} x {} points is more than 32 bits can number; take a part of it", nx, ny, nz));
    }
    const std::size_t cells = (nx - 1) * (ny - 1) * (nz - 1);
    soup.types.assign(cells, type);
    soup.offsets.resize(cells + 1);
    soup.connectivity.resize(8 * cells);
    for (std::size_t i = 0; i <= cells; ++i) {
        soup.offsets[i] = 8 * i;
    }
    const bool around = type == cell_type::hexahedron;  // a hexahedron runs around its quadrilaterals
    const std::size_t layer = nx * ny;
    tbb::parallel_for(std::size_t{0}, nz - 1, [&, nx = nx, ny = ny](std::size_t k) {
        std::uint32_t* out = soup.connectivity.data() + 8 * (nx - 1) * (ny - 1) * k;
        for (std::size_t j = 0; j + 1 < ny; ++j) {
            for (std::size_t i = 0; i + 1 < nx; ++i) {
                for (const std::size_t height : {k, k + 1}) {
                    const std::size_t corner = i + nx * j + layer * height;
                    *out++ = static_cast<std::uint32_t>(corner);
                    *out++ = static_cast<std::uint32_t>(corner + 1);
                    *out++ = static_cast<std::uint32_t>(around ? corner + nx + 1 : corner + nx);
                    *out++ = static_cast<std::uint32_t>(around ? corner + nx : corner + nx + 1);
                }
            }
        }
    });
}

bool GridFrame::mirrors() const {
    return glm::dot(glm::cross(steps[0], steps[1]), steps[2]) < 0.0;
}

void mirrorVoxels(CellSoup& soup) {
    for (std::size_t i = 0; i + 1 < soup.connectivity.size(); i += 2) {
        std::swap(soup.connectivity[i], soup.connectivity[i + 1]);
    }
}

void placeGrid(CellSoup& soup, const std::array<std::size_t, 3>& points, const GridFrame& frame) {
    soup.points.resize(points[0] * points[1] * points[2]);
    tbb::parallel_for(std::size_t{0}, points[2], [&](std::size_t k) {
        glm::dvec3* out = soup.points.data() + points[0] * points[1] * k;
        for (std::size_t j = 0; j < points[1]; ++j) {
            const glm::dvec3 row =
                frame.origin + static_cast<double>(j) * frame.steps[1] + static_cast<double>(k) * frame.steps[2];
            for (std::size_t i = 0; i < points[0]; ++i) {
                *out++ = row + static_cast<double>(i) * frame.steps[0];
            }
        }
    });
    if (frame.mirrors()) {
        mirrorVoxels(soup);
    }
}

CellSoup gridSoup(const std::array<std::size_t, 3>& points, const std::string& source) {
    CellSoup soup;
    try {
        addGridCells(soup, points, cell_type::voxel);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", source, error.what()));
    }
    placeGrid(soup, points, {});
    return soup;
}

}  // namespace tetralux::mesh
