// SPDX-License-Identifier: Apache-2.0
//
// `tetralux view --script`: its pictures are those of the command lines that it prints.
#include <random>

#include <apps/view/option_words.h>
#include <tests/apps/command_line_test.h>

namespace {

using namespace tetralux;
using tests::contentOf;
using tests::runProgram;

class ViewCommand : public tests::CommandLine {
protected:
    tests::Outcome script(const std::string& commands, const std::string& line = "bucky:8 --size 64x48") const {
        write("script", commands);
        return tetralux("view " + line + " --script script");
    }
    /// Draws the line that was printed, as a shell would.
    void draw(const std::string& line) const {
        std::vector<std::string> words = apps::view::shellSplit(line);
        ASSERT_GE(words.size(), 3u) << line;
        words[0] = TETRALUX_PROGRAM;
        words.push_back("--quiet");
        const tests::Outcome outcome = runProgram(words, folder_);
        EXPECT_EQ(outcome.status, 0) << line << "\n" << outcome.err;
    }
};

/// A random command that a hand could give.
std::string randomCommand(std::mt19937& random) {
    const auto number = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    switch (random() % 16) {
        case 0:
            return fmt::format("turn {} {}", number(-180, 180), number(-80, 80));
        case 1:
            return fmt::format("trackball {} {}", number(-180, 180), number(-180, 180));
        case 2:
            return fmt::format("roll {}", number(-180, 180));
        case 3:
            return fmt::format("zoom {} {} {}", number(0.7, 1.5), number(0, 63), number(0, 47));
        case 4:
            return fmt::format("pan {} {}", number(-9, 9), number(-9, 9));
        case 5:
            return "projection";
        case 6:
            return "view " + std::string(std::array{"x", "-y", "iso", "z"}[random() % 4]);
        case 7:
            return "fit";
        case 8:
            return fmt::format("node {} {}", number(0, 1), number(0, 9));
        case 9:
            return fmt::format("color {} {} {} {}", number(0, 1), number(0, 1), number(0, 1), number(0, 1));
        case 10:
            return fmt::format("isosurface {} {} 1 0.5 0.25", number(0, 1), number(0, 1));
        case 11:
            return "set mode " +
                   std::string(std::array{"standard", "scale-invariant", "mip", "average", "first-hit"}[random() % 5]);
        case 12:
            return fmt::format("density {}", number(0.5, 2));
        case 13:
            return fmt::format("add light {},{},{}", number(-1, 1), number(-1, 1), number(0.1, 1));
        case 14:
            return fmt::format("set clip-plane {},0,0,1,0.5,0", number(-0.3, 0.3));
        default:
            return fmt::format("set samples {}", 1 + random() % 4);
    }
}

TEST_F(ViewCommand, TwentyRandomStatesAreThoseOfTheirCommandLines) {
    std::mt19937 random(7);
    std::string commands;
    for (int state = 0; state < 20; ++state) {
        for (int i = 0; i < 6; ++i) commands += randomCommand(random) + "\n";
        commands += fmt::format("picture view{}.png\ncommand render{}.png\n", state, state);
    }
    const tests::Outcome outcome = script(commands);
    ASSERT_EQ(outcome.status, 0) << outcome.err << commands;
    std::istringstream lines(outcome.out);
    int state = 0;
    for (std::string line; std::getline(lines, line); ++state) {
        draw(line);
        EXPECT_EQ(contentOf(folder_ / fmt::format("view{}.png", state)),
                  contentOf(folder_ / fmt::format("render{}.png", state)))
            << line;
    }
    EXPECT_EQ(state, 20);
    EXPECT_NE(contentOf(folder_ / "view0.png"), contentOf(folder_ / "view1.png"));
}

TEST_F(ViewCommand, UndoGivesTheSamePicture) {
    const tests::Outcome outcome = script(
        "picture a.png\nturn 30 10\nset mode mip\npicture b.png\nundo\nundo\npicture c.png\nopen coulomb:6\n"
        "picture d.png\nundo\npicture e.png\n");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(contentOf(folder_ / "a.png"), contentOf(folder_ / "b.png"));
    EXPECT_NE(contentOf(folder_ / "a.png"), contentOf(folder_ / "d.png"));
    EXPECT_EQ(contentOf(folder_ / "a.png"), contentOf(folder_ / "c.png"));
    EXPECT_EQ(contentOf(folder_ / "a.png"), contentOf(folder_ / "e.png"));
}

TEST_F(ViewCommand, NamesTheLineOfAnError) {
    write("script", "turn 1 0\nturn 1\n");
    expectRefused("view bucky:8 --script script", {"script:2: turn: degrees is missing"});
    write("script", "dance\n");
    expectRefused("view bucky:8 --script script", {"script:1:", "dance"});
    write("script", "set mode nothing\n");
    expectRefused("view bucky:8 --script script", {"script:1: --mode", "nothing"});
    expectRefused("view bucky:8 --verbose --script script", {"--verbose"});
    expectRefused("view bucky:8 --frames 3 --script script", {"--frames"});
    expectRefused("view --script script", {"no mesh"});
    expectRefused("view bucky:8 --script nowhere", {"nowhere"});
}

}  // namespace
