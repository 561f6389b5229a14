// SPDX-License-Identifier: Apache-2.0
#include <apps/view/render_words.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/shape_options.h>

namespace tetralux::apps::view {

namespace {

/// render's options, and where they are put.
struct Parser {
    RenderOptions options;
    CLI::App app{"", "tetralux render"};
    Parser() { addRenderOptions(app, options); }
    const CLI::Option* find(const std::string& name) const { return app.get_option_no_throw(name); }
};

bool startsNumber(const std::string& text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0;
}

/// Its options say how often and where results are written.
bool isOutput(const CLI::Option& option) {
    return option.get_group() == "Output";
}

SceneRenderer::Change changeOf(const Parser& parser, const std::string& name) {
    const CLI::Option* option = parser.find(name);
    if (option == nullptr || option->get_group() == "Mesh") return SceneRenderer::Change::Mesh;
    const bool ofEngine = name == "--samples";  // stands among the camera's in the help
    return option->get_group() == "Camera" && !ofEngine ? SceneRenderer::Change::Camera : SceneRenderer::Change::Look;
}

std::vector<OptionWord> ofName(const OptionWords& words, const std::string& name) {
    std::vector<OptionWord> found;
    for (const OptionWord& word : words.options())
        if (word.name == name) found.push_back(word);
    return found;
}

}  // namespace

OptionWords wordsOf(const std::vector<std::string>& arguments) {
    std::vector<std::string> copies = arguments;
    std::vector<char*> pointers;
    for (std::string& copy : copies) pointers.push_back(copy.data());
    const std::vector<std::string> joined = joinedOptionalValues(static_cast<int>(pointers.size()), pointers.data());

    const Parser parser;
    OptionWords words;
    for (std::size_t i = 0; i < joined.size(); ++i) {
        const std::string& word = joined[i];
        if (!word.starts_with("-") || word == "-") {
            if (!words.mesh.empty())
                throw std::runtime_error(fmt::format("'{}': one mesh is shown, {}; leave one out", word, words.mesh));
            words.mesh = word;
            continue;
        }
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const CLI::Option* option = parser.find(name);
        if (option == nullptr || name == "--help")
            throw std::runtime_error(fmt::format("{}: there is no such option; see 'tetralux render --help'", name));
        if (isOutput(*option))
            throw std::runtime_error(
                fmt::format("{}: says where results go, which a view does not take; leave it out", name));
        if (equals != std::string::npos) {
            words.add(name, word.substr(equals + 1));
        } else if (option->get_items_expected_max() == 0) {
            words.add(name);
        } else if (option->get_items_expected_min() == 0) {
            if (i + 1 < joined.size() && startsNumber(joined[i + 1]))
                words.add(name, joined[++i]);
            else
                words.add(name);
        } else {
            if (i + 1 == joined.size()) throw std::runtime_error(fmt::format("{}: needs a value", name));
            words.add(name, joined[++i]);
        }
    }
    return words;
}

RenderOptions optionsOf(const OptionWords& words) {
    if (words.mesh.empty()) throw std::runtime_error("no mesh; give a file or a generated field, as bucky:32");
    Parser parser;
    std::vector<std::string> reversed{"-o", "view.png"};  // CLI11 takes words from the back
    const std::vector<std::string> given = words.arguments();
    reversed.insert(reversed.end(), given.begin(), given.end());
    std::reverse(reversed.begin(), reversed.end());
    try {
        parser.app.parse(reversed);
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(error.what());
    }
    finishShapeOptions(parser.options.shape, parser.options.settings);
    return parser.options;
}

SceneRenderer::Change changeBetween(const OptionWords& from, const OptionWords& to) {
    if (from.mesh != to.mesh) return SceneRenderer::Change::Mesh;
    const Parser parser;
    auto change = SceneRenderer::Change::Camera;
    for (const OptionWords* side : {&from, &to})
        for (const OptionWord& word : side->options())
            if (ofName(from, word.name) != ofName(to, word.name))
                change = std::max(change, changeOf(parser, word.name));
    return change;
}

}  // namespace tetralux::apps::view
