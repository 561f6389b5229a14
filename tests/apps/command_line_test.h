// SPDX-License-Identifier: Apache-2.0
/// \file
/// A folder of its own for each test, with tiny input files, in which `tetralux` runs.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include <tests/support/program.h>
#include <tests/support/tiny_vtu.h>

namespace tetralux::tests {

/// Along the z axis through (1, 1) the corner tetrahedron is met from z = 1 to z = 0:
///
///     z                     x/4 + y/4 + z/2 ≤ 1
///     2 ·
///       | \  .
///       |    \   .  4 y
///       |_______\ .
///               4 x
inline TinyMesh cornerTetrahedron(double value) {
    return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 2}}, {{0, 1, 2, 3}}, {value, value, value, value}};
}

/// Options that see exactly that line in one pixel.
inline const char* const lineView = " --size 1x1 --eye 1,1,5 --target 1,1,0 --height 0.01 --engine reference";

class CommandLine : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() / fmt::format("tetralux-{}-{}", info->name(), ::getpid());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        write("constant.json", R"({"color": [[0, 1, 0.5, 0.25]], "extinction": [[0, 0.7]]})");
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

    /// `line` is split at spaces; quotes have no meaning.
    Outcome tetralux(const std::string& line) const { return tetraluxIn(folder_, line); }
    static Outcome tetraluxIn(const std::filesystem::path& folder, const std::string& line) {
        std::vector<std::string> arguments{TETRALUX_PROGRAM};
        std::istringstream words(line);
        for (std::string word; words >> word;) arguments.push_back(word);
        return runProgram(arguments, folder);
    }

    /// Exit 2, nothing on standard output, one line on standard error that begins as every error does and holds all of
    /// `parts`, and no new file.
    void expectRefused(const std::string& line, const std::vector<std::string>& parts) const {
        const auto before = fileNames();
        const Outcome outcome = tetralux(line);
        EXPECT_EQ(outcome.status, 2) << line << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "") << line;
        EXPECT_EQ(outcome.err.rfind("tetralux: ", 0), 0u) << line << "\n" << outcome.err;
        EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << line << "\n" << outcome.err;
        for (const std::string& part : parts)
            EXPECT_NE(outcome.err.find(part), std::string::npos)
                << line << "\nwants '" << part << "' in: " << outcome.err;
        EXPECT_EQ(fileNames(), before) << line;
    }

    void expectGood(const std::string& line) const {
        const Outcome outcome = tetralux(line);
        EXPECT_EQ(outcome.status, 0) << line << "\n" << outcome.err;
        EXPECT_EQ(outcome.err, "") << line;
    }

    std::vector<std::string> fileNames() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
            names.push_back(entry.path().string());
        std::sort(names.begin(), names.end());
        return names;
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(contentOf(folder_ / name)); }

    std::filesystem::path folder_;
};

}  // namespace tetralux::tests
