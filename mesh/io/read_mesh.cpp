// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/read_mesh.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/tet/procedural_field.h>

namespace tetralux::mesh {
namespace {

// One line per format; the first that accepts a source reads it.
const std::array formats{
    &vtkXmlFormat,  &legacyVtkFormat, &vtkHdfFormat, &listingFormat, &exodusFormat, &cgnsFormat,
    &ensightFormat, &openFoamFormat,  &ucdFormat,    &fluentFormat,  &imageFormat,  &rawFormat,
    &gmshFormat,    &meditFormat,     &tetgenFormat, &gzipFormat,    &meshioFormat, &standardInputFormat,
};

struct OtherKind {
    std::vector<const char*> extensions;
    const char* remedy;
};

// What people have that is no mesh or that nothing here reads, and what to do with it.
const std::array otherKinds{
    OtherKind{{".stl", ".off", ".ply", ".obj"}, "is a surface; make tetrahedra of it with `tetralux mesh`"},
    OtherKind{{".csv", ".xyz"}, "holds points; make tetrahedra of them with `tetralux mesh`"},
    OtherKind{{".htg"},
              "is a hyper tree grid, which is not read; make a grid of its leaves in ParaView (Hyper Tree Grid "
              "To Unstructured Grid) and save that as .vtu"},
    OtherKind{{".vtt", ".pvtt"},
              "is a table, which has no cells; save its points as .csv and give that to `tetralux "
              "mesh`"},
    OtherKind{{".sol"}, "holds the values of a MEDIT mesh; give the .mesh beside it"},
    OtherKind{{".face", ".edge", ".neigh", ".poly", ".smesh"}, "is no mesh by itself; give TetGen's .ele or .node"},
    OtherKind{{".hdf", ".hdf5", ".h5"},
              "is HDF5 of a kind that is not read; give the .xdmf beside it, or save it as .vtu in ParaView"},
    OtherKind{{".unv"}, "is not read; convert it to Gmsh's .msh or to .vtu (Gmsh)"},
    OtherKind{{".plt", ".szplt", ".tec", ".k", ".d3plot", ".rst", ".odb", ".post", ".fsdb"},
              "is not read; save it as .vtu, CGNS or Exodus in the program that wrote it or in ParaView"},
    OtherKind{{".png", ".jpg", ".tif", ".tiff", ".dcm", ".nii", ".nii.gz"},
              "is an image; save the volume as .nrrd, .mha or .vti (3D Slicer, ITK-SNAP)"},
};

std::string knownSources() {
    std::string list;
    for (const MeshFormat* format : formats) {
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", format->name, format->sources);
    }
    return list;
}

}  // namespace

const MeshFormat* formatOf(const std::string& source) {
    const auto found =
        std::find_if(formats.begin(), formats.end(), [&](const MeshFormat* f) { return f->accepts(source); });
    return found != formats.end() ? *found : nullptr;
}

ReadResult readMesh(const std::string& source, const ReadOptions& options) {
    if (parseProceduralSource(source)) {
        return *readOwnMesh(source, options);
    }
    if (const MeshFormat* const format = formatOf(source)) {
        return readAs(*format, source, options);
    }
    checkReadable(source);
    for (const OtherKind& kind : otherKinds) {
        if (hasExtension(source, kind.extensions)) {
            throw std::runtime_error(fmt::format("{}: {}", source, kind.remedy));
        }
    }
    throw std::runtime_error(fmt::format("{}: unknown kind of mesh; give one of {}", source, knownSources()));
}

}  // namespace tetralux::mesh
