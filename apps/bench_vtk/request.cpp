// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_vtk/request.h>

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tetralux::bench_vtk {

namespace {

std::ifstream openFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read; let `tetralux bench` write it", path));
    return file;
}

template <class T>
std::vector<T> readArray(std::ifstream& file, std::size_t count, const std::string& path) {
    std::vector<T> values(count);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    if (!file) throw std::runtime_error(fmt::format("{}: ends too early; let `tetralux bench` write it", path));
    return values;
}

}  // namespace

MeshArrays readMeshArrays(const std::string& path) {
    std::ifstream file = openFile(path);
    const auto counts = readArray<std::uint64_t>(file, 3, path);
    MeshArrays mesh;
    mesh.cellData = counts[2] != 0;
    mesh.positions = readArray<double>(file, 3 * counts[0], path);
    mesh.cells = readArray<std::uint32_t>(file, 4 * counts[1], path);
    mesh.scalars = readArray<double>(file, mesh.cellData ? counts[1] : counts[0], path);
    return mesh;
}

Request readRequest(const std::string& path) {
    std::ifstream file = openFile(path);
    const nlohmann::json json = nlohmann::json::parse(file);
    Request request;
    json.at("mesh").get_to(request.mesh);
    json.at("mapper").get_to(request.mapper);
    json.at("size").get_to(request.size);
    for (const nlohmann::json& camera : json.at("cameras"))
        request.cameras.push_back({camera.at("eye"), camera.at("target"), camera.at("up"), camera.at("fov")});
    json.at("judged").get_to(request.judged);
    json.at("budget_seconds").get_to(request.budgetSeconds);
    json.at("limit_seconds").get_to(request.limitSeconds);
    json.at("color").get_to(request.color);
    json.at("attenuation").get_to(request.attenuation);
    json.at("unit_distance").get_to(request.unitDistance);
    json.at("images").get_to(request.images);
    json.at("result").get_to(request.result);
    return request;
}

}  // namespace tetralux::bench_vtk
