// SPDX-License-Identifier: Apache-2.0
#include <apps/page_writer.h>

#include <cctype>
#include <sstream>

namespace tetralux::apps {

namespace {

constexpr std::size_t columns = 118;  ///< of Markdown's lines

/// Characters, not bytes, of UTF-8.
std::size_t widthOf(std::string_view text) {
    std::size_t width = 0;
    for (const char c : text) width += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
    return width;
}

/// Words with single spaces, in lines of at most `columns`; all but the first begin with `indent`.
std::string wrapped(std::string_view text, std::string_view indent) {
    std::istringstream words{std::string(text)};
    std::string result;
    std::size_t width = 0;
    for (std::string word; words >> word;) {
        const std::size_t needed = widthOf(word);
        if (width > 0 && width + 1 + needed > columns) {
            result += '\n';
            result += indent;
            width = indent.size();
        } else if (width > 0) {
            result += ' ';
            ++width;
        }
        result += word;
        width += needed;
    }
    return result + '\n';
}

/// What Markdown would take for emphasis, links or HTML is not, but between backticks, where all is as it stands.
std::string markdownText(std::string_view text) {
    std::string result;
    bool code = false;
    for (const char c : text) {
        if (c == '`') code = !code;
        if (!code && (c == '*' || c == '<' || c == '\\')) result += '\\';
        result += c;
    }
    return result;
}

/// One character of a text for roff, where a hyphen is not a minus and a backslash begins an escape.
std::string roffCharacter(char c) {
    if (c == '\\') return "\\e";
    if (c == '-') return "\\-";
    if (c == '\'') return "\\(aq";
    return {c};
}

std::string roffText(std::string_view text) {
    std::string result;
    bool code = false;
    for (const char c : text) {
        if (c == '`') {
            code = !code;
            result += code ? "\\fB" : "\\fR";
        } else {
            result += roffCharacter(c);
        }
    }
    if (!result.empty() && result.front() == '.') result.insert(0, "\\&");
    return result;
}

std::string upperCase(std::string_view text) {
    std::string result;
    for (const char c : text) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

}  // namespace

std::string sentence(std::string_view text) {
    std::string result(text);
    if (!result.empty()) result.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(result.front())));
    return result + '.';
}

void MarkdownWriter::beginBlock() {
    if (!text_.empty()) text_ += '\n';
    inList_ = false;
}

void MarkdownWriter::title(std::string_view name, std::string_view about, std::string_view) {
    text_ += "# " + std::string(name) + "\n\n" + wrapped(markdownText(sentence(about)), "");
}

void MarkdownWriter::heading(std::string_view text) {
    beginBlock();
    text_ += "## " + std::string(text) + '\n';
}

void MarkdownWriter::subheading(std::string_view text) {
    beginBlock();
    text_ += "### " + std::string(text) + '\n';
}

void MarkdownWriter::paragraph(std::string_view text) {
    beginBlock();
    text_ += wrapped(markdownText(text), "");
}

void MarkdownWriter::code(std::string_view lines) {
    beginBlock();
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = lines.find('\n', begin);
        const std::string_view line = lines.substr(begin, end - begin);
        text_ += line.empty() ? "\n" : "    " + std::string(line) + '\n';
        begin = end + 1;
    }
}

void MarkdownWriter::entry(std::string_view term, std::string_view meaning) {
    if (!inList_) beginBlock();
    inList_ = true;
    const std::string head = "- `" + std::string(term) + "`";
    text_ += wrapped(meaning.empty() ? head : head + ": " + markdownText(meaning), "  ");
}

void ManWriter::title(std::string_view name, std::string_view about, std::string_view version) {
    text_ += ".\\\" SPDX-License-Identifier: Apache-2.0\n";
    text_ += ".TH " + upperCase(name) + " 1 \"\" \"" + std::string(name) + ' ' + std::string(version) + "\"\n";
    text_ += ".nh\n.ad l\n.SH NAME\n" + std::string(name) + " \\- " + roffText(about) + '\n';
}

void ManWriter::heading(std::string_view text) {
    text_ += ".SH \"" + roffText(upperCase(text)) + "\"\n";
}

void ManWriter::subheading(std::string_view text) {
    text_ += ".SS \"" + roffText(text) + "\"\n";
}

void ManWriter::paragraph(std::string_view text) {
    text_ += ".PP\n" + roffText(text) + '\n';
}

void ManWriter::code(std::string_view lines) {
    text_ += ".PP\n.RS 2\n.nf\n";
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = lines.find('\n', begin);
        const std::string_view line = lines.substr(begin, end - begin);
        std::string escaped = line.starts_with('.') || line.starts_with('\'') ? "\\&" : "";
        for (const char c : line) escaped += roffCharacter(c);
        text_ += escaped + '\n';
        begin = end + 1;
    }
    text_ += ".fi\n.RE\n";
}

void ManWriter::entry(std::string_view term, std::string_view meaning) {
    std::string escaped;
    for (const char c : term) escaped += roffCharacter(c);
    text_ += ".TP\n\\fB" + escaped + "\\fR\n" + roffText(meaning) + '\n';
}

}  // namespace tetralux::apps
