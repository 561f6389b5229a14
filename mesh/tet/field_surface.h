// SPDX-License-Identifier: Apache-2.0
/// \file
/// A surface that was cut out of a mesh, with the mesh's fields, and the files that hold it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <mesh/tet/mesh_cut.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

struct FieldSurface {
    std::vector<glm::dvec3> positions;  ///< mesh units
    std::vector<std::array<PointIndex, 3>> triangles;
    std::vector<Field> fields;  ///< Association::Cell: per triangle
};

/// The cut with all fields of the mesh: those of points interpolated along the edges, those of cells as they are.
FieldSurface surfaceOf(const TetMesh& mesh, const MeshCut& cut);

struct SurfaceMeasure {
    double area = 0.0;            ///< mesh units squared
    double volume = 0.0;          ///< by the divergence theorem: what a closed surface encloses, mesh units cubed
    std::uint64_t openEdges = 0;  ///< edges whose triangles do not make up for each other; 0: closed
};

SurfaceMeasure measure(const FieldSurface& surface);

/// .vtp keeps everything in double precision. .ply keeps everything too, names with other letters than A–Z, a–z, 0–9
/// and _ changed. .stl keeps the places alone, in single precision.
enum class SurfaceFormat { Vtp, Ply, Stl };

/// By the ending of `path`, in any case. \throws std::runtime_error naming the path.
SurfaceFormat surfaceFormat(const std::string& path);

/// The whole file. \throws std::runtime_error when the format cannot hold the surface.
std::string surfaceFile(const FieldSurface& surface, SurfaceFormat format);

}  // namespace tetralux::mesh
