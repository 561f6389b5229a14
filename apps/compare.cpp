// SPDX-License-Identifier: Apache-2.0
//
// tetralux compare: how far two images are from each other, and how much structure they show.
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <apps/commands.h>
#include <projection/image/image.h>
#include <projection/image/image_structure.h>

namespace tetralux::apps {

namespace {

constexpr double anyError = std::numeric_limits<double>::infinity();

struct CompareOptions {
    std::string first, second;
    double largestRmse = anyError, largestMax = anyError;
    bool structure = false;
    std::string unlit;  ///< what structure is compared with; empty: a uniform picture
    bool json = false;
};

bool isPng(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    return extension == ".png" || extension == ".PNG";
}

projection::ImageDifference differenceOf(const CompareOptions& options, projection::Image& first,
                                         projection::Image& second) {
    // A PNG is over black already, so the other one must be.
    if (isPng(options.first) != isPng(options.second)) {
        projection::putUnder(first, glm::vec3(0));
        projection::putUnder(second, glm::vec3(0));
    }
    try {
        return projection::compareImages(first, second);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{} and {}: {}", options.first, options.second, error.what()));
    }
}

void print(const CompareOptions& options, const projection::ImageDifference& difference,
           const std::vector<double>& structure) {
    if (options.json) {
        // JSON has no infinity: equal images have psnr null
        const nlohmann::json psnr =
            std::isfinite(difference.psnr) ? nlohmann::json(difference.psnr) : nlohmann::json(nullptr);
        nlohmann::json result{
            {"rmse", difference.rmse}, {"max", difference.max}, {"p99.9", difference.percentile999}, {"psnr", psnr}};
        if (!structure.empty()) result["structure"] = structure;
        fmt::print("{}\n", result.dump());
        return;
    }
    fmt::print("rmse  {:.6g}\nmax   {:.6g}\np99.9 {:.6g}\npsnr  {:.2f} dB\n", difference.rmse, difference.max,
               difference.percentile999, difference.psnr);
    if (!structure.empty()) fmt::print("structure {:.6g} and {:.6g}\n", structure[0], structure[1]);
}

std::vector<double> structureOf(const CompareOptions& options, const projection::Image& first,
                                const projection::Image& second) {
    if (options.unlit.empty()) return {projection::structureScore(first), projection::structureScore(second)};
    const projection::Image unlit = projection::readImage(options.unlit);
    try {
        return {projection::structureScore(unlit, first), projection::structureScore(unlit, second)};
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("--structure {}: {}", options.unlit, error.what()));
    }
}

int compare(const CompareOptions& options) {
    projection::Image first = projection::readImage(options.first);
    projection::Image second = projection::readImage(options.second);
    const projection::ImageDifference difference = differenceOf(options, first, second);
    std::vector<double> structure;
    if (options.structure) structure = structureOf(options, first, second);
    print(options, difference, structure);
    return difference.rmse <= options.largestRmse && difference.max <= options.largestMax ? 0 : 1;
}

}  // namespace

void addCompareCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand("compare", "rmse, max and psnr of two images");
    command->add_option("A", options->first, ".png or .exr")->required();
    command->add_option("B", options->second, ".png or .exr")->required();
    command->add_option("--max-rmse", options->largestRmse, "exit status 1 when rmse is above this");
    command->add_option("--max-error", options->largestMax, "exit status 1 when the largest difference is above this");
    command
        ->add_option_function<std::string>(
            "--structure",
            [options](const std::string& unlit) {
                options->structure = true;
                options->unlit = unlit;
            },
            "also how much structure light gives to each (MS-HWSD), against the same picture UNLIT; without UNLIT how "
            "much each shows by itself")
        ->expected(0, 1)
        ->type_name("[UNLIT]");
    command->add_flag("--json", options->json, "for machines");
    command->callback([options, &chosen] { chosen = [options] { return compare(*options); }; });
}

}  // namespace tetralux::apps
