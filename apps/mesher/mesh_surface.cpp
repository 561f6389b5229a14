// SPDX-License-Identifier: Apache-2.0
#include "mesh_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "carry_field.h"
#include "surface_defects.h"
#include "tet_assembly.h"
#ifdef TETRALUX_CGAL
#include "check_surface_cgal.h"
#endif
#ifdef TETRALUX_TETGEN
#include "tetrahedralize_tetgen.h"
#endif

namespace tetralux::mesher {

#if defined(TETRALUX_CGAL) && defined(TETRALUX_TETGEN)
namespace {

constexpr double volumeTolerance = 1e-6;  // relative, between the cells and the surface

bool hasBorders(const SurfaceFindings& findings) {
    return std::any_of(findings.begin(), findings.end(), [](const auto& f) { return f.defect == SurfaceDefect::Hole; });
}

/// Formats that repeat points (STL), and files written from them, look full of holes until points that coincide to the
/// last bit are one. Done only where it closes the surface.
void mergeIfThatCloses(TriangleSurface& surface, const Listener& listener) {
    if (!hasBorders(checkTopology(surface))) return;
    TriangleSurface merged = surface;
    const std::uint64_t count = mergeCoincidentPoints(merged);
    if (count == 0 || hasBorders(checkTopology(merged))) return;
    surface = std::move(merged);
    listener.note(fmt::format("{} repeated points made one", count));
}

/// The surface, right, or an exception that names what is not. `repaired` tells whether its points are no longer the
/// input's.
void checkAndRepair(TriangleSurface& surface, const Options& options, const Listener& listener, nlohmann::json& report,
                    bool& repaired) {
    listener.stage("checking the surface");
    mergeIfThatCloses(surface, listener);
    bool turned = false;
    SurfaceFindings findings = checkSurface(surface, turned);
    for (const DefectFinding& finding : findings) report["defects"].push_back(describe({finding}));
    if (!findings.empty() && !options.repair)
        throw std::runtime_error(
            fmt::format("the surface cannot be filled: {}; {}", describe(findings), remedy(findings)));
    if (!findings.empty()) {
        listener.stage("mending the surface");
        listener.note("found: " + describe(findings));
        std::vector<std::string> done;
        surface = repairSurface(surface, done);
        repaired = true;
        for (const std::string& what : done) listener.note("mended: " + what);
        report["repairs"] = done;
        findings = checkSurface(surface, turned);
        if (surface.triangles.empty())
            throw std::runtime_error("nothing of the surface is left after mending: take another file");
        if (!findings.empty())
            throw std::runtime_error(
                fmt::format("--repair could not mend all: {}; mend it in a modelling program", describe(findings)));
    }
    if (turned) listener.note("mended: the surface faced inward and was turned");
    if (turned) report["repairs"].push_back("turned outward");
}

/// TetGen joins neighbouring facets that are nearly coplanar and then moves the surface a little; the smaller its
/// tolerance, the less, but a few inputs need the larger one. Where either misses the volume, no point is put on the
/// surface: then it cannot move.
Assembly fill(const TriangleSurface& surface, double volume, const Options& options, const Deadline& deadline,
              const Listener& listener) {
    struct Attempt {
        double coplanarity;
        bool keepSurface;
    };
    std::string problem;
    for (const Attempt attempt : {Attempt{1e-15, false}, Attempt{1e-8, false}, Attempt{1e-8, true}}) {
        try {
            const TetGenOptions bounds{options.quality, options.maxVolume, options.keepSurface || attempt.keepSurface,
                                       attempt.coplanarity};
            const RawTetrahedra raw = tetrahedralizeSurface(surface, bounds, deadline);
            Assembly assembly = assemble(raw, insideOf(surface, raw));
            const double error = std::abs(assembly.volume - volume) / volume;
            if (error <= volumeTolerance) return assembly;
            problem = fmt::format(
                "TetGen's cells miss the enclosed volume by {:.2g} of it: take coarser bounds (--quality, "
                "--max-volume)",
                error);
        } catch (const std::runtime_error& error) {
            problem = error.what();
            if (deadline && std::chrono::steady_clock::now() >= *deadline) break;
        }
        listener.stage("TetGen once more, with other tolerances");
    }
    throw std::runtime_error(problem);
}

/// What values are looked up on when mending has made new points: the surface as it came, without what has no place.
TriangleSurface finitePart(TriangleSurface surface) {
    const auto isFinite = [&](std::uint32_t i) {
        return std::isfinite(surface.points[i].x) && std::isfinite(surface.points[i].y) &&
               std::isfinite(surface.points[i].z);
    };
    std::erase_if(surface.triangles, [&](const Triangle& t) {
        if (!isFinite(t[0]) || !isFinite(t[1]) || !isFinite(t[2])) return true;
        const glm::dvec3 a = surface.points[t[0]], n = glm::cross(surface.points[t[1]] - a, surface.points[t[2]] - a);
        return !(glm::dot(n, n) > 0.0);
    });
    if (surface.triangles.empty()) return {};
    const glm::dvec3 somewhere = surface.points[surface.triangles[0][0]];
    for (std::uint32_t i = 0; i < surface.points.size(); ++i)
        if (!isFinite(i)) surface.points[i] = somewhere;
    return surface;
}

}  // namespace

mesh::TetMesh meshSurface(TriangleSurface&& surface, const Options& options, const Deadline& deadline,
                          const Listener& listener, nlohmann::json& report) {
    std::optional<TriangleSurface> original;
    if (options.repair && !surface.fields.empty()) original = finitePart(surface);
    bool repaired = false;
    checkAndRepair(surface, options, listener, report, repaired);
    const double volume = enclosedVolume(surface);
    if (!(volume > 0.0)) throw std::runtime_error("the surface encloses no volume: give one with an inside");
    listener.note(fmt::format("surface: {} points, {} triangles, closed, encloses {:.9g}", surface.points.size(),
                              surface.triangles.size(), volume));
    if (options.maxVolume > 0.0 && volume / options.maxVolume > 1e9)
        throw std::runtime_error(fmt::format("--max-volume {} asks for {:.1g} tetrahedra: take a larger one",
                                             options.maxVolume, volume / options.maxVolume));
    listener.stage("TetGen");
    Assembly assembly = fill(surface, volume, options, deadline, listener);
    if (assembly.flatCells > 0) listener.note(fmt::format("{} flat cells left out", assembly.flatCells));
    report["surface"] = {{"points", surface.points.size()},
                         {"triangles", surface.triangles.size()},
                         {"volume", volume},
                         {"volume_error", std::abs(assembly.volume - volume) / volume},
                         {"flat_cells", assembly.flatCells}};
    listener.stage("carrying the values inward");
    if (repaired && original)
        assembly.mesh.fields = carryFields(*original, assembly.mesh, assembly.source, false);
    else
        assembly.mesh.fields = carryFields(surface, assembly.mesh, assembly.source, true);
    return std::move(assembly.mesh);
}

#else

mesh::TetMesh meshSurface(TriangleSurface&&, const Options&, const Deadline&, const Listener&, nlohmann::json&) {
    throw std::runtime_error(
        "this tetralux-mesher was built without TetGen or CGAL, which surfaces need: build with TETRALUX_TETGEN=ON and "
        "TETRALUX_CGAL=ON");
}

#endif

}  // namespace tetralux::mesher
