// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <apps/render_options.h>
#include <mesh/tet/tet_mesh.h>
#include <shading/anisotropy.h>

namespace tetralux::apps {

/// Anisotropy that comes with the data set, and what `--keep-anisotropy` writes.
class KeptAnisotropy {
public:
    /// Takes the kept tensors out of `mesh`, and a copy of the rest where it is to be written.
    KeptAnisotropy(const RenderOptions& options, mesh::TetMesh& mesh);

    /// Chooses those of the scalar that is shown, or computes and writes them if that is asked for.
    /// \throws std::runtime_error if they cannot be
    void find(const mesh::ScalarMesh& mesh, const std::string& scalar);

    /// nullptr: none are kept.
    const std::vector<shading::Tensor>* tensors() const { return tensors_ ? &*tensors_ : nullptr; }

private:
    const RenderOptions& options_;
    std::vector<mesh::Field> fields_;  ///< of tensors
    mesh::TetMesh toWrite_;
    std::optional<std::vector<shading::Tensor>> tensors_;
};

}  // namespace tetralux::apps
