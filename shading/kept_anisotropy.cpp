// SPDX-License-Identifier: Apache-2.0
#include <shading/kept_anisotropy.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/io/bookkeeping_names.h>

namespace tetralux::shading {

namespace {

constexpr int components = 6;

std::string fieldName(const AnisotropySettings& settings, const std::string& scalar) {
    return fmt::format("{}radius={},interval={},samples={},smoothing={}) of {}", mesh::anisotropyPrefix,
                       settings.radius, settings.interval, settings.samples, settings.smoothing, scalar);
}

bool areUsual(const AnisotropySettings& settings) {
    return fieldName(settings, "") == fieldName({}, "");
}

bool holdsTensorsOf(const mesh::Field& field, const std::string& scalar) {
    return field.association == mesh::Association::Point && field.components == components &&
           field.name.starts_with(mesh::anisotropyPrefix) && field.name.ends_with(") of " + scalar);
}

}  // namespace

mesh::Field tensorField(const std::vector<Tensor>& tensors, const AnisotropySettings& settings,
                        const std::string& scalar) {
    mesh::Field field{fieldName(settings, scalar), mesh::Association::Point, components, {}, true};
    field.values.reserve(tensors.size() * components);
    for (const Tensor& tensor : tensors) field.values.insert(field.values.end(), tensor.begin(), tensor.end());
    return field;
}

std::optional<std::vector<Tensor>> keptTensors(const std::vector<mesh::Field>& fields,
                                               const AnisotropySettings& settings, const std::string& scalar) {
    const auto find = [&](const auto& suits) {
        return std::find_if(fields.begin(), fields.end(),
                            [&](const mesh::Field& field) { return holdsTensorsOf(field, scalar) && suits(field); });
    };
    const std::string exact = fieldName(settings, scalar);
    auto found = find([&](const mesh::Field& field) { return field.name == exact; });
    if (found == fields.end() && areUsual(settings)) found = find([](const mesh::Field&) { return true; });
    if (found == fields.end()) return std::nullopt;
    if (!std::all_of(found->values.begin(), found->values.end(), [](double value) { return std::isfinite(value); }))
        throw std::runtime_error(fmt::format(
            "field '{}' has numbers that are not finite; keep it anew with --keep-anisotropy", found->name));
    std::vector<Tensor> tensors(found->values.size() / components);
    for (std::size_t i = 0; i < tensors.size(); ++i)
        std::copy_n(found->values.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                    tensors[i].begin());
    return tensors;
}

}  // namespace tetralux::shading
