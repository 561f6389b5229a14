// SPDX-License-Identifier: Apache-2.0
// A program linked with TetGen as a whole is under the AGPL-3.0 (or later).
#include "tetrahedralize_tetgen.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

// The header defines terminatetetgen() inline; libtet's own copy throws an int, which its binary cannot unwind
// (SIGSEGV). As the symbol is weak there, the definition below takes its place, and the header's copy gets another
// name.
#define terminatetetgen terminateTetGenOfHeader
#include <tetgen.h>
#undef terminatetetgen

namespace {
constexpr int exitBase = 100;  // the child's exit codes are 100 + TetGen's own
}

void terminatetetgen(tetgenmesh*, int code);
void terminatetetgen(tetgenmesh*, int code) {
    _exit(exitBase + code);
}

namespace tetralux::mesher {
namespace {

/// Moves coordinates about the origin and to a size of about 1: TetGen's tolerances and predicates suffer far from it.
/// The scale is a power of two and the centre has few digits, so that next to no input coordinate is rounded.
struct Normalization {
    glm::dvec3 centre{0.0};
    double scale = 1.0;  // normalized = (p − centre)·scale

    explicit Normalization(const std::vector<glm::dvec3>& points) {
        glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
        for (const glm::dvec3& p : points) {
            for (int k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        if (!(size > 0.0) || !std::isfinite(size)) return;
        const double unit = std::exp2(std::floor(std::log2(size)));
        for (int k = 0; k < 3; ++k) centre[k] = std::round((0.5 * low[k] + 0.5 * high[k]) / unit) * unit;
        scale = 1.0 / unit;
    }
};

std::string reason(const ChildOutcome& outcome) {
    if (outcome.end == ChildOutcome::End::Signal) return fmt::format("TetGen crashed ({})", strsignal(outcome.code));
    switch (outcome.code - exitBase) {
        case 1:
            return "TetGen ran out of memory; allow larger cells (--max-volume, --quality)";
        case 3:
            return "TetGen found that the surface intersects itself";
        case 4:
            return "TetGen met a feature too small for it; remove tiny edges and slits";
        case 5:
            return "TetGen met two facets that lie too close to each other; move or merge them";
        case 10:
            return "TetGen refused the points: they lie in a plane, or some coordinates are far off the others";
        default:
            return fmt::format("TetGen gave up (code {})", outcome.code);
    }
}

/// Runs TetGen in a child and brings back what it made.
RawTetrahedra run(const std::vector<glm::dvec3>& points, const std::vector<Triangle>& triangles, std::string switches,
                  double maxVolume, double coplanarity, const Deadline& deadline) {
    const Normalization normal(points);
    const auto work = [&](const MessagePipe& pipe) {
        tetgenio in, out;
        in.firstnumber = 0;
        in.numberofpoints = static_cast<int>(points.size());
        in.pointlist = new REAL[3 * points.size()];
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int k = 0; k < 3; ++k) in.pointlist[3 * i + k] = (points[i][k] - normal.centre[k]) * normal.scale;
        in.numberoffacets = static_cast<int>(triangles.size());
        if (!triangles.empty()) in.facetlist = new tetgenio::facet[triangles.size()];
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            tetgenio::facet& facet = in.facetlist[i];
            tetgenio::init(&facet);
            facet.numberofpolygons = 1;
            facet.polygonlist = new tetgenio::polygon[1];
            tetgenio::init(&facet.polygonlist[0]);
            facet.polygonlist[0].numberofvertices = 3;
            facet.polygonlist[0].vertexlist = new int[3];
            for (std::size_t k = 0; k < 3; ++k) facet.polygonlist[0].vertexlist[k] = static_cast<int>(triangles[i][k]);
        }
        tetgenbehavior behaviour;
        if (!behaviour.parse_commandline(switches.data())) throw std::runtime_error("TetGen refused its options");
        behaviour.epsilon = coplanarity;
        if (maxVolume > 0.0) behaviour.maxvolume = maxVolume * normal.scale * normal.scale * normal.scale;
        tetrahedralize(&behaviour, &in, &out, nullptr, nullptr);

        std::string bytes;
        appendArray(bytes, std::vector<double>(out.pointlist, out.pointlist + 3 * std::max(out.numberofpoints, 0)));
        appendArray(bytes, std::vector<int>(out.tetrahedronlist,
                                            out.tetrahedronlist + 4 * std::max(out.numberoftetrahedra, 0)));
        std::vector<std::int32_t> regions;
        if (out.numberoftetrahedronattributes > 0)
            for (int i = 0; i < out.numberoftetrahedra; ++i)
                regions.push_back(
                    static_cast<int>(out.tetrahedronattributelist[i * out.numberoftetrahedronattributes]));
        appendArray(bytes, regions);
        pipe.send(MessageKind::Result, bytes);
        _exit(0);  // without the destructors: the result is out
    };
    ChildLimits limits;
    limits.deadline = deadline;
    const ChildOutcome outcome = runInChild(limits, work);
    using End = ChildOutcome::End;
    if (outcome.end == End::Error) throw std::runtime_error(fmt::format("TetGen: {}", outcome.error));
    if (outcome.end == End::TimedOut)
        throw std::runtime_error("TetGen did not end within the time limit (--time-limit)");
    if (outcome.end == End::Interrupted) throw std::runtime_error("TetGen was interrupted");
    if (outcome.end != End::Finished) throw std::runtime_error(reason(outcome));

    std::string_view bytes = outcome.result;
    const auto coordinates = takeArray<double>(bytes);
    const auto corners = takeArray<int>(bytes);
    RawTetrahedra result;
    result.regions = takeArray<std::int32_t>(bytes);
    result.points.resize(coordinates.size() / 3);
    for (std::size_t i = 0; i < result.points.size(); ++i)
        for (int k = 0; k < 3; ++k)  // the input's own points come back to the last bit
            result.points[i][k] =
                i < points.size() ? points[i][k] : coordinates[3 * i + k] / normal.scale + normal.centre[k];
    result.cells.resize(corners.size() / 4);
    for (std::size_t i = 0; i < result.cells.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) result.cells[i][k] = static_cast<std::uint32_t>(corners[4 * i + k]);
    if (result.cells.empty()) throw std::runtime_error("TetGen made no tetrahedra: the surface encloses nothing");
    return result;
}

}  // namespace

RawTetrahedra tetrahedralizeSurface(const TriangleSurface& surface, const TetGenOptions& options,
                                    const Deadline& deadline) {
    // p: a surface; A: number its regions; q, a: bounds; Y: keep the surface; Q: print nothing
    std::string switches = "pA";
    if (options.quality > 0.0) switches += fmt::format("q{:.6f}", options.quality);
    if (options.maxVolume > 0.0) switches += "a1.0";  // the number itself is set where the scale is known
    if (options.keepSurface) switches += "Y";
    return run(surface.points, surface.triangles, switches + "Q", options.maxVolume, options.coplanarity, deadline);
}

RawTetrahedra delaunayByTetGen(const std::vector<glm::dvec3>& points, const Deadline& deadline) {
    return run(points, {}, "Q", 0.0, 1e-8, deadline);
}

}  // namespace tetralux::mesher
