// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/number_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

namespace tetralux::mesh {
namespace {

constexpr std::size_t longestNumber = 400;

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Names of what is no finite number, without sign: of C, Fortran, IBM's and Microsoft's libraries.
NumberText parseName(std::string_view word, bool negative, double& value) {
    std::string text;
    std::transform(word.begin(), word.end(), std::back_inserter(text), lower);
    const bool infinite = text == "inf" || text == "infinity" || text.starts_with("1.#inf");
    const bool none = text == "nan" || text.starts_with("nan(") || text == "nanq" || text == "nans" ||
                      text.starts_with("1.#qnan") || text.starts_with("1.#snan") || text.starts_with("1.#ind");
    if (!infinite && !none) {
        return NumberText::None;
    }
    const double magnitude =
        infinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    value = negative ? -magnitude : magnitude;
    return NumberText::Good;
}

/// `word` with an 'e' before its exponent, if it is Fortran's way to write a number; else empty.
std::string withExponentLetter(std::string_view word) {
    std::size_t at = 0;
    bool digits = false;
    bool point = false;
    for (; at < word.size() && (isDigit(word[at]) || word[at] == '.'); ++at) {
        digits = digits || isDigit(word[at]);
        point = point || word[at] == '.';
    }
    const std::string_view exponent = word.substr(at);
    if (!digits || exponent.empty()) {
        return {};
    }
    const bool letter = lower(exponent[0]) == 'd' || lower(exponent[0]) == 'q';
    const bool bare = point && (exponent[0] == '+' || exponent[0] == '-');
    return letter || bare ? fmt::format("{}e{}", word.substr(0, at), exponent.substr(letter ? 1 : 0)) : std::string();
}

/// A decimal number of C, without sign.
NumberText parsePlain(std::string_view word, double& value) {
    if (word.empty() || !(isDigit(word[0]) || word[0] == '.')) {
        return NumberText::None;
    }
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) {
        return NumberText::None;
    }
    if (error == std::errc::result_out_of_range) {
        value = std::strtod(std::string(word).c_str(), nullptr);  // says which end it is out of
        return std::isfinite(value) ? NumberText::Good : NumberText::Beyond;
    }
    return NumberText::Good;
}

}  // namespace

NumberText parseNumber(std::string_view word, double& value) {
    if (word.empty() || word.size() > longestNumber) {
        return NumberText::None;
    }
    const bool negative = word[0] == '-';
    if (negative || word[0] == '+') {
        word.remove_prefix(1);
    }
    NumberText kind = parsePlain(word, value);
    if (kind == NumberText::None) {
        const std::string lettered = withExponentLetter(word);
        kind = lettered.empty() ? NumberText::None : parsePlain(lettered, value);
    }
    if (kind == NumberText::None) {
        return parseName(word, negative, value);
    }
    value = negative ? -value : value;
    return kind;
}

std::string complaintOf(std::string_view word, NumberText kind, std::string_view what) {
    return kind == NumberText::Beyond
               ? fmt::format("'{}' stands where {} should, and is beyond the numbers of 64 bits", shownWord(word), what)
               : fmt::format("'{}' stands where {} should", shownWord(word), what);
}

const char* remedyFor(std::string_view word, NumberText kind) {
    if (kind == NumberText::Beyond) {
        return "write a smaller number, or nan for none";
    }
    if (!word.empty() && word.find_first_not_of('*') == std::string_view::npos) {
        return "stars are Fortran's for a number too wide for its format: write it in a wider one, or nan for none";
    }
    return "write a number there, or nan for none";
}

std::string shownWord(std::string_view word) {
    std::string text;
    for (const char c : word.substr(0, 30)) {
        text += c >= ' ' && c <= '~' ? c : '?';
    }
    return text;
}

}  // namespace tetralux::mesh
