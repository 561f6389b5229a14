// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the module `tetralux._core` is made of. It is the package's own: people use the functions of `tetralux`.
#pragma once

#include <memory>

#include <nanobind/nanobind.h>

#include <tetralux/mesh.h>

namespace tetralux::python {

struct BoundMesh {
    std::shared_ptr<const Mesh> mesh;
    MeshReport report;
};

void bindMesh(nanobind::module_& module);
void bindRenderer(nanobind::module_& module);
void bindImage(nanobind::module_& module);

}  // namespace tetralux::python
