// SPDX-License-Identifier: Apache-2.0
#include "read_points_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "file_name.h"

namespace tetralux::mesher {
namespace {

constexpr std::size_t mostColumns = 1000;
constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    return text;
}

std::string_view withoutComment(std::string_view line) {
    line = line.substr(0, line.find('#'));
    return line.substr(0, line.find("//"));
}

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> words;
    if (separator == ' ') {
        while (true) {
            const std::size_t first = line.find_first_not_of(blanks);
            if (first == std::string_view::npos) return words;
            const std::size_t end = std::min(line.find_first_of(blanks, first), line.size());
            words.push_back(line.substr(first, end - first));
            line.remove_prefix(end);
        }
    }
    while (true) {
        const std::size_t end = line.find(separator);
        words.push_back(trimmed(line.substr(0, end)));
        if (end == std::string_view::npos) return words;
        line.remove_prefix(end + 1);
    }
}

std::optional<double> number(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || word.empty()) return std::nullopt;
    return value;
}

char separatorOf(std::string_view line) {
    for (const char separator : {',', ';', '\t'})
        if (std::count(line.begin(), line.end(), separator) >= 2) return separator;
    return ' ';
}

/// The columns that hold x, y, z: those with such names (ParaView writes "Points:0"), else the first three.
std::array<std::size_t, 3> positionColumns(const std::vector<std::string>& names) {
    std::vector<std::string> small = names;
    for (std::string& name : small)
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::array<std::array<const char*, 3>, 3> families{
        {{"x", "y", "z"}, {"points:0", "points:1", "points:2"}, {"points_0", "points_1", "points_2"}}};
    for (const auto& family : families) {
        std::array<std::size_t, 3> columns{};
        bool all = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = std::find(small.begin(), small.end(), family[k]);
            all = all && found != small.end();
            columns[k] = static_cast<std::size_t>(found - small.begin());
        }
        if (all) return columns;
    }
    return {0, 1, 2};
}

class Table {
public:
    explicit Table(const std::string& path) : path_(path), csv_(lowerEnding(path) == ".csv") {}

    PolygonSoup read() {
        std::ifstream file(path_, std::ios::binary);
        if (!file)
            throw std::runtime_error(fmt::format("{}: cannot be opened: check the name and the permissions", path_));
        std::string line;
        for (line_ = 1; std::getline(file, line); ++line_) {
            std::string_view text = line;
            if (line_ == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
            take(csv_ ? text : withoutComment(text));
        }
        if (!started_)
            throw std::runtime_error(fmt::format("{}: no points: each line needs x, y, z and its values", path_));
        return std::move(soup_);
    }

private:
    void take(std::string_view text) {
        if (trimmed(text).empty()) return;
        if (!started_ && separator_ == 0) separator_ = separatorOf(text);
        const auto words = split(text, separator_);
        if (!started_) {
            const bool isHeader = std::any_of(words.begin(), words.end(), [](auto w) { return !number(w); });
            if (isHeader && names_.empty()) {
                names_.assign(words.begin(), words.end());
                return;
            }
            if (words.size() == 1 && !csv_) {  // the number of points; what follows may have other separators
                separator_ = 0;
                return;
            }
            start(words.size());
        }
        if (words.size() != columns_)
            fail(fmt::format("has {} columns, the lines before it {}", words.size(), columns_));
        for (std::size_t c = 0; c < columns_; ++c) {
            const std::optional<double> value = number(words[c]);
            if (!value) fail(fmt::format("holds '{}' where a number should be", words[c].substr(0, 20)));
            row_[c] = *value;
        }
        soup_.points.emplace_back(row_[position_[0]], row_[position_[1]], row_[position_[2]]);
        for (std::size_t f = 0; f < fieldColumns_.size(); ++f) soup_.fields[f].values.push_back(row_[fieldColumns_[f]]);
    }

    void start(std::size_t columns) {
        if (columns < 3 || columns > mostColumns)
            fail(fmt::format("has {} columns; x, y, z and values are needed", columns));
        if (!names_.empty() && names_.size() != columns)
            fail(fmt::format("has {} columns, the header {}", columns, names_.size()));
        columns_ = columns;
        row_.resize(columns);
        position_ = positionColumns(names_);
        for (std::size_t c = 0; c < columns; ++c) {
            if (std::find(position_.begin(), position_.end(), c) != position_.end()) continue;
            fieldColumns_.push_back(c);
            const std::size_t n = fieldColumns_.size();
            std::string name = !names_.empty() && !names_[c].empty() ? names_[c]
                               : n == 1                              ? "value"
                                                                     : fmt::format("value{}", n);
            soup_.fields.push_back({std::move(name), mesh::Association::Point, 1, {}});
        }
        started_ = true;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error(fmt::format("{}: line {} {}: mend or remove that line", path_, line_, what));
    }

    std::string path_;
    bool csv_;
    std::size_t line_ = 0;
    char separator_ = 0;
    bool started_ = false;
    std::size_t columns_ = 0;
    std::vector<std::string> names_;
    std::array<std::size_t, 3> position_{0, 1, 2};
    std::vector<std::size_t> fieldColumns_;
    std::vector<double> row_;
    PolygonSoup soup_;
};

}  // namespace

PolygonSoup readPointsText(const std::string& path) {
    return Table(path).read();
}

}  // namespace tetralux::mesher
