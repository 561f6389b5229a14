// SPDX-License-Identifier: Apache-2.0
#include <apps/report_text.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace tetralux::apps {

std::vector<std::string> defectLines(const mesh::MeshReport& report) {
    std::vector<std::string> lines;
    for (const auto& [defect, found] : report.defects)
        lines.push_back(fmt::format("{} {}{} (the first: {})", found.count, mesh::defectName(defect),
                                    found.count == 1 ? "" : "s", fmt::join(found.firstOffenders, ", ")));
    return lines;
}

nlohmann::json defectsJson(const mesh::MeshReport& report) {
    nlohmann::json defects = nlohmann::json::object();
    for (const auto& [defect, found] : report.defects)
        defects[mesh::defectName(defect)] = {{"count", found.count}, {"first", found.firstOffenders}};
    return defects;
}

std::string jsonText(const nlohmann::json& value) {
    return value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

}  // namespace tetralux::apps
