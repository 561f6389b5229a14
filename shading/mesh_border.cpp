// SPDX-License-Identifier: Apache-2.0
#include <shading/mesh_border.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/vertex_buckets.h>
#include <shading/widest.h>

namespace tetralux::shading {

namespace {

/// Level sets that stand for all: the two of Gauss's rule for the weight 1 − h², or where all are near each other one.
constexpr std::size_t mostLevels = 2;
constexpr double thin = 0.1;                        // radii
constexpr double levelHeight = 0.4472135954999579;  // √(1/5)

constexpr double bentReach = 1.1;  ///< radii: bent discs leave the ball

glm::vec3 middleOf(const std::array<glm::vec3, 3>& corners) {
    return (corners[0] + corners[1] + corners[2]) / 3.0f;
}

float sizeOf(const std::array<glm::vec3, 3>& corners) {
    const glm::vec3 middle = middleOf(corners);
    return std::max(
        {glm::distance(corners[0], middle), glm::distance(corners[1], middle), glm::distance(corners[2], middle)});
}

float cross(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.y - a.y * b.x;
}

/// Directions of SeenDisc at angles in [0, angle of p), by a polynomial for the arc tangent (within 1e-5; the same for
/// the same p, so that lines that meet leave no gap).
int directionsBelow(const glm::vec3& p) {
    constexpr float perTurn = SeenDisc::directions / (2 * std::numbers::pi_v<float>),
                    quarter = SeenDisc::directions / 4;
    const float x = std::abs(p.x), y = std::abs(p.y), high = std::max(x, y);
    const float t = high > 0 ? std::min(x, y) / high : 0.0f, q = t * t;
    // Abramowitz & Stegun, Handbook of Mathematical Functions (1964), 4.4.47
    const float arc = t * (0.9998660f + q * (-0.3302995f + q * (0.1801410f + q * (-0.0851330f + q * 0.0208351f))));
    float angle = (y > x ? quarter : 0.0f) + (y > x ? -perTurn : perTurn) * arc;
    if (p.x < 0) angle = 2 * quarter - angle;
    if (p.y < 0) angle = 4 * quarter - angle;
    return static_cast<int>(std::ceil(angle - 0.5f));
}

struct Rays {
    SeenDisc::Values x, y;
};
const Rays& rays() {
    static const Rays all = [] {
        Rays found;
        for (std::size_t k = 0; k < SeenDisc::directions; ++k) {
            const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / SeenDisc::directions;
            found.x[k] = static_cast<float>(std::cos(angle));
            found.y[k] = static_cast<float>(std::sin(angle));
        }
        return found;
    }();
    return all;
}

}  // namespace

/// A disc being cut. One level set is seen, in a direction, out to where it leaves the mesh; what it enters again
/// counts again: every crossing takes or gives all that lies beyond it.
struct MeshBorder::Cut {
    glm::vec3 from, x, y, z;
    float xx, yy, xy, steepest;
    std::array<float, mostLevels> heights;
    std::size_t levels;
    std::array<SeenDisc, mostLevels> beyond{};  ///< what crossings took away
    std::array<int, mostLevels> outside{};  ///< how often the axis left the mesh between the point and the level set
    bool any = false;

    glm::vec3 flat(const glm::vec3& p) const {
        const glm::vec3 d = p - from;
        const float a = glm::dot(d, x), b = glm::dot(d, y);
        return {a, b, glm::dot(d, z) - (0.5f * (xx * a * a + yy * b * b) + xy * a * b)};
    }

    void crossAxis(const std::array<glm::vec3, 3>& p) {
        const float a = cross(p[1], p[2]), b = cross(p[2], p[0]), c = cross(p[0], p[1]);
        if ((a > 0) != (b > 0) || (b > 0) != (c > 0)) return;
        const float height = (a * p[0].z + b * p[1].z + c * p[2].z) / (a + b + c);
        for (std::size_t level = 0; level < levels; ++level)
            if (height * heights[level] > 0 && std::abs(height) < std::abs(heights[level])) {
                outside[level] += (a > 0) == (heights[level] > 0) ? 1 : -1;
                any = true;
            }
    }

    /// A face meets a level set in a line; seen from outside, the mesh's side of it is on the left of `way`.
    void crossLevel(const std::array<glm::vec3, 3>& p, std::size_t level) {
        const float h = heights[level];
        const std::array<bool, 3> up{p[0].z > h, p[1].z > h, p[2].z > h};
        if (up[0] == up[1] && up[1] == up[2]) return;
        glm::vec3 rise(0), fall(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t k = (i + 1) % 3;
            if (up[i] == up[k]) continue;
            const glm::vec3 &over = up[i] ? p[i] : p[k], &under = up[i] ? p[k] : p[i];  // the same for either face
            (up[i] ? fall : rise) = (under * (over.z - h) - over * (under.z - h)) / (over.z - under.z);
        }
        takeBeyond(fall, rise, beyond[level]);
    }

    /// Takes what lies beyond the line from every direction that it crosses.
    void takeBeyond(const glm::vec3& begin, const glm::vec3& end, SeenDisc& taken) {
        constexpr int count = SeenDisc::directions;
        const glm::vec3 way = end - begin;
        const float turn = cross(begin, way), sign = turn > 0 ? 1.0f : -1.0f;
        const int low = directionsBelow(turn > 0 ? begin : end), high = directionsBelow(turn > 0 ? end : begin);
        for (int i = low; i < (high < low ? high + count : high); ++i) {  // anticlockwise
            const auto k = static_cast<std::size_t>(i % count);
            const float distance = turn / (rays().x[k] * way.y - rays().y[k] * way.x);
            if (!(distance > 0.0f) || !(distance < 1.0f)) continue;
            const float square = distance * distance;
            taken.first[k] += sign * (SeenDisc::firstTo(1) - SeenDisc::firstTo(square));
            taken.third[k] += sign * (SeenDisc::thirdTo(1) - SeenDisc::thirdTo(square));
            taken.fifth[k] += sign * (SeenDisc::fifthTo(1) - SeenDisc::fifthTo(square));
            any = true;
        }
    }

    /// Mean of the levels; where a mesh overlaps itself shares stay between none and all.
    SeenDisc seen() const {
        SeenDisc sum;
        const auto add = [this](SeenDisc::Values& to, const SeenDisc::Values& taken, float whole, float axis) {
            for (std::size_t k = 0; k < SeenDisc::directions; ++k)
                to[k] += std::clamp(whole * axis - taken[k], 0.0f, whole) / static_cast<float>(levels);
        };
        for (std::size_t level = 0; level < levels; ++level) {
            const auto axis = static_cast<float>(1 - outside[level]);
            add(sum.first, beyond[level].first, SeenDisc::firstTo(1), axis);
            add(sum.third, beyond[level].third, SeenDisc::thirdTo(1), axis);
            add(sum.fifth, beyond[level].fifth, SeenDisc::fifthTo(1), axis);
        }
        return sum;
    }
};

MeshBorder::MeshBorder(const mesh::ScalarMesh& mesh, double radius)
    : cubes_(mesh, radius), inwards_(mesh.positions.size(), glm::vec3(0)) {
    const mesh::Adjacency adjacency = mesh::buildAdjacency(mesh.cells, mesh.positions.size());
    std::vector<Corners> found;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        for (std::size_t k = 0; k < 4; ++k) {
            if (adjacency.neighbours[cell][k] != mesh::Adjacency::noNeighbour) continue;
            glm::dvec3 middle(0);
            for (const mesh::PointIndex point : mesh.cells[cell]) middle += 0.25 * mesh.positions[point];
            Corners corners;
            for (std::size_t i = 0; i < 3; ++i) {
                const mesh::PointIndex point = mesh.cells[cell][static_cast<std::size_t>(mesh::faceVertices[k][i])];
                const glm::dvec3 place = mesh.positions[point];
                corners[i] = glm::vec3(cubes_.fromOrigin(place));
                inwards_[point] += glm::vec3(glm::normalize((middle - place) / radius));
            }
            addFace(corners, found);
        }
    const auto cubeOfFace = [&](std::size_t face) {
        return cubes_.cubeOf(cubes_.placeOf(glm::dvec3(middleOf(found[face]))));
    };
    const std::size_t cubes = cubes_.count();
    const mesh::VertexBuckets<std::uint64_t> buckets(found.size(), cubes, cubeOfFace);
    starts_.assign(cubes + 1, 0);
    std::vector<std::uint64_t> faces;
    for (std::size_t cube = 0; cube < cubes; ++cube) {
        faces.clear();
        for (std::size_t slot = buckets.begin(cube); slot < buckets.end(cube); ++slot)
            faces.push_back(buckets.item(slot));
        std::sort(faces.begin(), faces.end());  // the same sums in every run
        for (const std::uint64_t face : faces) {
            const Corners& c = found[face];
            const glm::vec3 middle = middleOf(c);
            corners_.push_back(c);
            x_.push_back(middle.x);
            y_.push_back(middle.y);
            z_.push_back(middle.z);
            size_.push_back(sizeOf(c));
        }
        starts_[cube + 1] = corners_.size();
    }
}

/// In parts that are not larger than `largestFace`, so that their middles tell which cubes they are near.
void MeshBorder::addFace(const Corners& corners, std::vector<Corners>& faces) const {
    if (static_cast<double>(sizeOf(corners)) <= largestFace()) {
        faces.push_back(corners);
        return;
    }
    const glm::vec3 &a = corners[0], &b = corners[1], &c = corners[2];
    const glm::vec3 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
    for (const Corners& part : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
        addFace(part, faces);
}

bool MeshBorder::isNear(const glm::dvec3& place) const {
    const glm::dvec3 from = cubes_.fromOrigin(place);
    const glm::vec3 at(from);
    const double reach = 1 + largestFace();
    int found = 0;
    cubes_.forRows(from - reach, from + reach, [&](const auto& first, const auto& last) {
        const std::size_t begin = starts_[cubes_.cubeOf(first)], end = starts_[cubes_.cubeOf(last) + 1];
        const float *xs = x_.data(), *ys = y_.data(), *zs = z_.data(), *sizes = size_.data();
        int count = 0;
#pragma omp simd reduction(+ : count)
        for (std::size_t i = begin; i < end; ++i) {
            const float x = xs[i] - at.x, y = ys[i] - at.y, z = zs[i] - at.z, span = 1.0f + sizes[i];
            count += x * x + y * y + z * z < span * span ? 1 : 0;
        }
        found += count;
    });
    return found > 0;
}

std::optional<SeenDisc> MeshBorder::cut(const glm::dvec3& place, mesh::PointIndex point, const BentDisc& disc) const {
    // a point of the border is looked at from just inside, where no face stands edge-on; generic, so that no corner is
    // hit
    const glm::dvec3 aside(3.7e-5, 5.9e-5, 7.1e-5);
    const glm::dvec3 from = cubes_.fromOrigin(place) + 1e-3 * glm::dvec3(inwards_[point]) + aside;
    Cut cut{glm::vec3(from), glm::vec3(disc.x), glm::vec3(disc.y), glm::vec3(disc.z), 0, 0, 0, 0, {}, mostLevels};
    cut.xx = static_cast<float>(disc.xx);
    cut.yy = static_cast<float>(disc.yy);
    cut.xy = static_cast<float>(disc.xy);
    cut.steepest = (std::max(std::abs(cut.xx), std::abs(cut.yy)) + std::abs(cut.xy));
    if (disc.thickness < thin)
        cut.levels = 1;
    else
        cut.heights = {static_cast<float>(-levelHeight * disc.thickness),
                       static_cast<float>(levelHeight * disc.thickness)};
    const double reach = bentReach + largestFace();
    cubes_.forRows(from - reach, from + reach, [&](const auto& first, const auto& last) {
        const std::size_t begin = starts_[cubes_.cubeOf(first)], end = starts_[cubes_.cubeOf(last) + 1];
        if (hasWideVectors())
            cutByFacesWide(begin, end, cut);
        else
            cutByFaces(begin, end, cut);
    });
    if (!cut.any) return std::nullopt;
    return cut.seen();
}

inline void MeshBorder::cutByFaces(std::size_t first, std::size_t last, Cut& cut) const {
    constexpr std::size_t atOnce = 64;
    std::array<float, atOnce> apart;  // ≤ 0: may meet a level set within the disc
    for (; first < last; first += atOnce) {
        const std::size_t count = std::min(atOnce, last - first);
        const float *xs = x_.data() + first, *ys = y_.data() + first, *zs = z_.data() + first;
        const float* sizes = size_.data() + first;
#pragma omp simd
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 d(xs[i] - cut.from.x, ys[i] - cut.from.y, zs[i] - cut.from.z);
            const float a = d.x * cut.x.x + d.y * cut.x.y + d.z * cut.x.z;
            const float b = d.x * cut.y.x + d.y * cut.y.y + d.z * cut.y.z;
            const float c = d.x * cut.z.x + d.y * cut.z.y + d.z * cut.z.z;
            const float steepX = cut.xx * a + cut.xy * b, steepY = cut.xy * a + cut.yy * b;
            const float height = c - 0.5f * (steepX * a + steepY * b), size = sizes[i], span = 1.0f + size;
            const float beside = a * a + b * b - span * span;
            // what is left between the face's middle and the level sets after the bend's second order
            const float rest = std::abs(height) - cut.heights[1] - cut.steepest * size * size;
            const float above = rest * std::abs(rest) - size * size * (1.0f + steepX * steepX + steepY * steepY);
            apart[i] = beside > above ? beside : above;
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (apart[i] > 0) continue;
            const Corners& c = corners_[first + i];
            const Corners flat{cut.flat(c[0]), cut.flat(c[1]), cut.flat(c[2])};
            cut.crossAxis(flat);
            for (std::size_t level = 0; level < cut.levels; ++level) cut.crossLevel(flat, level);
        }
    }
}

TETRALUX_WIDE void MeshBorder::cutByFacesWide(std::size_t first, std::size_t last, Cut& cut) const {
    cutByFaces(first, last, cut);
}

}  // namespace tetralux::shading
