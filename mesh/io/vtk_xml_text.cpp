// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/vtk_xml_text.h>

#include <algorithm>
#include <cstdint>

#include <fcntl.h>
#include <unistd.h>

#include <mesh/io/plain_numbers.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/xml_tags.h>

namespace tetralux::mesh {
namespace {

struct Span {
    std::uint64_t begin, end;
};

/// Bytes of a file that are to be replaced.
struct Change {
    Span span;
    std::string text;
};

/// Where in a file the things stand that VTK's readers take wrongly.
struct Outline {
    std::string kind;
    Span file{}, grid{};  ///< the opening tags
    std::string wholeExtent;
    std::vector<Span> pieces;
    std::vector<std::string> extents;       ///< of the pieces, if they are grids
    std::vector<Span> numbers, numberTags;  ///< text of arrays of numbers, and their opening tags
};

Outline outlineOf(int file) {
    Outline outline;
    XmlTags tags(file);
    bool inNumbers = false;
    while (const std::optional<XmlTag> tag = tags.next()) {
        if (inNumbers) {
            outline.numbers.back().end = tags.textEnd();
            inNumbers = false;
        }
        if (tag->name == "VTKFile") {
            outline.kind = tag->get("type");
        } else if (!outline.kind.empty() && tag->name == outline.kind) {
            outline.grid = {tags.tagStart(), tags.tagEnd()};
            outline.wholeExtent = tag->get("WholeExtent");
        } else if (tag->name == "Piece") {
            outline.pieces.push_back({tags.tagStart(), tags.tagEnd()});
            outline.extents.push_back(tag->get("Extent"));
        } else if (tag->name == "/Piece" && !outline.pieces.empty()) {
            outline.pieces.back().end = tags.tagEnd();
        } else if (tag->name == "DataArray" && tag->get("format") == "ascii" && tag->get("type") != "String" &&
                   !tag->closesItself) {
            outline.numberTags.push_back({tags.tagStart(), tags.tagEnd()});
            outline.numbers.push_back({tags.tagEnd(), tags.tagEnd()});
            inNumbers = true;
        } else if (tag->name == "AppendedData") {
            break;
        }
    }
    return outline;
}

std::string_view part(const std::string& text, const Span& span) {
    return std::string_view(text).substr(span.begin, span.end - span.begin);
}

std::string replaced(std::string text, std::string_view old, std::string_view with) {
    const std::size_t at = text.find(old);
    return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

/// Texts of numbers that VTK does not read as they stand.
std::vector<Change> plainNumbers(const std::string& text, const Outline& outline) {
    std::vector<Change> changes;
    std::size_t line = 1;
    std::uint64_t counted = 0;
    for (std::size_t i = 0; i < outline.numbers.size(); ++i) {
        const Span& span = outline.numbers[i];
        line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                    text.begin() + static_cast<std::ptrdiff_t>(span.begin), '\n'));
        counted = span.begin;
        if (auto plain = withPlainNumbers(part(text, span), {true, false, line, 0})) {
            if (plain->beyondFloat) {
                const Span& tag = outline.numberTags[i];
                changes.push_back({tag, replaced(std::string(part(text, tag)), "Float32", "Float64")});
            }
            changes.push_back({span, std::move(plain->text)});
        }
    }
    return changes;
}

std::string changed(const std::string& text, std::vector<Change> changes) {
    std::sort(changes.begin(), changes.end(),
              [](const Change& a, const Change& b) { return a.span.begin < b.span.begin; });
    std::string result;
    std::uint64_t at = 0;
    for (const Change& change : changes) {
        if (change.span.begin < at) {
            continue;  // within what is gone already
        }
        result.append(text, at, change.span.begin - at);
        result += change.text;
        at = change.span.end;
    }
    return result.append(text, at);
}

/// What leaves only piece `kept`, with the extent of the whole made its own.
std::vector<Change> onlyPiece(const std::string& text, const Outline& outline, std::size_t kept) {
    std::vector<Change> changes;
    for (std::size_t i = 0; i < outline.pieces.size(); ++i) {
        if (i != kept) {
            changes.push_back({outline.pieces[i], ""});
        }
    }
    if (!outline.wholeExtent.empty() && !outline.extents[kept].empty()) {
        changes.push_back({outline.grid, replaced(std::string(part(text, outline.grid)), outline.wholeExtent,
                                                  outline.extents[kept])});
    }
    return changes;
}

}  // namespace

VtkXmlText plainVtkXml(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const Outline outline = outlineOf(file);
    ::close(file);
    VtkXmlText result{outline.kind, {}};
    const bool isPart = outline.pieces.size() == 1 && !outline.extents[0].empty() && !outline.wholeExtent.empty() &&
                        outline.extents[0] != outline.wholeExtent;
    if (outline.pieces.size() < 2 && outline.numbers.empty() && !isPart) {
        return result;
    }
    const std::string text = readWholeFile(path);
    const std::vector<Change> numbers = plainNumbers(text, outline);
    if (outline.pieces.size() < 2 && !isPart) {
        if (!numbers.empty()) {
            result.files.push_back(changed(text, numbers));
        }
        return result;
    }
    for (std::size_t piece = 0; piece < outline.pieces.size(); ++piece) {
        std::vector<Change> changes = onlyPiece(text, outline, piece);
        changes.insert(changes.end(), numbers.begin(), numbers.end());
        result.files.push_back(changed(text, std::move(changes)));
    }
    return result;
}

}  // namespace tetralux::mesh
