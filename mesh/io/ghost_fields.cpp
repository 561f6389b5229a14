// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/ghost_fields.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace tetralux::mesh {
namespace {

/// Bits of "vtkGhostType" (vtkDataSetAttributes.h): a cell that another process has, that finer ones stand for, that
/// lies outside, that is blanked; a point that is blanked.
constexpr int hiddenCell = 1 | 8 | 16 | 32, hiddenPoint = 2, anyLevel = 0xff;

bool isMarked(double value, int mask) {
    return value >= 1.0 && value <= 255.0 && (static_cast<int>(value) & mask) != 0;
}

}  // namespace

void hideGhosts(CellSoup& soup) {
    const auto isGhost = [](const Field& field) {
        constexpr std::array<std::string_view, 3> names{"vtkGhostType", "vtkGhostLevels", "vtkValidPointMask"};
        return std::find(names.begin(), names.end(), field.name) != names.end();
    };
    for (const Field& field : soup.fields) {
        const bool onPoints = field.association == Association::Point;
        const bool levels = field.name == "vtkGhostLevels";
        if (!isGhost(field) || field.components != 1 || field.name == "vtkValidPointMask" || (onPoints && levels)) {
            continue;
        }
        soup.hidden.resize(soup.types.size(), 0);
        for (std::size_t cell = 0; cell < soup.types.size(); ++cell) {
            bool hidden = !onPoints && isMarked(field.values[cell], levels ? anyLevel : hiddenCell);
            for (std::uint64_t k = soup.offsets[cell]; onPoints && k < soup.offsets[cell + 1]; ++k) {
                const std::uint32_t p = soup.connectivity[k];
                hidden = hidden || (p < soup.points.size() && isMarked(field.values[p], hiddenPoint));
            }
            soup.hidden[cell] |= hidden ? 1 : 0;
        }
    }
    std::erase_if(soup.fields, isGhost);
}

}  // namespace tetralux::mesh
