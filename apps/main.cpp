// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/command_reference.h>
#include <apps/commands.h>
#include <apps/mesh_command.h>
#include <apps/shape_options.h>

namespace {

using tetralux::apps::Command;

constexpr int badInput = 2;

constexpr void (*commands[])(CLI::App&, Command&) = {
    tetralux::apps::addRenderCommand,  tetralux::apps::addMeshCommand,  tetralux::apps::addInfoCommand,
    tetralux::apps::addExtractCommand, tetralux::apps::addBenchCommand, tetralux::apps::addCompareCommand,
    tetralux::apps::addColorsCommand,  tetralux::apps::addViewCommand,
};

/// Errors are one line each, whatever a library wrote.
int complain(std::string what) {
    for (char& letter : what)
        if (letter == '\n' || letter == '\r') letter = ' ';
    fmt::print(stderr, "tetralux: {}\n", what);
    return badInput;
}

std::string helpCommand(const CLI::App& program) {
    const auto named = program.get_subcommands();
    return named.empty() ? "tetralux --help" : fmt::format("tetralux {} --help", named.front()->get_name());
}

/// The first word when it looks like a command but is none; CLI11 would only say that one is missing.
std::string unknownCommand(const CLI::App& program, int argumentCount, char** arguments) {
    if (argumentCount < 2 || arguments[1][0] == '-') return "";
    for (const CLI::App* command : program.get_subcommands({}))
        if (command->get_name() == arguments[1]) return "";
    return arguments[1];
}

std::string commandNames(const CLI::App& program) {
    std::string names;
    for (const CLI::App* command : program.get_subcommands({}))
        names += fmt::format("{}{}", names.empty() ? "" : ", ", command->get_name());
    return names;
}

int run(int argumentCount, char** arguments) {
    CLI::App program("Tetralux draws volumes on unstructured meshes.", "tetralux");
    program.set_version_flag("--version", "tetralux " TETRALUX_VERSION);
    program.require_subcommand(1);
    Command chosen;
    for (const auto add : commands) add(program, chosen);
    program
        .add_option_function<std::string>(
            "--reference",
            [&program](const std::string& format) {
                fmt::print("{}", tetralux::apps::commandReference(program, format));
                throw CLI::Success();
            },
            "this program's reference page: markdown or man; bash: its completion")
        ->group("");  // for the pages, not for users: in no help
    if (const std::string word = unknownCommand(program, argumentCount, arguments); !word.empty())
        return complain(fmt::format("there is no command '{}'; take one of {}", word, commandNames(program)));
    try {
        std::vector<std::string> words = tetralux::apps::joinedOptionalValues(argumentCount, arguments);
        std::vector<char*> joined;
        for (std::string& word : words) joined.push_back(word.data());
        program.parse(static_cast<int>(joined.size()), joined.data());
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
        return complain(fmt::format("{}; see '{}'", error.what(), helpCommand(program)));
    }
    return chosen();
}

}  // namespace

int main(int argumentCount, char** arguments) {
    try {
        return run(argumentCount, arguments);
    } catch (const std::bad_alloc&) {
        return complain("this machine has not enough memory for it; take a smaller mesh, image or table");
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}
