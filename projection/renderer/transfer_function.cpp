// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <projection/renderer/errors.h>
#include <projection/renderer/mesh_data.h>

namespace tetralux {

namespace {

TransferFunction wrapped(preint::TransferFunction function) {
    return TransferFunction(
        std::make_shared<const TransferFunction::Data>(TransferFunction::Data{std::move(function)}));
}

}  // namespace

TransferFunction TransferFunction::parse(std::string_view json) {
    return renderer::translated(
        [&] { return wrapped(preint::parseTransferFunction(std::string(json), "transfer function")); });
}

TransferFunction TransferFunction::load(const std::filesystem::path& file) {
    return renderer::translated([&] { return wrapped(preint::readTransferFunction(file.string())); });
}

TransferFunction TransferFunction::preset(std::string_view name) {
    return renderer::translated([&] { return wrapped(preint::preset(std::string(name))); });
}

std::vector<std::string> TransferFunction::presets() {
    return preint::presetNames();
}

}  // namespace tetralux
