// SPDX-License-Identifier: Apache-2.0
#include <tetralux/io.h>

#include <apps/library/mesh_file.h>
#include <mesh/io/read_mesh.h>
#include <projection/renderer/errors.h>

namespace tetralux {

MeshFile read(const std::string& source, const ReadOptions& options) {
    return renderer::translated(
        [&] { return library::meshFile(mesh::readMesh(source, library::checkedOptions(options))); });
}

}  // namespace tetralux
