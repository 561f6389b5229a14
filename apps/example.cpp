// SPDX-License-Identifier: Apache-2.0
//
// The library in one function: a cube of tetrahedra is drawn, drawn in other colours, stopped and verified. README.md
// shows this file; CMakeLists.txt for it is two lines: find_package(tetralux REQUIRED) and
// target_link_libraries(example PRIVATE tetralux::tetralux).
#include <cmath>
#include <cstdio>
#include <vector>

#include <tetralux/tetralux.h>

static void drawCube() {
    const unsigned n = 16;  // points along each edge
    std::vector<double> xyz, values;
    std::vector<std::uint32_t> cells;
    const auto point = [&](unsigned x, unsigned y, unsigned z) { return x + n * (y + n * z); };
    for (unsigned i = 0; i < n * n * n; ++i) {
        const double x = i % n / (n - 1.0), y = i / n % n / (n - 1.0), z = i / n / n / (n - 1.0);
        xyz.insert(xyz.end(), {x, y, z});
        values.push_back(std::sin(9 * x) * std::cos(7 * y) + z);
        if (x == 1 || y == 1 || z == 1) continue;
        const unsigned a = i % n, b = i / n % n, c = i / n / n, last = point(a + 1, b + 1, c + 1);
        const unsigned ring[] = {point(a + 1, b, c),     point(a + 1, b + 1, c), point(a, b + 1, c),
                                 point(a, b + 1, c + 1), point(a, b, c + 1),     point(a + 1, b, c + 1)};
        for (int k = 0; k < 6; ++k) cells.insert(cells.end(), {i, ring[k], ring[(k + 1) % 6], last});
    }

    const auto mesh = tetralux::Mesh::fromTetrahedra(xyz, cells);
    tetralux::Renderer renderer(mesh);
    renderer.setField(tetralux::Field::onPoints(values));
    std::vector<float> rgba(4 * 256 * 256);  // ours, as all memory of pictures: linear, premultiplied
    const tetralux::ImageView image{rgba.data(), 256, 256, 4 * 256};
    const tetralux::Camera camera = tetralux::cameraHolding(mesh->bounds(), 256, 256);
    for (const char* colours : {"viridis", "cool-to-warm"}) {  // the second time the order is there already
        renderer.setTransferFunction(tetralux::TransferFunction::preset(colours));
        const tetralux::FrameResult frame = renderer.render(camera, image);
        std::printf("%s: %.1f ms, %llu cells\n", colours, frame.milliseconds,
                    static_cast<unsigned long long>(frame.cellsDrawn));
    }
    const tetralux::Verification error = renderer.verify(camera, image, 1000);
    std::printf("error: %.1e, in 95 of 100 cases at most %.1e\n", error.rmse, error.rmseBound);

    std::stop_source stop;
    stop.request_stop();  // any other thread may do that while the frame is drawn
    tetralux::Control control;
    control.stop = stop.get_token();
    std::printf("stopped: %s\n", renderer.render(camera, image, control).complete ? "no" : "yes");
}

int main() {
    try {
        drawCube();
    } catch (const tetralux::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
