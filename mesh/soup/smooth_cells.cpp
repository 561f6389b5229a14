// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/smooth_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux::mesh {
namespace {

/// Calls `use(point)` once for each point that `cell` names.
template <class Use>
void forEachPoint(const CellSoup& soup, std::size_t cell, std::vector<std::uint32_t>& scratch, const Use& use) {
    scratch.assign(soup.connectivity.begin() + static_cast<std::ptrdiff_t>(soup.offsets[cell]),
                   soup.connectivity.begin() + static_cast<std::ptrdiff_t>(soup.offsets[cell + 1]));
    std::sort(scratch.begin(), scratch.end());
    scratch.erase(std::unique(scratch.begin(), scratch.end()), scratch.end());
    for (const std::uint32_t p : scratch) {
        if (p < soup.points.size()) {
            use(p);
        }
    }
}

std::vector<double> meanAtPoints(const CellSoup& soup, const std::vector<CellVerdict>& verdicts, const Field& field) {
    const std::size_t components = static_cast<std::size_t>(field.components);
    std::vector<double> sums(soup.points.size() * components, 0.0);
    std::vector<std::uint32_t> counts(soup.points.size(), 0);
    std::vector<std::uint32_t> scratch;
    for (std::size_t cell = 0; cell < verdicts.size(); ++cell) {
        const double* value = field.values.data() + cell * components;
        if (!isKept(verdicts[cell]) ||
            !std::all_of(value, value + components, [](double v) { return std::isfinite(v); })) {
            continue;
        }
        forEachPoint(soup, cell, scratch, [&](std::uint32_t p) {
            ++counts[p];
            for (std::size_t c = 0; c < components; ++c) {
                sums[p * components + c] += value[c];
            }
        });
    }
    for (std::size_t p = 0; p < counts.size(); ++p) {
        for (std::size_t c = 0; c < components; ++c) {
            double& mean = sums[p * components + c];
            mean = counts[p] > 0 ? mean / counts[p] : std::numeric_limits<double>::quiet_NaN();
        }
    }
    return sums;
}

}  // namespace

void smoothCellFields(CellSoup& soup, const std::vector<CellVerdict>& verdicts) {
    const auto taken = [&](const std::string& name) {
        return std::any_of(soup.fields.begin(), soup.fields.end(), [&](const Field& field) {
            return field.association == Association::Point && field.name == name;
        });
    };
    for (Field& field : soup.fields) {
        if (field.association == Association::Cell) {
            field.values = meanAtPoints(soup, verdicts, field);
            field.name = taken(field.name) ? field.name + " (smoothed)" : field.name;
            field.association = Association::Point;
        }
    }
}

}  // namespace tetralux::mesh
