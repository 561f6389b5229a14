// SPDX-License-Identifier: Apache-2.0
//
// tetralux-bench-vtk REQUEST.json: draws what `tetralux bench` asks for with a mapper of VTK and writes times and
// pictures.
#include <time.h>
#include <unistd.h>

#include <exception>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <apps/bench_vtk/request.h>
#include <apps/bench_vtk/vtk_picture.h>

namespace {

using namespace tetralux::bench_vtk;

/// A line "VmHWM:  1234 kB" of /proc/self/status, in bytes.
std::uint64_t statusBytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
    return 0;
}

/// Processor time of all threads of this process so far.
double processorMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void writeImage(const std::string& path, const std::vector<float>& values) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(float)));
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be written; free some space there", path));
}

void run(const Request& request) {
    alarm(request.limitSeconds);  // a mapper that does not come back ends with SIGALRM
    nlohmann::json result;
    const MeshArrays mesh = readMeshArrays(request.mesh);
    const std::uint64_t before = statusBytes("VmRSS");
    VtkPicture picture(mesh, request);
    // Mappers prepare in their first frame; it is reported apart and not timed with the others.
    double spent = picture.draw(request.cameras.front());
    result["first_frame_ms"] = spent;
    result["frame_ms"] = nlohmann::json::array();
    result["processor_ms"] = nlohmann::json::array();
    int images = 0;
    for (std::size_t frame = 1; frame < request.cameras.size(); ++frame) {
        if (frame > 1 && spent > 1000.0 * request.budgetSeconds) break;
        const double processorBefore = processorMilliseconds();
        const double milliseconds = picture.draw(request.cameras[frame]);
        result["processor_ms"].push_back(processorMilliseconds() - processorBefore);
        spent += milliseconds;
        result["frame_ms"].push_back(milliseconds);
        if (images < request.judged) {
            writeImage(fmt::format("{}{}", request.images, images), picture.pixels());
            ++images;
        }
    }
    result["images"] = images;
    result["renderer"] = picture.renderer();
    result["vtk"] = vtkVersionText();
    result["peak_memory_bytes"] = statusBytes("VmHWM");
    result["memory_over_mesh_bytes"] = statusBytes("VmHWM") - before;
    std::ofstream file(request.result);
    file << result.dump(2) << '\n';
    if (!file.flush())
        throw std::runtime_error(fmt::format("{}: cannot be written; free some space there", request.result));
}

}  // namespace

int main(int argumentCount, char** arguments) {
    if (argumentCount != 2) {
        fmt::print(stderr, "tetralux-bench-vtk: give one request file; `tetralux bench` does so\n");
        return 2;
    }
    try {
        run(readRequest(arguments[1]));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "tetralux-bench-vtk: {}\n", error.what());
        return 2;
    }
}
