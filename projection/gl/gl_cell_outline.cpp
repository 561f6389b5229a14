// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_cell_outline.h>

#include <projection/cells/projected_cell.h>

namespace tetralux::projection {
namespace {

CellOutline floats(const single_cell::OutlineCorners& corners) {
    CellOutline outline;
    for (std::size_t i = 0; i < 4; ++i) outline[i] = corners.at[i];
    return outline;
}

}  // namespace

CellOutline cellOutline(const std::array<glm::dvec2, 4>& corners, double margin) {
    return floats(single_cell::hullOutline({{corners[0], corners[1], corners[2], corners[3]}}, margin));
}

CellOutline cellOutline(const std::array<glm::dvec3, 4>& corners, const CameraFrame& frame, double margin) {
    single_cell::Triple v[4];
    for (std::size_t k = 0; k < 4; ++k) v[k] = {corners[k].x, corners[k].y, corners[k].z};
    return floats(single_cell::outlineOfCell(v, single_cell::viewOf(frame), margin));
}

}  // namespace tetralux::projection
