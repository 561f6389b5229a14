// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/appended_vtu.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <mesh/io/appended_data.h>
#include <mesh/io/bookkeeping_names.h>
#include <mesh/io/number_text.h>
#include <mesh/soup/append_soup.h>
#include <mesh/soup/cell_types.h>
#include <mesh/tet/huge_pages.h>

namespace tetralux::mesh {
namespace {

class OpenFile {
public:
    explicit OpenFile(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
        struct stat status {};
        size_ = file_ >= 0 && ::fstat(file_, &status) == 0 && S_ISREG(status.st_mode)
                    ? static_cast<std::uint64_t>(status.st_size)
                    : 0;
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (file_ >= 0) {
            ::close(file_);
        }
    }
    int get() const { return file_; }
    std::uint64_t size() const { return size_; }

private:
    int file_;
    std::uint64_t size_ = 0;
};

/// Calls `use(T{})` with the value type called `type`. \returns false if there is none.
template <class Use>
bool withType(const std::string& type, const Use& use) {
    if (type == "Float64") {
        return use(double{});
    }
    if (type == "Float32") {
        return use(float{});
    }
    if (type == "Int64") {
        return use(std::int64_t{});
    }
    if (type == "Int32") {
        return use(std::int32_t{});
    }
    if (type == "UInt64") {
        return use(std::uint64_t{});
    }
    if (type == "UInt32") {
        return use(std::uint32_t{});
    }
    if (type == "UInt8") {
        return use(std::uint8_t{});
    }
    if (type == "Int8") {
        return use(std::int8_t{});
    }
    if (type == "UInt16") {
        return use(std::uint16_t{});
    }
    if (type == "Int16") {
        return use(std::int16_t{});
    }
    return false;
}

/// The line in which byte `place` of the file stands, from 1.
std::uint64_t lineOf(int file, std::uint64_t place) {
    std::vector<char> bytes(1u << 20);
    std::uint64_t line = 1;
    for (std::uint64_t at = 0; at < place;) {
        const ssize_t got =
            ::pread(file, bytes.data(), std::min<std::uint64_t>(bytes.size(), place - at), static_cast<off_t>(at));
        if (got <= 0) {
            break;
        }
        line += static_cast<std::uint64_t>(std::count(bytes.data(), bytes.data() + got, '\n'));
        at += static_cast<std::uint64_t>(got);
    }
    return line;
}

/// What is wrong with a text array.
class BadText : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Makes a soup of one piece.
class Assembly {
public:
    Assembly(const OpenFile& file, const VtuHead& head, const VtuPiece& piece)
        : file_(file), head_(head), piece_(piece) {}

    std::optional<CellSoup> assemble() {
        // No array is smaller than a 1100th of its bytes, so counts beyond that are damage.
        if (piece_.points / 1100 > file_.size() || piece_.cells / 1100 > file_.size() || piece_.cells == 0) {
            return std::nullopt;
        }
        onlyTetrahedra_ = hasOnlyTetrahedra();
        if (!isEachOnce()) {
            return std::nullopt;
        }
        fields_.resize(piece_.arrays.size());
        std::atomic<bool> good = true;
        // All at once, because to make room for an array is work for one thread.
        tbb::parallel_for(std::size_t{0}, piece_.arrays.size(), [&](std::size_t i) {
            if (!take(piece_.arrays[i], fields_[i])) {
                good.store(false, std::memory_order_relaxed);
            }
        });
        for (std::optional<Field>& field : fields_) {
            if (field) {
                soup_.fields.push_back(std::move(*field));
            }
        }
        return good && isWhole() ? std::optional(std::move(soup_)) : std::nullopt;
    }

private:
    /// Whether there is one array of points and one of each kind for cells, so that no two write to one place.
    bool isEachOnce() const {
        const auto count = [&](VtuArray::Place place, const char* name) {
            return std::count_if(piece_.arrays.begin(), piece_.arrays.end(), [&](const VtuArray& array) {
                return array.place == place && (name == nullptr || array.name == name);
            });
        };
        return count(VtuArray::Place::Points, nullptr) == 1 && count(VtuArray::Place::Cells, nullptr) == 3 &&
               count(VtuArray::Place::Cells, "connectivity") == 1 && count(VtuArray::Place::Cells, "offsets") == 1 &&
               count(VtuArray::Place::Cells, "types") == 1;
    }

    bool isWhole() const {
        const bool cells = onlyTetrahedra_ ? soup_.tetrahedra.size() == piece_.cells
                                           : soup_.types.size() == piece_.cells && !soup_.offsets.empty() &&
                                                 soup_.offsets.back() == soup_.connectivity.size();
        return cells && soup_.points.size() == piece_.points;
    }

    /// Calls `use(T{})` with the type in which the array's values are read: text is, if not of whole numbers, as
    /// doubles.
    template <class Use>
    static bool withTypeOf(const VtuArray& array, const Use& use) {
        return withType(array.form == VtuArray::Form::Text && array.type == "Float32" ? "Float64" : array.type, use);
    }

    /// \throws BadText if a word of `text` is no number: other readers would stop there without saying which.
    template <class T>
    void refuseBadWord(const VtuArray& array, const TextArray<T>& text) const {
        if (const std::optional<BadWord> bad = text.isSound() ? text.firstBadWord() : std::nullopt) {
            double value = 0.0;
            const NumberText kind = std::is_floating_point_v<T> ? parseNumber(bad->word, value) : NumberText::None;
            const std::string what = fmt::format("a value of '{}'", array.name.empty() ? "Points" : array.name);
            throw BadText(fmt::format("line {}: {}; {}", lineOf(file_.get(), bad->place),
                                      complaintOf(bad->word, kind, what), remedyFor(bad->word, kind)));
        }
    }

    /// Calls `use(array)` with the array's values in whatever form they are.
    template <class T, class Use>
    bool withData(const VtuArray& array, const Use& use) const {
        if (array.form == VtuArray::Form::Text) {
            if constexpr (!std::is_same_v<T, float>) {
                const TextArray<T> text(file_.get(), array.start, array.end, array.type == "Float32");
                if (use(text)) {
                    return true;
                }
                refuseBadWord(array, text);
            }
            return false;
        }
        VtuEncoding encoding = head_.encoding;
        const bool appended = array.form == VtuArray::Form::Appended;
        encoding.base64 = encoding.base64 || !appended;
        const std::uint64_t start = appended ? head_.dataStart + array.start : array.start;
        return array.start <= file_.size() && use(EncodedArray(file_.get(), file_.size(), encoding, start, sizeof(T)));
    }

    /// Whether every value of the array of cells called `name` is `wanted(i)`, without keeping it.
    template <class Wanted>
    bool isAlways(const std::string& name, const Wanted& wanted) const {
        for (const VtuArray& array : piece_.arrays) {
            if (array.place != VtuArray::Place::Cells || array.name != name) {
                continue;
            }
            return withTypeOf(array, [&](auto zero) {
                using T = decltype(zero);
                return withData<T>(array, [&](const auto& data) {
                    std::atomic<bool> always = data.isSound() && data.elements() == piece_.cells;
                    const bool read =
                        always && data.forEachPiece([&](std::uint64_t first, const char* bytes, std::uint64_t count) {
                            bool same = true;
                            for (std::uint64_t i = 0; i < count; ++i) {
                                T value;
                                std::memcpy(&value, bytes + i * sizeof(T), sizeof(T));
                                same &= value == static_cast<T>(wanted(first + i));
                            }
                            if (!same) {
                                always.store(false, std::memory_order_relaxed);
                            }
                        });
                    return read && always;
                });
            });
        }
        return false;
    }

    bool hasOnlyTetrahedra() const {
        return isAlways("types", [](std::uint64_t) { return cell_type::tetrahedron; }) &&
               isAlways("offsets", [](std::uint64_t i) { return 4 * (i + 1); });
    }

    /// Puts an array of points or cells into `soup_`, another one into `field`.
    bool take(const VtuArray& array, std::optional<Field>& field) {
        switch (array.place) {
            case VtuArray::Place::Points:
                return array.components == 3 && takePoints(array);
            case VtuArray::Place::Cells:
                return takeCells(array);
            case VtuArray::Place::PointData:
                return takeField(array, Association::Point, piece_.points, field.emplace());
            case VtuArray::Place::CellData:
                return takeField(array, Association::Cell, piece_.cells, field.emplace());
        }
        return false;
    }

    /// Converts all values of an array by `convert(T value)` into what `makeRoom(count)` points to.
    template <class Out, class MakeRoom, class Convert>
    bool decode(const VtuArray& array, const MakeRoom& makeRoom, const Convert& convert) {
        return withTypeOf(array, [&](auto zero) {
            using T = decltype(zero);
            return withData<T>(array, [&](const auto& data) {
                Out* const out = data.isSound() ? makeRoom(data.elements()) : nullptr;
                return out != nullptr &&
                       data.forEachPiece([&](std::uint64_t first, const char* bytes, std::uint64_t count) {
                           for (std::uint64_t i = 0; i < count; ++i) {
                               T value;
                               std::memcpy(&value, bytes + i * sizeof(T), sizeof(T));
                               out[first + i] = convert(value);
                           }
                       });
            });
        });
    }

    bool takePoints(const VtuArray& array) {
        const auto room = [&](std::uint64_t count) -> double* {
            if (count != 3 * piece_.points || count == 0) {
                return nullptr;
            }
            resizeInHugePages(soup_.points, piece_.points);
            return &soup_.points[0].x;
        };
        return decode<double>(array, room, [](auto value) { return static_cast<double>(value); });
    }

    bool takeCells(const VtuArray& array) {
        if (array.components != 1 || array.type.starts_with("Float")) {
            return false;
        }
        if (array.name == "connectivity") {
            const auto room = [&](std::uint64_t count) -> std::uint32_t* {
                if (onlyTetrahedra_) {
                    resizeInHugePages(soup_.tetrahedra, count == 4 * piece_.cells ? piece_.cells : 0);
                    return soup_.tetrahedra.empty() ? nullptr : soup_.tetrahedra[0].data();
                }
                resizeInHugePages(soup_.connectivity, count);
                return soup_.connectivity.data();
            };
            return decode<std::uint32_t>(array, room, [](auto value) {
                const bool fits = value >= 0 && static_cast<std::uint64_t>(value) < CellSoup::invalidPoint;
                return fits ? static_cast<std::uint32_t>(value) : CellSoup::invalidPoint;
            });
        }
        if (onlyTetrahedra_) {
            return array.name == "types" || array.name == "offsets";  // known already
        }
        if (array.name == "offsets") {
            const auto room = [&](std::uint64_t count) -> std::uint64_t* {
                soup_.offsets.assign(count == piece_.cells ? count + 1 : 0, 0);
                return count == piece_.cells ? soup_.offsets.data() + 1 : nullptr;
            };
            return decode<std::uint64_t>(array, room, [](auto value) { return static_cast<std::uint64_t>(value); });
        }
        const auto room = [&](std::uint64_t count) -> std::uint8_t* {
            soup_.types.resize(count == piece_.cells ? count : 0);
            return count == piece_.cells ? soup_.types.data() : nullptr;
        };
        return array.name == "types" &&
               decode<std::uint8_t>(array, room,
                                    [](auto value) {
                                        return value >= 0 && value < cell_type::gmshPyramid &&
                                                       value != cell_type::polyhedron
                                                   ? static_cast<std::uint8_t>(value)
                                                   : std::uint8_t{255};
                                    }) &&
               std::find(soup_.types.begin(), soup_.types.end(), 255) == soup_.types.end();
    }

    /// Number of the array among those of its place.
    std::ptrdiff_t numberOf(const VtuArray& array) const {
        return std::count_if(piece_.arrays.data(), &array,
                             [&](const VtuArray& earlier) { return earlier.place == array.place; });
    }

    bool takeField(const VtuArray& array, Association association, std::uint64_t places, Field& field) {
        if (array.name.starts_with("vtkGhost") || array.name == "vtkValidPointMask" ||
            array.name == "RationalWeights" || array.name == "HigherOrderDegrees") {
            return false;  // more than a field: VTK's reader knows
        }
        field.name = array.name.empty() ? fmt::format("array {}", numberOf(array)) : array.name;
        field.association = association;
        field.components = array.components;
        field.componentNames = array.componentNames;
        field.bookkeeping = isBookkeepingName(array.name);
        const std::uint64_t wanted = places * static_cast<std::uint64_t>(array.components);
        const auto room = [&](std::uint64_t count) -> double* {
            resizeInHugePages(field.values, count == wanted ? count : 0);
            return count == wanted ? field.values.data() : nullptr;
        };
        return decode<double>(array, room, [](auto value) { return static_cast<double>(value); });
    }

    const OpenFile& file_;
    const VtuHead& head_;
    const VtuPiece& piece_;
    CellSoup soup_;
    std::vector<std::optional<Field>> fields_;  ///< for each array
    bool onlyTetrahedra_ = false;
};

/// Puts the points of Lagrange and Bézier hexahedra from VTK 8's order into that of VTK 9, in which the last two of
/// the upright edges have changed places.
void renumberHexahedronsOfVtk8(CellSoup& soup) {
    for (std::size_t cell = 0; cell < soup.types.size(); ++cell) {
        const bool curved =
            soup.types[cell] == cell_type::lagrangeHexahedron || soup.types[cell] == cell_type::bezierHexahedron;
        if (!curved || soup.offsets[cell] > soup.offsets[cell + 1] ||
            soup.offsets[cell + 1] > soup.connectivity.size()) {
            continue;
        }
        const std::size_t count = soup.offsets[cell + 1] - soup.offsets[cell];
        const std::size_t perEdge = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(count))));
        if (perEdge < 3 || perEdge * perEdge * perEdge != count) {
            continue;
        }
        const std::size_t inner = perEdge - 2;  // points of an edge between its ends
        std::uint32_t* const third = soup.connectivity.data() + soup.offsets[cell] + 8 + 10 * inner;
        std::swap_ranges(third, third + inner, third + inner);
    }
}

}  // namespace

std::optional<CellSoup> readAppendedVtu(const std::string& path) {
    const OpenFile file(path);
    const std::optional<VtuHead> head = file.size() > 0 ? parseVtuHead(file.get()) : std::nullopt;
    if (!head) {
        return std::nullopt;
    }
    CellSoup whole;
    for (const VtuPiece& piece : head->pieces) {
        if (piece.cells == 0 && head->pieces.size() > 1) {
            continue;
        }
        std::optional<CellSoup> soup;
        try {
            soup = Assembly(file, *head, piece).assemble();
        } catch (const BadText& error) {
            throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
        }
        if (!soup) {
            return std::nullopt;
        }
        if (head->hexahedronsOfVtk8) {
            renumberHexahedronsOfVtk8(*soup);
        }
        appendSoup(whole, std::move(*soup));
    }
    return whole.cellCount() > 0 ? std::optional(std::move(whole)) : std::nullopt;
}

}  // namespace tetralux::mesh
