// SPDX-License-Identifier: Apache-2.0
#include <preint/similar_names.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace tetralux::preint {
namespace {

std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + changed});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

std::string foldedName(std::string_view name) {
    std::string folded;
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (letter >= 0x80 || std::isalnum(letter) != 0) folded += static_cast<char>(std::tolower(letter));
    }
    return folded;
}

std::vector<std::string> similarNames(std::string_view name, const std::vector<std::string>& known) {
    constexpr std::size_t most = 3, longest = 64;
    const std::string wanted = foldedName(name).substr(0, longest);
    if (wanted.empty()) return {};
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& one : known) {
        const std::string folded = foldedName(one);
        const std::size_t changes = distance(wanted, folded.substr(0, longest));
        const bool begins = wanted.size() >= 3 && folded.starts_with(wanted);
        if (begins)
            near.emplace_back(std::min<std::size_t>(changes, 1), one);
        else if (changes <= std::max<std::size_t>(1, std::min(wanted.size(), folded.size()) / 3))
            near.emplace_back(changes, one);
    }
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names, folded;  // one of each, however it is spelled
    for (const auto& [changes, candidate] : near) {
        if (names.size() == most) break;
        if (std::find(folded.begin(), folded.end(), foldedName(candidate)) != folded.end()) continue;
        folded.push_back(foldedName(candidate));
        names.push_back(candidate);
    }
    return names;
}

std::string didYouMean(std::string_view name, const std::vector<std::string>& known) {
    std::string text;
    for (const std::string& one : similarNames(name, known))
        text += (text.empty() ? " did you mean \"" : " or \"") + one + "\"";
    return text.empty() ? text : text + "?";
}

}  // namespace tetralux::preint
