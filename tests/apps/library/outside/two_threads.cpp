// SPDX-License-Identifier: Apache-2.0
//
// two_threads FOLDER: the mesh of points.f64, cells.u32 and values.f64 drawn by two renderers at once, each in a thread
// of its own, into picture0.f32 and picture1.f32. check_installed.py has the same view.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <tetralux/tetralux.h>

template <class T>
static std::vector<T> readAll(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
    const T* const first = reinterpret_cast<const T*>(bytes.data());
    return {first, first + bytes.size() / sizeof(T)};
}

int main(int, char** arguments) {
    const std::string folder = arguments[1];
    const auto mesh = tetralux::Mesh::fromTetrahedra(readAll<double>(folder + "/points.f64"),
                                                     readAll<std::uint32_t>(folder + "/cells.u32"));
    const std::vector<double> values = readAll<double>(folder + "/values.f64");
    const auto draw = [&](int number) {
        try {
            tetralux::RendererOptions options;
            options.engine = "cpu";
            tetralux::Renderer renderer(mesh, options);
            renderer.setField(tetralux::Field::onPoints(values));
            renderer.setTransferFunction(tetralux::TransferFunction::load(folder + "/transfer.json"));
            tetralux::Camera camera;
            camera.eye = {2.3, 1.7, 2.9};
            camera.target = {0.5, 0.5, 0.5};
            std::vector<float> rgba(4 * 96 * 64);
            for (int frame = 0; frame < 3; ++frame) renderer.render(camera, {rgba.data(), 96, 64, 4 * 96});
            std::ofstream out(folder + "/picture" + std::to_string(number) + ".f32", std::ios::binary);
            out.write(reinterpret_cast<const char*>(rgba.data()), static_cast<std::streamsize>(4 * rgba.size()));
        } catch (const tetralux::Error& error) {
            std::fprintf(stderr, "%s\n", error.what());
        }
    };
    std::thread other(draw, 1);
    draw(0);
    other.join();
}
