// SPDX-License-Identifier: Apache-2.0
#include <shading/cut_disc.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace tetralux::shading {

namespace {

/// Shares of the whole disc's moments of fourth order: always, so that equations have a solution; and where all is
/// unseen. By trial: spheres come out within 1.1 near a mesh's edges and corners, cylinders keep 0.99 of their ratio
/// where one face cuts them.
constexpr double ridge = 0.02, ridgeUnseen = 2.0;

/// Per direction (1, cos², sin², cos·sin).
const std::array<glm::dvec4, SeenDisc::directions>& evenTerms() {
    static const auto all = [] {
        std::array<glm::dvec4, SeenDisc::directions> terms;
        for (std::size_t k = 0; k < terms.size(); ++k) {
            const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / terms.size();
            const double c = std::cos(angle), s = std::sin(angle);
            terms[k] = {1, c * c, s * s, c * s};
        }
        return terms;
    }();
    return all;
}

/// ∫ (1 − ρ²) b_i b_j dA, b = (1, x², y², xy).
glm::dmat4 gramMatrix(const SeenDisc& seen) {
    glm::dmat4 sum(0);
    for (std::size_t k = 0; k < SeenDisc::directions; ++k) {
        const glm::dvec4 b = evenTerms()[k];
        const double fifth = static_cast<double>(seen.fifth[k]);
        const glm::dvec4 row(seen.third[k], fifth * b.y, fifth * b.z, fifth * b.w);
        sum[0] += b * glm::dvec4(seen.first[k], seen.third[k], seen.third[k], seen.third[k]);
        for (int j = 1; j < 4; ++j) sum[j] += b[j] * row;
    }
    return sum * (2 * std::numbers::pi / SeenDisc::directions);
}

SeenDisc wholeDisc() {
    SeenDisc whole;
    whole.first.fill(SeenDisc::firstTo(1));
    whole.third.fill(SeenDisc::thirdTo(1));
    whole.fifth.fill(SeenDisc::fifthTo(1));
    return whole;
}

/// Share of the directions that are seen neither forwards nor backwards.
double unseenShare(const SeenDisc& seen) {
    constexpr std::size_t half = SeenDisc::directions / 2;
    float sum = 0;
    for (std::size_t k = 0; k < half; ++k) sum += std::max(seen.first[k], seen.first[k + half]);
    return 1 - static_cast<double>(sum / (half * SeenDisc::firstTo(1)));
}

}  // namespace

DiscMoments completed(const SeenDisc& seen, const DiscMoments& found) {
    static const glm::dmat4 whole = gramMatrix(wholeDisc());
    glm::dmat4 matrix = gramMatrix(seen);
    matrix[0][0] = std::max(matrix[0][0], 1e-6 * whole[0][0]);
    const double held = ridge + ridgeUnseen * unseenShare(seen);
    for (int i = 1; i < 4; ++i) matrix[i][i] += held * whole[i][i];
    const glm::dvec4 full = whole * (glm::inverse(matrix) * glm::dvec4(1, found.xx, found.yy, found.xy));
    const DiscMoments result{full.y / full.x, full.z / full.x, full.w / full.x};
    const bool sound = full.x > 0 && result.xx > 0 && result.xx * result.yy > result.xy * result.xy;
    return sound ? result : found;
}

}  // namespace tetralux::shading
