// SPDX-License-Identifier: Apache-2.0
/// \file
/// Runs a program as a user would and keeps what it said.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace tetralux::tests {

struct Outcome {
    int status = -1;  ///< exit status; −signal when one ended the program
    std::string out, err;
};

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Runs `arguments` (the first is the program's path) in `folder`, standard input empty.
inline Outcome runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    const std::filesystem::path said =
        std::filesystem::temp_directory_path() / ("tetralux-said-" + std::to_string(::getpid()));
    const std::string out = said.string() + ".out", err = said.string() + ".err";
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        const auto redirect = [](const char* path, int flags, int target) {
            const int file = ::open(path, flags, 0600);
            if (file < 0 || ::dup2(file, target) < 0) ::_exit(126);
        };
        redirect("/dev/null", O_RDONLY, STDIN_FILENO);
        redirect(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
        redirect(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
        if (::chdir(folder.c_str()) != 0) ::_exit(126);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), contentOf(out), contentOf(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return outcome;
}

}  // namespace tetralux::tests
