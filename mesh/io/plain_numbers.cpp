// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/plain_numbers.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <mesh/io/number_text.h>

namespace tetralux::mesh {
namespace {

/// Floats with patterns of bits that no one computes.
constexpr double forNan = 2.3019100933785668e+38, forInfinity = 2.502076179636525e+38;

bool isSpace(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string_view withoutSign(std::string_view word) {
    return word.substr(!word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0);
}

/// Whether streams of C++ read all of `word` as a finite number.
bool isPlain(std::string_view word, double& value) {
    const std::string_view digits = withoutSign(word);
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    return error == std::errc() && stop == end && !isLetter(digits[0]);
}

/// Stars, or a number with a point and an exponent: a word that no one calls anything.
bool isSurelyMeantAsNumber(std::string_view word) {
    const std::string_view digits = withoutSign(word);
    const bool stars = word.size() > 1 && word.find_first_not_of('*') == std::string_view::npos;
    const bool begins = !digits.empty() && !isLetter(digits[0]) && digits.find('.') != std::string_view::npos;
    return stars || (begins && digits.find_first_not_of("0123456789.+-eEdDqQ") == std::string_view::npos);
}

class Rewriting {
public:
    Rewriting(std::string_view text, const NumberPlaces& places) : text_(text), places_(places) {}

    std::optional<PlainText> rewrite() {
        for (std::size_t line = 0; at_ < text_.size(); ++line) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            if (line >= places_.skippedLines) {
                rewriteLine(end, places_.firstLine + line);
            }
            at_ = end + 1;
        }
        if (copied_ == 0 && !result_.beyondFloat) {
            return std::nullopt;
        }
        result_.text.append(text_.substr(copied_));
        return std::move(result_);
    }

private:
    void rewriteLine(std::size_t end, std::size_t number) {
        bool named = false;
        for (std::size_t words = 0; at_ < end;) {
            if (isSpace(text_[at_])) {
                ++at_;
                continue;
            }
            const std::size_t begin = at_;
            while (at_ < end && !isSpace(text_[at_])) {
                ++at_;
            }
            const std::string_view word = text_.substr(begin, at_ - begin);
            double value = 0.0;
            named = named || (words++ == 0 &&
                              (word[0] == '#' || (isLetter(word[0]) && parseNumber(word, value) != NumberText::Good)));
            if (named && !places_.inNamedLines && !places_.everyWord) {
                return;
            }
            rewriteWord(word, begin, named, number);
        }
    }

    void rewriteWord(std::string_view word, std::size_t begin, bool named, std::size_t line) {
        double value = 0.0;
        if (isPlain(word, value)) {
            noteSize(value);
            return;
        }
        const NumberText kind = parseNumber(word, value);
        const bool meant = places_.everyWord || isSurelyMeantAsNumber(word);
        if (kind != NumberText::Good) {
            const bool tooLarge = kind == NumberText::Beyond && !named;
            if (places_.everyWord || tooLarge || (meant && (kind == NumberText::Beyond || word[0] == '*'))) {
                throw std::runtime_error(
                    fmt::format("line {}: {}; {}", line, complaintOf(word, kind, "a number"), remedyFor(word, kind)));
            }
            return;
        }
        if (named && !meant) {
            return;
        }
        result_.text.append(text_.substr(copied_, begin - copied_));
        noteSize(value);
        const double written = std::isnan(value)   ? forNan
                               : std::isinf(value) ? std::copysign(forInfinity, value)
                                                   : value;
        fmt::format_to(std::back_inserter(result_.text), "{}", written);
        copied_ = begin + word.size();
    }

    void noteSize(double value) {
        const double size = std::abs(value);
        result_.beyondFloat = result_.beyondFloat || (size > std::numeric_limits<float>::max() && std::isfinite(size));
    }

    std::string_view text_;
    const NumberPlaces& places_;
    PlainText result_;
    std::size_t at_ = 0;
    std::size_t copied_ = 0;  ///< bytes of `text_` that the result holds
};

void restore(double& value) {
    if (value == forNan) {
        value = std::numeric_limits<double>::quiet_NaN();
    } else if (std::abs(value) == forInfinity) {
        value = std::copysign(std::numeric_limits<double>::infinity(), value);
    }
}

}  // namespace

std::optional<PlainText> withPlainNumbers(std::string_view text, const NumberPlaces& places) {
    return Rewriting(text, places).rewrite();
}

void restoreNotFinite(CellSoup& soup) {
    for (glm::dvec3& x : soup.points) {
        restore(x.x);
        restore(x.y);
        restore(x.z);
    }
    for (Field& field : soup.fields) {
        std::for_each(field.values.begin(), field.values.end(), restore);
    }
}

MemoryFile::MemoryFile(std::string_view content) : file_(::memfd_create("tetralux-text", MFD_CLOEXEC)) {
    while (file_ >= 0 && !content.empty()) {
        const ssize_t done = ::write(file_, content.data(), content.size());
        if (done <= 0) {
            ::close(file_);
            file_ = -1;
            break;
        }
        content.remove_prefix(static_cast<std::size_t>(done));
    }
    if (file_ < 0) {
        throw std::runtime_error("there is too little memory to read it; close other programs");
    }
}

MemoryFile::~MemoryFile() {
    ::close(file_);
}

std::string MemoryFile::path() const {
    return fmt::format("/proc/self/fd/{}", file_);
}

}  // namespace tetralux::mesh
