// SPDX-License-Identifier: Apache-2.0
//
// with_io MESH: what the file holds; a second line for what an Error says of a file that is not there.
#include <cstdio>

#include <tetralux/io.h>

int main(int, char** arguments) {
    const tetralux::MeshFile file = tetralux::read(arguments[1]);
    const tetralux::MeshField& field = file.field("s");
    std::printf("%zu tetrahedra, %zu values from %.17g to %.17g\n", file.mesh->tetrahedra(),
                field.field().values().size(), field.minimum(), field.maximum());
    try {
        tetralux::read("not-there.vtu");
    } catch (const tetralux::Error& error) {
        std::printf("%s\n", error.what());
    }
}
