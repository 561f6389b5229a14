// SPDX-License-Identifier: Apache-2.0
/// \file
/// Two tetrahedra with s = 1 + 2x + 3y + 4z on their five points, as every kind of file that can be written by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mesh_checks.h"

namespace tetralux::mesh::test {

struct SmallFile {
    std::string name, content;
};

struct SmallMesh {
    std::string source;            ///< what to open
    std::vector<SmallFile> files;  ///< the source among them
    bool hasValues = true;
};

inline constexpr double smallMeshVolume = 0.5;
inline double smallMeshField(const glm::dvec3& x) {
    return 1.0 + 2.0 * x.x + 3.0 * x.y + 4.0 * x.z;
}

inline std::string smallVtu() {
    return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<PointData><DataArray type="Float64" Name="s" format="ascii">1 3 4 5 10</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)";
}

inline std::vector<SmallMesh> smallMeshes() {
    const std::string series =
        "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"a.vtu\"/></Collection></VTKFile>";
    return {
        {"a.vtu", {{"a.vtu", smallVtu()}}},
        {"a.pvd", {{"a.pvd", series}, {"a.vtu", smallVtu()}}},
        {"a.vtpd",
         {{"a.vtpd",
           "<VTKFile type=\"vtkPartitionedDataSet\" version=\"1.0\"><vtkPartitionedDataSet><DataSet index=\"0\" "
           "file=\"a.vtu\"/></vtkPartitionedDataSet></VTKFile>"},
          {"a.vtu", smallVtu()}}},
        {"a.vtpc",
         {{"a.vtpc",
           "<VTKFile type=\"vtkPartitionedDataSetCollection\" version=\"1.0\"><vtkPartitionedDataSetCollection>"
           "<Partitions index=\"0\"><DataSet index=\"0\" file=\"a.vtu\"/></Partitions>"
           "</vtkPartitionedDataSetCollection></VTKFile>"},
          {"a.vtu", smallVtu()}}},
        {"a.vtk",
         {{"a.vtk",
           "# vtk DataFile Version 3.0\nsmall\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 "
           "1 1 1 1\nCELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\nCELL_TYPES 2\n10 10\nPOINT_DATA 5\nSCALARS s double "
           "1\nLOOKUP_TABLE default\n1 3 4 5 10\n"}}},
        {"a.msh",
         {{"a.msh",
           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 "
           "1\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 1 1 2 3 4 "
           "5\n$EndElements\n$NodeData\n1\n\"s\"\n1\n0\n3\n0\n1\n5\n1 1\n2 3\n3 4\n4 5\n5 10\n$EndNodeData\n"}}},
        {"a.mesh",
         {{"a.mesh",
           "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\nTetrahedra "
           "2\n1 2 3 4 1\n2 3 4 5 1\nEnd\n"},
          {"a.sol", "MeshVersionFormatted 2\nDimension 3\nSolAtVertices 5\n1 1\n1\n3\n4\n5\n10\nEnd\n"}}},
        {"a.ele",
         {{"a.ele", "2 4 0\n1 1 2 3 4\n2 2 3 4 5\n"},
          {"a.node", "5 3 1 0\n1 0 0 0 1\n2 1 0 0 3\n3 0 1 0 4\n4 0 0 1 5\n5 1 1 1 10\n"}}},
        {"a.inp",
         {{"a.inp",
           "# small\n5 2 1 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n1 1 tet 1 2 3 4\n2 1 tet 2 3 4 5\n1 1\ns, "
           "none\n1 1\n2 3\n3 4\n4 5\n5 10\n"}}},
        {"a.case",
         {{"a.case", "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: a.geo\nVARIABLE\nscalar per node: s a.s\n"},
          {"a.geo",
           "small\nmesh\nnode id off\nelement id off\npart\n         1\nall\ncoordinates\n         5\n 0.00000e+00\n "
           "1.00000e+00\n 0.00000e+00\n 0.00000e+00\n 1.00000e+00\n 0.00000e+00\n 0.00000e+00\n 1.00000e+00\n "
           "0.00000e+00\n 1.00000e+00\n 0.00000e+00\n 0.00000e+00\n 0.00000e+00\n 1.00000e+00\n 1.00000e+00\ntetra4\n  "
           "       2\n         1         2         3         4\n         2         3         4         5\n"},
          {"a.s",
           "values\npart\n         1\ncoordinates\n 1.00000e+00\n 3.00000e+00\n 4.00000e+00\n 5.00000e+00\n "
           "1.00000e+01\n"}}},
        {"a.cas",
         {{"a.cas",
           "(0 \"small\")\n(2 3)\n(10 (0 1 5 0 3))\n(10 (1 1 5 1 3)(\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n))\n(12 (0 1 "
           "2 "
           "0))\n(12 (2 1 2 1 2))\n(13 (0 1 7 0))\n(13 (3 1 1 2 3)(\n2 3 4 2 1\n))\n(13 (4 2 7 3 3)(\n1 3 2 1 0\n1 2 4 "
           "1 0\n1 4 3 1 0\n2 3 5 2 0\n3 4 5 2 0\n2 5 4 2 0\n))\n(45 (2 fluid fluid-1)())\n(45 (3 interior "
           "inside)())\n(45 (4 wall wall)())\n"}},
         false},
    };
}

/// `text` with `with` in place of the first `old`, which must be there.
inline std::string replaced(std::string text, const std::string& old, const std::string& with) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

/// The small mesh that is opened by `source`.
inline SmallMesh smallMesh(const std::string& source) {
    for (const SmallMesh& mesh : smallMeshes()) {
        if (mesh.source == source) {
            return mesh;
        }
    }
    ADD_FAILURE() << source;
    return {};
}

/// Writes the files into a folder and \returns the path to open.
inline std::string written(const SmallMesh& mesh, const TemporaryFolder& folder) {
    for (const SmallFile& file : mesh.files) {
        folder.write(file.name, file.content);
    }
    return folder.file(mesh.source);
}

}  // namespace tetralux::mesh::test
