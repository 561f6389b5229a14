// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/point_blend.h>

#include <tbb/parallel_for.h>

namespace tetralux::mesh {
namespace {

std::uint64_t firstTerm(const PointBlends& blends, std::size_t i) {
    return i == 0 ? 0 : blends.ends[i - 1];
}

}  // namespace

void PointBlends::append(const PointBlends& other) {
    const std::uint64_t before = ids.size();
    ids.insert(ids.end(), other.ids.begin(), other.ids.end());
    weights.insert(weights.end(), other.weights.begin(), other.weights.end());
    for (const std::uint64_t end : other.ends) {
        ends.push_back(before + end);
    }
}

glm::dvec3 blendedPosition(const std::vector<glm::dvec3>& points, const PointBlends& blends, std::size_t i) {
    glm::dvec3 sum(0.0);
    for (std::uint64_t k = firstTerm(blends, i); k < blends.ends[i]; ++k) {
        sum += blends.weights[k] * points[blends.ids[k]];
    }
    return sum;
}

void appendBlendedPoints(CellSoup& soup, const PointBlends& blends) {
    const std::size_t before = soup.points.size();
    soup.points.resize(before + blends.size());
    tbb::parallel_for(std::size_t{0}, blends.size(),
                      [&](std::size_t i) { soup.points[before + i] = blendedPosition(soup.points, blends, i); });
    for (Field& field : soup.fields) {
        if (field.association != Association::Point) {
            continue;
        }
        const std::size_t components = static_cast<std::size_t>(field.components);
        field.values.resize((before + blends.size()) * components, 0.0);
        tbb::parallel_for(std::size_t{0}, blends.size(), [&](std::size_t i) {
            double* out = field.values.data() + (before + i) * components;
            for (std::uint64_t k = firstTerm(blends, i); k < blends.ends[i]; ++k) {
                for (std::size_t c = 0; c < components; ++c) {
                    out[c] += blends.weights[k] * field.values[blends.ids[k] * components + c];
                }
            }
        });
    }
}

}  // namespace tetralux::mesh
