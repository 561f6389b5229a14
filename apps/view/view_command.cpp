// SPDX-License-Identifier: Apache-2.0
//
// tetralux view: a picture that commands turn and change, with the command lines that draw what they led to.
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <apps/commands.h>
#include <apps/view/render_words.h>
#include <apps/view/view_script.h>
#include <apps/view/view_state.h>

namespace tetralux::apps {

namespace {

struct ViewOptions {
    std::string script;
    bool commands = false;
    std::vector<std::string> rest;  ///< mesh and options of render
};

int listCommands() {
    for (const view::ViewCommand& command : view::viewCommands())
        fmt::print("{:36} {}\n", command.name + " " + command.arguments, command.help);
    fmt::print("{:36} {}\n", "picture FILE", "writes the picture: .png or .exr");
    fmt::print("{:36} {}\n", "command [FILE]", "prints the command line that draws the same");
    return 0;
}

int runView(const ViewOptions& options) {
    if (options.commands) return listCommands();
    const view::OptionWords words = view::wordsOf(options.rest);
    const int threads = view::optionsOf(words).settings.threads;  // refuses now what render would refuse
    std::optional<tbb::global_control> threadLimit;
    if (threads > 0)
        threadLimit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    if (options.script.empty())
        throw std::runtime_error("view: no commands; give --script FILE, or --script - for standard input");
    if (options.script == "-") {
        view::runScript(std::cin, "standard input", words);
        return 0;
    }
    std::ifstream file(options.script);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read; give a file of commands", options.script));
    view::runScript(file, options.script, words);
    return 0;
}

}  // namespace

void addViewCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<ViewOptions>();
    CLI::App* command = program.add_subcommand(
        "view", "turns a mesh and changes what it shows by commands; takes MESH and the options of render that draw");
    command->allow_extras();
    command->add_option("--script", options->script, "runs the commands of FILE, one a line (-: standard input)")
        ->type_name("FILE");
    command->add_flag("--commands", options->commands, "lists the commands of scripts");
    command->callback([options, command, &chosen] {
        options->rest = command->remaining();
        chosen = [options] { return runView(*options); };
    });
}

}  // namespace tetralux::apps
