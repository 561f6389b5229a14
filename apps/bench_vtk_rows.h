// SPDX-License-Identifier: Apache-2.0
/// \file
/// VTK's mappers as rows of the same table: the program tetralux-bench-vtk draws the same mesh with the same integral
/// at the same cameras.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <apps/bench_engine.h>
#include <apps/bench_row.h>

namespace tetralux::apps {

/// What a benchmark calls VTK's mappers, without the "vtk:" before it.
std::vector<std::string> vtkMapperNames();

/// The program beside this one; nothing when it was not built.
std::optional<std::string> findVtkProgram();

/// A transfer function in VTK's terms: attenuation per `unitDistance`, between 0 and 1.
struct VtkTransferFunction {
    std::vector<std::array<double, 4>> color;        ///< s r g b
    std::vector<std::array<double, 2>> attenuation;  ///< s a
    double unitDistance = 1.0;                       ///< mesh units
};

/// Colour and extinction at all nodes of either, so that no integrator misses one. An isosurface becomes what VTK's
/// users draw: a tent, 1 % of the scalar range wide, whose optical depth is the isosurface's at the mean slope of the
/// cells that it crosses.
VtkTransferFunction vtkTransferFunction(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh);

/// A folder for files that pass between the programs; it goes with the object.
class ExchangeFolder {
public:
    ExchangeFolder();
    ~ExchangeFolder();
    ExchangeFolder(const ExchangeFolder&) = delete;
    ExchangeFolder& operator=(const ExchangeFolder&) = delete;
    std::filesystem::path file(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

class VtkBench {
public:
    /// Writes the mesh for the other program. \throws std::runtime_error when there is no space for it.
    VtkBench(std::string program, const mesh::ScalarMesh& mesh);

    /// The standard integral only: VTK has no other. Failures are told in the row.
    BenchRow measure(const projection::Scene& scene, const std::string& mapper, const BenchSubject& subject,
                     const ReferenceImages& reference, const FramePlan& plan) const;

private:
    std::string program_;
    ExchangeFolder folder_;
};

}  // namespace tetralux::apps
