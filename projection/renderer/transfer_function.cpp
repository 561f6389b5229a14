// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <preint/color_maps/color_maps.h>
#include <preint/function_words.h>
#include <preint/opacity_words.h>
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

TransferFunction TransferFunction::ofWords(const TransferWords& words) {
    return renderer::translated([&] {
        preint::FunctionWords of{words.opacity, words.opacities, words.unitDistance, words.opacityScale, {},
                                 words.logScale};
        if (words.range) of.range = glm::dvec2((*words.range)[0], (*words.range)[1]);
        return wrapped(preint::withWords(preint::preset(words.colorMap), of));
    });
}

TransferFunction TransferFunction::scaled(double factor) const {
    return renderer::translated([&] {
        preint::FunctionWords words;
        words.opacityScale = factor;
        return wrapped(preint::withWords(data().function, words));
    });
}

TransferFunction TransferFunction::stretched(double low, double high) const {
    return renderer::translated([&] {
        preint::FunctionWords words;
        words.range = glm::dvec2(low, high);
        return wrapped(preint::withWords(data().function, words));
    });
}

std::vector<std::string> TransferFunction::presets() {
    return preint::presetNames();
}

std::vector<std::string> TransferFunction::colorMaps() {
    return preint::colorMapNames();
}

std::vector<std::string> TransferFunction::opacities() {
    return preint::opacityWords();
}

}  // namespace tetralux
