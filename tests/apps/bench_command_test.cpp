// SPDX-License-Identifier: Apache-2.0
//
// `tetralux bench` end to end on a tiny scene.
#include <gtest/gtest.h>

#include <set>

#include <tests/apps/command_line_test.h>

namespace tetralux::tests {
namespace {

using BenchCommand = CommandLine;

TEST_F(BenchCommand, QuickModeFindsEveryPictureRight) {
    expectGood("bench bucky:6 --quick --quiet --sizes 40x30 --json out.json --csv out.csv --plot out.svg");
    const nlohmann::json result = json("out.json");
    EXPECT_GT(result["machine"]["cores"].get<int>(), 0);
    std::size_t judged = 0;
    for (const nlohmann::json& row : result["rows"]) {
        if (row.contains("failure")) continue;
        ++judged;
        EXPECT_EQ(row["tetrahedra"], 625);
        EXPECT_EQ(row["size"], nlohmann::json::array({40, 30}));
        EXPECT_LE(row["error"]["rmse"].get<double>(), row["tf"] == "peaks" ? 2e-3 : 1e-4) << row.dump(2);
        EXPECT_GT(row["ms"]["median"].get<double>(), 0.0);
        EXPECT_GT(row["memory"]["peak_bytes"].get<std::uint64_t>(), 0u);
    }
    EXPECT_GE(judged, 8u);  // four transfer functions, two modes, one engine at least
    const std::string csv = contentOf(folder_ / "out.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<std::ptrdiff_t>(result["rows"].size()) + 1);
    EXPECT_NE(contentOf(folder_ / "out.svg").find("</svg>"), std::string::npos);
}

// The judge as a row: one frame, no error, nothing else drawn.
TEST_F(BenchCommand, DrawsOnlyTheEnginesAskedFor) {
    expectGood("bench coulomb:4 --engines reference --tf smooth --sizes 16x16 --frames 1 --quiet --json out.json");
    const nlohmann::json rows = json("out.json")["rows"];
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0]["engine"], "reference");
    EXPECT_EQ(rows[0]["error"]["rmse"], 0.0);
}

// Every axis of settings makes rows of its own, and what is left out is told.
TEST_F(BenchCommand, SettingsAreAxes) {
    expectGood(
        "bench bucky:8 --engines cpu --tf opaque --sizes 64x64 --frames 1 --quiet --json out.json "
        "--order auto,graph --skip-invisible on,off --early-termination on,off");
    const nlohmann::json rows = json("out.json")["rows"];
    ASSERT_EQ(rows.size(), 8u);
    std::set<std::string> settings;
    for (const nlohmann::json& row : rows) {
        const auto setting = row["setting"].get<std::string>();
        settings.insert(setting);
        EXPECT_EQ(row["cells"]["skipped"].contains("invisible by transfer function"),
                  setting.find("all cells") == std::string::npos)
            << setting;
        EXPECT_EQ(row["order"], setting.find("graph") == std::string::npos ? "power" : "mpvo");
        EXPECT_LE(row["error"]["rmse"].get<double>(), 1e-4);
    }
    EXPECT_EQ(settings.size(), 8u);
}

// Silhouettes make a picture of its own, more opaque than the plain one and judged by the reference's.
TEST_F(BenchCommand, SilhouettesArePicturesOfTheirOwn) {
    expectGood(
        "bench bucky:8 --engines cpu --tf veiled --mode scale-invariant --silhouette off,on --sizes 64x64 --frames 1 "
        "--quiet --json out.json");
    const nlohmann::json rows = json("out.json")["rows"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["mode"], "scale-invariant");
    EXPECT_EQ(rows[1]["mode"], "scale-invariant silhouettes");
    for (const nlohmann::json& row : rows) EXPECT_LE(row["error"]["rmse"].get<double>(), 2e-6);
}

TEST_F(BenchCommand, SaysWhatItDoesNotKnow) {
    expectRefused("bench bucky:4 --engines warp", {"--engines", "warp", "reference"});
    expectRefused("bench bucky:4 --tf shiny", {"--tf", "shiny", "smooth"});
    expectRefused("bench bucky:4 --order random", {"--order", "random", "graph"});
    expectRefused("bench bucky:4 --skip-invisible maybe", {"--skip-invisible", "maybe", "off"});
    expectRefused("bench bucky:4 --table-error 2", {"--table-error", "2", "1e-3"});
    expectRefused("bench bucky --cells many", {"--cells", "many", "0.15M"});
    expectRefused("bench bucky:4 --plot plot.jpg", {"plot.jpg", ".svg"});
    expectRefused("bench bucky:4 --json no/such/folder.json", {"no/such/folder.json"});
    expectRefused("bench missing.vtu --engines reference", {"missing.vtu"});
}

}  // namespace
}  // namespace tetralux::tests
