// SPDX-License-Identifier: Apache-2.0
//
// The library in one function: a mesh, what is drawn of it, from where, and a picture. README.md shows this file.
//
//     tetralux-example MESH OUT.png
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include <mesh/io/read_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/camera.h>
#include <projection/frame/engine_registry.h>
#include <projection/image/image.h>

using namespace tetralux;

static void drawPicture(const std::string& source, const std::string& output) {
    mesh::ReadResult read = mesh::readMesh(source);  // read.report tells what was found on the way
    mesh::ScalarSelection field = mesh::selectScalar(std::move(read.mesh), "", read.report);

    projection::Scene scene;
    scene.mesh = std::make_shared<const mesh::ScalarMesh>(std::move(field.mesh));
    scene.transferFunction = preint::resolved(preint::preset("viridis"), scene.mesh->scalarMin, scene.mesh->scalarMax,
                                              scene.mesh->bounds.diagonal());

    projection::Camera camera;
    camera.target = scene.mesh->bounds.centre();
    camera.eye = projection::threeQuarterEye(scene.mesh->bounds, camera);

    const std::unique_ptr<projection::Engine> engine = projection::makeEngine(scene, {});
    projection::FrameReport report;  // times, cells drawn and skipped
    projection::writeImage(engine->render(camera, report), output);
}

int main(int argumentCount, char** arguments) {
    if (argumentCount != 3) {
        std::fputs("usage: tetralux-example MESH OUT.png\n", stderr);
        return 2;
    }
    try {
        drawPicture(arguments[1], arguments[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
