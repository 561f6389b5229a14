// SPDX-License-Identifier: Apache-2.0
/// \file
/// NRRD files (teem.sourceforge.net/nrrd/format.html). VTK's reader leaves the order of bytes in compressed data alone,
/// misplaces vectors, and knows nothing of directions.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <libdeflate.h>

#include <mesh/io/parse_mesh.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/voxel_types.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/grid_soup.h>

namespace tetralux::mesh {
namespace {

/// "key: value" lines, keys in lower case and without spaces; ends at an empty line.
using Header = std::map<std::string, std::string>;

Header takeHeader(TextScanner& scan) {
    Header header;
    while (scan.remaining() > 0) {
        const std::string_view line = scan.restOfLine();
        if (line.empty()) {
            break;
        }
        const std::size_t colon = line.find(':');
        if (line[0] == '#' || colon == std::string_view::npos || line.substr(colon).starts_with(":=")) {
            continue;  // a remark, or what only its writer knows
        }
        std::string key;
        for (const char c : line.substr(0, colon)) {
            if (c != ' ') {
                key += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            }
        }
        const std::size_t value = std::min(line.find_first_not_of(" \t", colon + 1), line.size());
        const std::size_t end = line.find_last_not_of(" \t");
        header[key] = line.substr(value, end == std::string_view::npos || end < value ? 0 : end - value + 1);
    }
    return header;
}

class NrrdReader {
public:
    NrrdReader(std::string_view bytes, const std::string& source) : scan_(bytes, source, '\0'), source_(source) {
        if (!scan_.restOfLine().starts_with("NRRD000")) {
            refuse("does not begin as an NRRD file does; check the name's ending or write the file again");
        }
        header_ = takeHeader(scan_);
        findType();
        findAxes();
    }

    CellSoup read(const std::function<std::string(const std::string& file)>& readData) {
        std::string detached;
        std::string_view data = scan_.bytes(scan_.remaining(), "values");
        if (const std::string file = get("datafile"); !file.empty()) {
            if (file.starts_with("LIST") || file.find('%') != std::string::npos) {
                refuse("has its values in several files, which is not read; save it as one .nrrd");
            }
            detached = readData(file);
            data = detached;
        }
        const std::string values = decoded(data);
        CellSoup soup;
        try {
            addGridCells(soup, sizes(), cell_type::voxel);
        } catch (const std::runtime_error& error) {
            refuse(error.what());
        }
        placeGrid(soup, sizes(), frame());
        soup.fields.push_back(fieldOf(values));
        return soup;
    }

private:
    static constexpr std::size_t mostValues = std::size_t{1} << 40;

    struct Axis {
        std::size_t size = 0, stride = 0;  ///< in values
        std::string kind;
        std::optional<glm::dvec3> direction;
        double spacing = 1.0;
    };

    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error(fmt::format("{}: {}", source_, what));
    }
    std::string get(const std::string& key) const {
        const auto found = header_.find(key);
        return found == header_.end() ? std::string() : found->second;
    }
    std::vector<std::string> words(const std::string& key) const {
        const std::string text = get(key);
        TextScanner scan(text, source_, '\0');
        std::vector<std::string> found;
        while (!scan.atEnd()) {
            found.emplace_back(scan.word("a word"));
        }
        return found;
    }
    /// NaN for what is none: the format allows that.
    static double number(std::string_view text) {
        double value = std::nan("");
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    }
    /// "(1,0,0)"; nothing for "none" and for what is no vector of three.
    static std::optional<glm::dvec3> vectorOf(const std::string& text) {
        glm::dvec3 vector(0);
        std::size_t at = 0;
        for (int i = 0; i < 3; ++i) {
            at = text.find(i == 0 ? '(' : ',', at);
            if (at == std::string::npos) {
                return std::nullopt;
            }
            vector[i] = number(std::string_view(text).substr(++at));
        }
        const bool finite = std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
        return finite ? std::optional(vector) : std::nullopt;
    }

    void findType() {
        const std::string name = get("type");
        for (const VoxelType& type : voxelTypes()) {
            if (type.isCalled(name)) {
                type_ = &type;
            }
        }
        if (type_ == nullptr) {
            refuse(fmt::format("its type '{}' is not known; write it as uint8, int16, float or the like",
                               name.substr(0, 40)));
        }
    }

    void findAxes() {
        const std::vector<std::string> kinds = words("kinds"), spacings = words("spacings");
        std::string joined = get("spacedirections");  // "( 1, 0, 0 )" becomes one word
        bool inside = false;
        std::erase_if(joined, [&](char c) {
            inside = c == '(' || (inside && c != ')');
            return inside && c == ' ';
        });
        header_["spacedirections"] = joined;
        const std::vector<std::string> directions = words("spacedirections");
        std::size_t stride = 1;
        for (const std::string& word : words("sizes")) {
            Axis axis;
            const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), axis.size);
            if (error != std::errc() || axis.size == 0 || axis.size > mostValues / stride) {
                refuse("its sizes are no numbers of points; write the file again");
            }
            axis.stride = stride;
            stride *= axis.size;
            const std::size_t i = axes_.size();
            axis.kind = i < kinds.size() ? kinds[i] : "";
            axis.direction = i < directions.size() ? vectorOf(directions[i]) : std::nullopt;
            axis.spacing = i < spacings.size() ? number(spacings[i]) : 1.0;
            axes_.push_back(axis);
        }
        values_ = stride;
        chooseAxes(!directions.empty());
    }

    /// Three axes of space, and at most one along which the components of a value lie.
    void chooseAxes(bool haveDirections) {
        const bool haveKinds = std::any_of(axes_.begin(), axes_.end(),
                                           [](const Axis& axis) { return !axis.kind.empty() && axis.kind != "???"; });
        constexpr std::size_t mostComponents = 9;
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            const Axis& axis = axes_[i];
            const bool named = axis.kind == "domain" || axis.kind == "space";
            const bool leads = axes_.size() == 4 && i == 0 && axis.size <= mostComponents;
            const bool inSpace = haveDirections ? axis.direction.has_value() : haveKinds ? named : !leads;
            if (inSpace) {
                space_.push_back(axis);
            } else if (axis.size > 1) {
                const bool components =
                    components_.size == 1 && axis.size <= mostComponents && axis.kind != "time" && axis.kind != "list";
                if (!components) {
                    refuse(fmt::format("holds {} volumes, one behind the other; save one of them", axis.size));
                }
                components_ = axis;
            }
        }
        while (space_.size() > 3) {
            const auto thin = std::find_if(space_.begin(), space_.end(), [](const Axis& a) { return a.size == 1; });
            if (thin == space_.end()) {
                refuse(fmt::format("has {} axes of space; save a volume of three", space_.size()));
            }
            space_.erase(thin);
        }
        if (space_.size() < 3) {
            refuse(fmt::format("has {} axes of space; a volume has three", space_.size()));
        }
    }

    std::array<std::size_t, 3> sizes() const { return {space_[0].size, space_[1].size, space_[2].size}; }

    GridFrame frame() const {
        GridFrame frame;
        frame.origin = vectorOf(get("spaceorigin")).value_or(glm::dvec3(0));
        for (std::size_t i = 0; i < 3; ++i) {
            const double spacing = std::isfinite(space_[i].spacing) ? space_[i].spacing : 1.0;
            frame.steps[i] = space_[i].direction.value_or(spacing * frame.steps[i]);
        }
        return frame;
    }

    bool isText() const {
        const std::string encoding = get("encoding");
        return encoding == "ascii" || encoding == "text" || encoding == "txt";
    }

    /// The bytes of all values, in the file's order; of doubles if they were text.
    std::string decoded(std::string_view data) const {
        const std::string encoding = get("encoding");
        const std::size_t size = values_ * type_->size;
        data = skipped(data, encoding == "raw" ? size : 0);
        if (encoding == "raw") {
            checkSize(data.size(), size);
            return std::string(data.substr(0, size));
        }
        if (encoding == "gzip" || encoding == "gz") {
            return inflated(data, size);
        }
        if (encoding == "hex") {
            return fromHex(data, size);
        }
        if (isText()) {
            return fromText(data);
        }
        refuse(fmt::format("its encoding '{}' is not read; save it as gzip or raw", encoding.substr(0, 40)));
    }

    void checkSize(std::size_t found, std::size_t wanted) const {
        if (found < wanted) {
            refuse(fmt::format("ends after {} of {} bytes of values; it is truncated: write it again", found, wanted));
        }
    }

    /// Without the lines and bytes that are to be skipped; −1 bytes means that the values stand at the end.
    std::string_view skipped(std::string_view data, std::size_t rawSize) const {
        const auto countOf = [&](const char* key) {
            const double count = header_.contains(key) ? number(get(key)) : 0.0;
            return std::isfinite(count) && std::abs(count) < 1e15 ? static_cast<std::int64_t>(count) : 0;
        };
        for (std::int64_t line = countOf("lineskip"); line > 0 && !data.empty(); --line) {
            data.remove_prefix(std::min(data.find('\n'), data.size() - 1) + 1);
        }
        const std::int64_t bytes = countOf("byteskip");
        const std::size_t fromEnd = data.size() > rawSize ? data.size() - rawSize : 0;
        data.remove_prefix(bytes < 0 ? (rawSize > 0 ? fromEnd : 0)
                                     : std::min(static_cast<std::size_t>(bytes), data.size()));
        return data;
    }

    std::string inflated(std::string_view data, std::size_t size) const {
        constexpr std::size_t mostPerByte = 1100;  // what deflate can do, and a little
        checkSize(data.size() * mostPerByte, size);
        std::string values(size, '\0');
        const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> state(
            libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
        std::size_t got = 0;
        if (state == nullptr || libdeflate_gzip_decompress(state.get(), data.data(), data.size(), values.data(), size,
                                                           &got) != LIBDEFLATE_SUCCESS) {
            refuse("its compressed values cannot be unpacked; it is probably truncated or damaged: write it again");
        }
        checkSize(got, size);
        return values;
    }

    std::string fromHex(std::string_view data, std::size_t size) const {
        std::string values;
        std::string digits;
        for (const char c : data) {
            if (c == ' ' || c == '\n' || c == '\r' || c == '\t') {
                continue;
            }
            digits += c;
            if (digits.size() == 2) {
                int byte = 0;
                const auto [stop, error] = std::from_chars(digits.data(), digits.data() + 2, byte, 16);
                if (error != std::errc() || stop != digits.data() + 2) {
                    refuse("has something else than hexadecimal digits among its values; write the file again");
                }
                values += static_cast<char>(byte);
                digits.clear();
            }
        }
        checkSize(values.size(), size);
        return values;
    }

    /// As doubles.
    std::string fromText(std::string_view data) const {
        checkSize(data.size(), 2 * values_ - 1);
        TextScanner scan(data, source_, '#');
        std::string values;
        for (std::size_t i = 0; i < values_; ++i) {
            const double value = scan.number("a value");
            values.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        return values;
    }

    Field fieldOf(const std::string& values) const {
        const bool text = isText();
        const bool bigEndian = get("endian") == "big";
        Field field;
        field.name = "value";
        field.components = static_cast<int>(components_.size);
        field.values.reserve(values_);
        const auto valueAt = [&](std::size_t place) {
            if (text) {
                double value;
                std::memcpy(&value, values.data() + place * sizeof value, sizeof value);
                return value;
            }
            return type_->at(values.data() + place * type_->size, bigEndian);
        };
        const auto size = sizes();
        for (std::size_t k = 0; k < size[2]; ++k) {
            for (std::size_t j = 0; j < size[1]; ++j) {
                for (std::size_t i = 0; i < size[0]; ++i) {
                    const std::size_t first = i * space_[0].stride + j * space_[1].stride + k * space_[2].stride;
                    for (std::size_t c = 0; c < components_.size; ++c) {
                        field.values.push_back(valueAt(first + c * components_.stride));
                    }
                }
            }
        }
        return field;
    }

    TextScanner scan_;
    const std::string& source_;
    Header header_;
    const VoxelType* type_ = nullptr;
    std::size_t values_ = 0;
    std::vector<Axis> axes_, space_;
    Axis components_{1, 0, {}, {}, 1.0};
};

}  // namespace

CellSoup parseNrrd(std::string_view bytes, const std::string& source,
                   const std::function<std::string(const std::string& file)>& readData) {
    return NrrdReader(bytes, source).read(readData);
}

}  // namespace tetralux::mesh
