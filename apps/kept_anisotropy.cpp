// SPDX-License-Identifier: Apache-2.0
#include <apps/kept_anisotropy.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/io/bookkeeping_names.h>
#include <mesh/io/write_vtu.h>
#include <shading/kept_anisotropy.h>
#include <shading/vertex_light.h>

namespace tetralux::apps {

KeptAnisotropy::KeptAnisotropy(const RenderOptions& options, mesh::TetMesh& mesh) : options_(options) {
    const auto isTensor = [](const mesh::Field& field) { return field.name.starts_with(mesh::anisotropyPrefix); };
    const auto first = std::stable_partition(mesh.fields.begin(), mesh.fields.end(),
                                             [&](const mesh::Field& field) { return !isTensor(field); });
    fields_.assign(std::make_move_iterator(first), std::make_move_iterator(mesh.fields.end()));
    mesh.fields.erase(first, mesh.fields.end());
    if (!options.keptAnisotropy.empty()) toWrite_ = mesh;
}

void KeptAnisotropy::find(const mesh::ScalarMesh& mesh, const std::string& scalar) {
    const shading::AnisotropySettings& settings = options_.settings.shading.anisotropy;
    tensors_ = shading::keptTensors(fields_, settings, scalar);
    if (options_.keptAnisotropy.empty()) return;
    if (mesh.association == mesh::Association::Cell)
        throw std::runtime_error(fmt::format(
            "--keep-anisotropy: '{}' is on cells, where nothing changes within one; add --smooth-cells", scalar));
    if (!tensors_) {
        tensors_ = shading::vertexTensors(mesh, settings);
        fields_.push_back(shading::tensorField(*tensors_, settings, scalar));
    }
    std::move(fields_.begin(), fields_.end(), std::back_inserter(toWrite_.fields));
    mesh::writeVtu(options_.keptAnisotropy, toWrite_);
    toWrite_ = {};
}

}  // namespace tetralux::apps
