// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_scene.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <mesh/io/read_mesh.h>
#include <mesh/tet/procedural_field.h>

namespace tetralux::apps {

namespace {

using preint::ColorNode;
using preint::ExtinctionNode;
using preint::TransferFunction;

constexpr double orbitStep = 5.0 * std::numbers::pi / 180.0;

/// Ranges that a ray through a bucky ball runs through, up and down, by order of magnitude; so the scale-invariant
/// pictures are about as dense as the others.
constexpr double rangesAlongRay = 8.0;

const std::vector<ColorNode> fiveColors{{0.0, {0.10, 0.15, 0.60}},
                                        {0.25, {0.10, 0.65, 0.75}},
                                        {0.5, {0.35, 0.80, 0.30}},
                                        {0.75, {0.95, 0.80, 0.20}},
                                        {1.0, {0.85, 0.10, 0.10}}};
const std::vector<ExtinctionNode> fiveExtinctions{{0.0, 0.0}, {0.25, 1.5}, {0.5, 6.0}, {0.75, 14.0}, {1.0, 25.0}};

/// The scalar that only one cell in twenty exceeds, as a fraction of the range.
double rareFraction(const mesh::ScalarMesh& mesh) {
    std::vector<double> largest(mesh.cells.size());
    for (mesh::CellIndex cell = 0; cell < largest.size(); ++cell) {
        largest[cell] = mesh.scalarAt(cell, 0);
        for (int k = 1; k < 4; ++k) largest[cell] = std::max(largest[cell], mesh.scalarAt(cell, k));
    }
    const double range = mesh.scalarMax - mesh.scalarMin;
    if (largest.empty() || range <= 0.0) return 0.0;
    const auto rare = largest.begin() + static_cast<std::ptrdiff_t>(largest.size() - 1 - largest.size() / 20);
    std::nth_element(largest.begin(), rare, largest.end());
    // Above rounding: cells that only touch it from below must not show.
    return std::min((*rare - mesh.scalarMin) / range + 1e-9, 0.99);
}

TransferFunction smoothFunction(const mesh::ScalarMesh&) {
    return {.color = fiveColors, .extinction = fiveExtinctions, .isosurfaces = {}};
}

TransferFunction isosurfacesFunction(const mesh::ScalarMesh&) {
    return {.color = {{0.0, {0.0, 0.0, 0.0}}},
            .extinction = {},
            .isosurfaces = {{0.3, 0.4, {0.20, 0.55, 0.90}}, {0.6, 0.8, {0.95, 0.65, 0.15}}}};
}

TransferFunction veiledFunction(const mesh::ScalarMesh& mesh) {
    TransferFunction function = isosurfacesFunction(mesh);
    function.color = fiveColors;
    function.extinction = {{0.0, 0.1}, {1.0, 0.1}};
    return function;
}

TransferFunction opaqueFunction(const mesh::ScalarMesh&) {
    return {.color = fiveColors, .extinction = {{0.0, 0.0}, {0.08, 0.0}, {0.12, 300.0}}, .isosurfaces = {}};
}

TransferFunction constantFunction(const mesh::ScalarMesh&) {
    return {.color = {{0.0, {0.90, 0.75, 0.45}}}, .extinction = fiveExtinctions, .isosurfaces = {}};
}

TransferFunction sparseFunction(const mesh::ScalarMesh& mesh) {
    const double from = rareFraction(mesh);
    return {.color = fiveColors, .extinction = {{from, 0.0}, {1.0, 25.0}}, .isosurfaces = {}};
}

struct NamedFunction {
    const char* name;
    TransferFunction (*make)(const mesh::ScalarMesh&);  // scalars as fractions of the range
};
constexpr std::array functions{NamedFunction{"smooth", smoothFunction}, NamedFunction{"peaks", isosurfacesFunction},
                               NamedFunction{"opaque", opaqueFunction}, NamedFunction{"constant", constantFunction},
                               NamedFunction{"sparse", sparseFunction}, NamedFunction{"veiled", veiledFunction}};

bool isSizelessField(const std::string& scene) {
    const std::vector<std::string> names = mesh::proceduralFieldNames();
    return std::find(names.begin(), names.end(), scene) != names.end();
}

}  // namespace

std::uint64_t parseCellCount(const std::string& option, const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const std::string unit(stop, end);
    const double factor = unit.empty() ? 1.0 : unit == "k" ? 1e3 : unit == "M" ? 1e6 : 0.0;
    const double cells = value * factor;
    if (error != std::errc() || !(cells >= 1.0 && cells <= 1e9))
        throw std::runtime_error(fmt::format(
            "{}: '{}' is no number of cells from 1 to 1000M; give such as 0.15M, 150k or 148955", option, text));
    return static_cast<std::uint64_t>(std::llround(cells));
}

int gridSizeFor(std::uint64_t cells) {
    return std::max(2, static_cast<int>(std::lround(std::cbrt(static_cast<double>(cells) / 5.0))) + 1);
}

std::vector<std::string> benchSources(const std::vector<std::string>& scenes, const std::vector<std::uint64_t>& cells) {
    std::vector<std::string> sources;
    for (const std::string& scene : scenes) {
        if (!isSizelessField(scene)) {
            sources.push_back(scene);
            continue;
        }
        for (const std::uint64_t count : cells) sources.push_back(fmt::format("{}:{}", scene, gridSizeFor(count)));
    }
    return sources;
}

std::shared_ptr<const mesh::ScalarMesh> readBenchMesh(const std::string& source) {
    mesh::ReadResult read = mesh::readMesh(source, mesh::isolatedReading());
    try {
        mesh::ScalarSelection selection = mesh::selectScalar(std::move(read.mesh), "", read.report);
        return std::make_shared<const mesh::ScalarMesh>(std::move(selection.mesh));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", source, error.what()));
    }
}

std::vector<std::string> benchTransferFunctionNames() {
    std::vector<std::string> names;
    for (const NamedFunction& function : functions) names.emplace_back(function.name);
    return names;
}

preint::TransferFunction benchTransferFunction(const std::string& name, const mesh::ScalarMesh& mesh,
                                               projection::Mode mode) {
    for (const NamedFunction& named : functions) {
        if (name != named.name) continue;
        TransferFunction function = named.make(mesh);
        function.normalized = true;
        function.extinctionPerExtent = true;
        const double extent = projection::integralOf(mode) == preint::Integral::ScaleInvariant
                                  ? (mesh.scalarMax - mesh.scalarMin) * rangesAlongRay
                                  : mesh.bounds.diagonal() / std::numbers::sqrt3;
        return preint::resolved(function, mesh.scalarMin, mesh.scalarMax, extent);
    }
    throw std::runtime_error(fmt::format("--tf: there is no benchmark function '{}'; take some of {}", name,
                                         fmt::join(benchTransferFunctionNames(), ", ")));
}

double largestExtinction(const preint::TransferFunction& function) {
    double largest = 0.0;
    for (const ExtinctionNode& node : function.extinction) largest = std::max(largest, node.extinction);
    return largest;
}

projection::Camera benchCamera(const mesh::BoundingBox& bounds, const glm::ivec2& size, int frame) {
    projection::Camera camera;
    camera.width = size.x;
    camera.height = size.y;
    camera.target = bounds.centre();
    camera.eye = projection::threeQuarterEye(bounds, camera);
    return projection::orbited(camera, orbitStep * frame);
}

}  // namespace tetralux::apps
