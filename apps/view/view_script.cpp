// SPDX-License-Identifier: Apache-2.0
#include <apps/view/view_script.h>

#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

#include <apps/view/picture.h>
#include <projection/image/image_output.h>

namespace tetralux::apps::view {

namespace {

class ScriptRun {
public:
    explicit ScriptRun(OptionWords words) : state_(std::move(words)) { picture_.show(state_.words()); }

    void run(const std::vector<std::string>& command) {
        if (command.empty()) return;
        if (command.front() == "picture" && command.size() == 2) return takePicture(command[1]);
        if (command.front() == "command") return fmt::print("{}\n", state_.words().commandLine(nameOf(command)));
        const OptionWords before = state_.words();
        state_.mark();
        if (!state_.apply(command, picture_))
            throw std::runtime_error(
                fmt::format("there is no command '{}'; 'tetralux view --commands' lists them", command.front()));
        try {
            picture_.show(state_.words());
        } catch (...) {
            state_.reword(before);
            throw;
        }
    }

private:
    static std::string nameOf(const std::vector<std::string>& command) {
        return command.size() > 1 ? command[1] : "view.png";
    }

    void takePicture(const std::string& path) {
        projection::checkImagePath(path);
        projection::writeImage(picture_.renderer().render(0.0), path, picture_.options().png);
    }

    ViewState state_;
    Picture picture_;
};

}  // namespace

void runScript(std::istream& script, const std::string& name, OptionWords words) {
    ScriptRun run(std::move(words));
    std::string line;
    for (int number = 1; std::getline(script, line); ++number) {
        try {
            run.run(shellSplit(line));
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fmt::format("{}:{}: {}", name, number, error.what()));
        }
    }
}

}  // namespace tetralux::apps::view
