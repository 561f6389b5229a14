// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_vtk_rows.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <apps/bench_scene.h>
#include <mesh/io/run_program.h>
#include <projection/core/transfer_support.h>

namespace tetralux::apps {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr double tentWidth = 0.01;       // of the scalar range
constexpr double deepest = 7.0;          // optical depth that stands for an opaque isosurface
constexpr int secondsPerProgram = 1800;  // Z sweep of 5 million cells takes 43 s a frame on two cores
constexpr const char* meshFile = "mesh";

template <class T>
void writeArray(std::ofstream& file, const T* values, std::size_t count) {
    file.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

/// As apps/bench_vtk/request.h says.
void writeMesh(const mesh::ScalarMesh& mesh, const fs::path& path) {
    static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && sizeof(mesh::Tetrahedron) == 4 * sizeof(std::uint32_t));
    std::ofstream file(path, std::ios::binary);
    const std::array<std::uint64_t, 3> counts{mesh.positions.size(), mesh.cells.size(),
                                              mesh.association == mesh::Association::Cell ? 1u : 0u};
    writeArray(file, counts.data(), counts.size());
    writeArray(file, mesh.positions.data(), mesh.positions.size());
    writeArray(file, mesh.cells.data(), mesh.cells.size());
    writeArray(file, mesh.scalars.data(), mesh.scalars.size());
    if (!file.flush())
        throw std::runtime_error(fmt::format("{}: cannot be written; free some space there", path.string()));
}

/// Mean |gradient| of the cells that the isosurface crosses, scalar units per mesh unit, by volume.
double meanSlope(const mesh::ScalarMesh& mesh, double value) {
    double weighted = 0.0, volume = 0.0;
    for (mesh::CellIndex cell = 0; cell < mesh.cells.size(); ++cell) {
        const glm::dvec2 scalars = projection::scalarRange(mesh, cell);
        if (!(scalars.x < value && value <= scalars.y)) continue;
        const auto& [a, b, c, d] = mesh.cells[cell];
        const double size =
            mesh::sixVolumes(mesh.positions[a], mesh.positions[b], mesh.positions[c], mesh.positions[d]);
        weighted += size * glm::length(mesh::cellGradient(mesh, cell));
        volume += size;
    }
    return volume > 0.0 ? weighted / volume : 0.0;
}

/// Adds tents of extinction (per mesh unit) with their colours; everything else stays as it is.
preint::TransferFunction withTents(preint::TransferFunction function, const mesh::ScalarMesh& mesh) {
    const double half = 0.5 * tentWidth * (mesh.scalarMax - mesh.scalarMin);
    if (function.extinction.empty()) function.extinction.push_back({mesh.scalarMin, 0.0});
    if (!function.isosurfaces.empty()) function.color.clear();
    for (const preint::Isosurface& surface : function.isosurfaces) {
        const double depth = std::min(-std::log1p(-surface.opacity), deepest);
        const double peak = depth * meanSlope(mesh, surface.value) / half;  // the tent's area is peak·half
        for (const auto& [offset, extinction] : {std::pair(-half, 0.0), std::pair(0.0, peak), std::pair(half, 0.0)}) {
            function.extinction.push_back({surface.value + offset, extinction});
            function.color.push_back({surface.value + offset, surface.color});
        }
    }
    function.isosurfaces.clear();
    return function;
}

json cameraJson(const projection::Camera& camera) {
    const auto triple = [](const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); };
    return {{"eye", triple(camera.eye)},
            {"target", triple(camera.target)},
            {"up", triple(camera.up)},
            {"fov", camera.fovDegrees}};
}

projection::Image readRawImage(const fs::path& path, int width, int height) {
    projection::Image image(width, height);
    std::ifstream file(path, std::ios::binary);
    const auto size = static_cast<std::streamsize>(image.pixels.size() * sizeof(glm::vec4));
    if (!file.read(reinterpret_cast<char*>(image.pixels.data()), size))
        throw std::runtime_error(fmt::format("VTK's picture has not {}x{} pixels", width, height));
    return image;
}

bool isOnPath(const std::string& program) {
    const char* const path = std::getenv("PATH");
    if (path == nullptr) return false;
    std::string folders = path;
    for (std::size_t at = 0; at <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', at), folders.size());
        if (::access((folders.substr(at, end - at) + "/" + program).c_str(), X_OK) == 0) return true;
        at = end + 1;
    }
    return false;
}

/// Debian's VTK draws through X only; without a display it gets one of its own that nobody sees.
std::vector<std::string> commandLine(const std::string& program, const fs::path& request) {
    if (std::getenv("DISPLAY") == nullptr && isOnPath("xvfb-run"))
        return {"xvfb-run", "-a", "-s", "-screen 0 2048x2048x24", program, request.string()};
    return {program, request.string()};
}

void readResult(const json& result, BenchRow& row) {
    row.renderer = result.at("renderer");
    row.frameMilliseconds = result.at("frame_ms").get<std::vector<double>>();
    row.processorMilliseconds = result.at("processor_ms").get<std::vector<double>>();
    row.prepareTotalMilliseconds = result.at("first_frame_ms");
    row.prepareMilliseconds["first frame"] = row.prepareTotalMilliseconds;
    row.peakMemoryBytes = result.at("peak_memory_bytes");
    row.memoryOverMeshBytes = result.at("memory_over_mesh_bytes");
    row.cellsDrawn = row.subject.tetrahedra;
    row.setting = fmt::format("VTK {}", result.at("vtk").get<std::string>());
}

}  // namespace

std::vector<std::string> vtkMapperNames() {
    return {"projected", "ray-preint", "ray-partial", "ray-linear", "zsweep"};
}

std::optional<std::string> findVtkProgram() {
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    const fs::path beside = self.parent_path() / "tetralux-bench-vtk";
    if (!error && ::access(beside.c_str(), X_OK) == 0) return beside.string();
    return std::nullopt;
}

VtkTransferFunction vtkTransferFunction(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh) {
    const preint::TransferFunction smooth = withTents(function, mesh);
    VtkTransferFunction result;
    const double largest = largestExtinction(smooth);
    if (largest > 0.0) result.unitDistance = 1.0 / largest;
    std::vector<double> scalars;
    for (const preint::ColorNode& node : smooth.color) scalars.push_back(node.scalar);
    for (const preint::ExtinctionNode& node : smooth.extinction) scalars.push_back(node.scalar);
    std::sort(scalars.begin(), scalars.end());
    scalars.erase(std::unique(scalars.begin(), scalars.end()), scalars.end());
    for (const double s : scalars) {
        const glm::dvec3 color = smooth.colorAt(s);
        result.color.push_back({s, color.r, color.g, color.b});
        result.attenuation.push_back({s, smooth.extinctionAt(s) * result.unitDistance});
    }
    return result;
}

ExchangeFolder::ExchangeFolder() {
    std::string name = (fs::temp_directory_path() / "tetralux-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw std::runtime_error(
            fmt::format("{}: no folder can be made there; set TMPDIR to one that can be written to",
                        fs::temp_directory_path().string()));
    path_ = name;
}

ExchangeFolder::~ExchangeFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

VtkBench::VtkBench(std::string program, const mesh::ScalarMesh& mesh) : program_(std::move(program)) {
    writeMesh(mesh, folder_.file(meshFile));
}

BenchRow VtkBench::measure(const projection::Scene& scene, const std::string& mapper, const BenchSubject& subject,
                           const ReferenceImages& reference, const FramePlan& plan) const {
    BenchRow row;
    row.subject = subject;
    row.engine = "vtk:" + mapper;
    const VtkTransferFunction function = vtkTransferFunction(scene.transferFunction, *scene.mesh);
    json cameras = json::array();
    for (int frame = -1; frame < plan.frames; ++frame)
        cameras.push_back(cameraJson(benchCamera(scene.mesh->bounds, {subject.width, subject.height}, frame)));
    const json request = {{"mesh", folder_.file(meshFile).string()},
                          {"mapper", mapper},
                          {"size", {subject.width, subject.height}},
                          {"cameras", cameras},
                          {"judged", plan.judged},
                          {"budget_seconds", plan.budgetSeconds},
                          {"limit_seconds", secondsPerProgram},
                          {"color", function.color},
                          {"attenuation", function.attenuation},
                          {"unit_distance", function.unitDistance},
                          {"images", folder_.file("image").string()},
                          {"result", folder_.file("result").string()}};
    std::ofstream(folder_.file("request")) << request.dump();
    try {
        fs::remove(folder_.file("result"));
        mesh::runProgram(commandLine(program_, folder_.file("request")), folder_.file("output").string());
        const json result = json::parse(std::ifstream(folder_.file("result")));
        readResult(result, row);
        for (int image = 0; image < result.at("images").get<int>(); ++image) {
            judgeFrame(row, reference, static_cast<std::size_t>(image),
                       readRawImage(folder_.file(fmt::format("image{}", image)), subject.width, subject.height));
        }
    } catch (const std::exception& error) {
        row.failure = error.what();
        std::replace(row.failure.begin(), row.failure.end(), '\n', ' ');
    }
    return row;
}

}  // namespace tetralux::apps
