// SPDX-License-Identifier: Apache-2.0
#include <apps/bash_completion.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace tetralux::apps {

namespace {

/// What can be typed as it stands: "post-linear", "gl:egl"; not "N", "r,g,b" nor "".
bool isWord(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char letter) {
        return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '-' || letter == ':' ||
               letter == '_';
    });
}

std::vector<std::string> parts(const std::string& text, const std::string& between) {
    std::vector<std::string> found;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(between, begin), text.size());
        found.push_back(text.substr(begin, end - begin));
        begin = end + between.size();
    }
    return found;
}

/// The words of "none|gaussian|2x" as an option's type, else of "…: auto, cpu, gl" at the end of its help.
std::vector<std::string> valuesOf(const CLI::Option& option) {
    std::string type = option.get_type_name();
    std::erase_if(type, [](char letter) { return letter == '[' || letter == ']'; });
    std::vector<std::string> values = parts(type, "|");
    if (values.size() > 1) {
        std::erase_if(values, [](const std::string& value) { return !isWord(value); });
        return values;
    }
    const std::string& help = option.get_description();
    const std::size_t colon = help.rfind(": ");
    values = parts(colon == std::string::npos ? help : help.substr(colon + 2), ", ");
    const bool isList = values.size() > 1 && std::all_of(values.begin(), values.end(), isWord);
    return isList ? values : std::vector<std::string>{};
}

std::vector<std::string> namesOf(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

constexpr const char* script = R"(# What bash completes after `tetralux`; written by `tetralux --reference bash`.
_tetralux() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} choices=
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        choices="{}"
    else
        case ${{COMP_WORDS[1]}},$before in
{}        esac
        if [[ -z $choices && $word == -* ]]; then
            case ${{COMP_WORDS[1]}} in
{}            esac
        fi
    fi
    [[ -z $choices ]] || mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
}}
complete -o default -o bashdefault -F _tetralux tetralux
)";

}  // namespace

std::string bashCompletion(const CLI::App& program) {
    std::vector<std::string> commands;
    std::string values, options;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        commands.push_back(command->get_name());
        std::vector<std::string> all;
        for (const CLI::Option* option : command->get_options()) {
            const std::vector<std::string> names = namesOf(*option);
            all.insert(all.end(), names.begin(), names.end());
            const std::vector<std::string> words = valuesOf(*option);
            if (option->get_group().empty() || words.empty()) continue;
            for (const std::string& name : names)
                values += fmt::format("            {},{}) choices=\"{}\" ;;\n", command->get_name(), name,
                                      fmt::join(words, " "));
        }
        options += fmt::format("                {}) choices=\"{}\" ;;\n", command->get_name(), fmt::join(all, " "));
    }
    return fmt::format(script, fmt::join(commands, " "), values, options);
}

}  // namespace tetralux::apps
