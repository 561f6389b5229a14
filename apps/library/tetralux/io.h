// SPDX-License-Identifier: Apache-2.0
/// \file
/// Meshes from files of any format that Tetralux reads (VTK, Exodus, CGNS, EnSight, OpenFOAM, Gmsh, MEDIT, TetGen,
/// image volumes, …), or generated ("bucky:32"). Link tetralux::io, the only part that needs VTK.
///
///     tetralux::MeshFile file = tetralux::read("engine.vtu");
///     tetralux::Renderer renderer(file.mesh);
///     renderer.setField(file.field("Temperature").field());
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralux/error.h>
#include <tetralux/mesh.h>

namespace tetralux {

/// How a file is read.
struct ReadOptions {
    std::optional<double> time;            ///< of a series: the step nearest to it; the first step when not given
    int subdivision = 0;                   ///< pieces along each edge of a curved cell; 0: as many as its order
    std::optional<double> mergeTolerance;  ///< points within this distance (mesh units) become one
    bool smoothCells = false;              ///< cell fields become point fields, by averaging
    /// The readers that are VTK's run in a forked child process: a damaged file ends in an Error, never this process.
    /// Only for a process none of whose threads may hold a lock just then.
    bool isolated = false;
};

/// A field of a file, with values for each point or tetrahedron of the file's mesh. Values are shared, not copied.
class MeshField {
public:
    const std::string& name() const { return name_; }  ///< as the file has it
    bool isOnPoints() const { return onPoints_; }      ///< else on cells
    int components() const { return components_; }     ///< 1: a scalar
    /// Names that the file gives its components ("xx", "xy", …), as many as there are, or none.
    const std::vector<std::string>& componentNames() const;
    bool isBookkeeping() const;  ///< numbers of points, cells or blocks: nobody wants to see them unasked
    /// `components()` numbers for each point or tetrahedron, as long as this field or a copy of it lives.
    std::span<const double> values() const;
    double minimum() const { return minimum_; }  ///< of the scalar, of a vector its magnitude, over finite values
    double maximum() const { return maximum_; }  ///< likewise

    Field field() const;  ///< the scalar, or the vector's magnitude
    /// One component, from 0. \throws Error (BadInput) if there is none such.
    Field component(int index) const;

    struct Data;                                           ///< the library's own
    explicit MeshField(std::shared_ptr<const Data> data);  ///< the library's own

private:
    Field made(std::vector<double> values) const;

    std::shared_ptr<const Data> data_;
    std::string name_;
    bool onPoints_ = true;
    int components_ = 1;
    double minimum_ = 0, maximum_ = 0;
};

/// What a file holds.
struct MeshFile {
    std::shared_ptr<const Mesh> mesh;  ///< checked
    std::vector<MeshField> fields;     ///< all that the file has
    std::vector<double> times;         ///< of all steps, if the source is a series; the mesh is that of one
    MeshReport report;                 ///< what checking found

    /// \throws Error (BadInput) listing the names that there are.
    const MeshField& field(std::string_view name) const;
};

/// Reads and checks a mesh. One call after another reads by VTK at a time, in whatever threads they are. \throws Error
/// naming the source, what is wrong and what would mend it.
MeshFile read(const std::string& source, const ReadOptions& options = {});

/// The same without VTK: generated fields, the common kinds of .vtu, Gmsh, MEDIT, TetGen, raw voxels. \throws Error
/// (Unsupported) for others.
MeshFile readOwn(const std::string& source, const ReadOptions& options = {});

}  // namespace tetralux
