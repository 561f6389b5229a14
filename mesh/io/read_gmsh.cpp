// SPDX-License-Identifier: Apache-2.0
/// \file
/// Gmsh's MSH format as its reference manual describes it (versions 1, 2.2 and 4.1). Gmsh's own library is GPL and
/// would make the renderer so.
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/gmsh_elements.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/parse_mesh.h>
#include <mesh/io/region_field.h>
#include <mesh/io/text_scanner.h>
#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {
namespace {

/// Values at nodes or elements, at one time step.
struct View {
    std::string name;
    Association association = Association::Point;
    double time = 0.0;
    std::size_t components = 1;
    std::vector<std::int64_t> tags;
    std::vector<double> values;
};

class GmshParser {
public:
    GmshParser(std::string_view bytes, const std::string& source) : scan_(bytes, source, '\0') {}

    CellSoup parse(std::optional<double> time) {
        parseFormat();
        while (!scan_.atEnd()) {
            parseSection(std::string(scan_.word("a section")));
        }
        soup_.connectivity.reserve(nodeTags_.size());
        for (const std::int64_t tag : nodeTags_) {
            soup_.connectivity.push_back(indexOf(pointOf_, tag));
        }
        nodeTags_ = {};
        addRegionField(soup_, "entity", std::move(entities_));
        addViews(time);
        addPhysicalGroups();
        return std::move(soup_);
    }

private:
    void parseFormat() {
        if (scan_.peek().starts_with('(')) {
            scan_.refuse("is a mesh of ANSYS Fluent, not of Gmsh", "give it the ending .cas");
        }
        while (scan_.peek().starts_with('$') && scan_.peek() != "$MeshFormat" && scan_.peek() != "$NOD") {
            endSection("$End" + std::string(scan_.word("a section").substr(1)));  // remarks
        }
        if (scan_.peek() == "$NOD") {
            return;  // version 1 has no head
        }
        if (scan_.peek() != "$MeshFormat") {
            scan_.refuse("does not begin with $MeshFormat as a Gmsh mesh does",
                         "check the name's ending or write the file again");
        }
        scan_.word("$MeshFormat");
        const std::string version(scan_.word("the version"));
        isFour_ = version == "4.1";
        if (!isFour_ && version != "2" && version != "2.0" && version != "2.1" && version != "2.2") {
            scan_.refuse("is in a version of Gmsh's format that cannot be read", "save it as version 4.1 or 2.2");
        }
        binary_ = scan_.integer("the kind of file") != 0;
        const std::int64_t size = scan_.integer("the size of a number");
        if (size != 8) {
            scan_.refuse(fmt::format("has numbers of {} bytes where 8 can be read", size),
                         "save it on a 64-bit machine");
        }
        if (binary_) {
            scan_.restOfLine();
            const auto one = takeBinary<std::int32_t>(scan_, false, "the byte order");
            swap_ = one != 1;
        }
        endSection("$EndMeshFormat");
    }

    void endSection(std::string_view end) {
        if (!scan_.skipPast(end)) {
            scan_.fail(fmt::format("ends before {}", end));
        }
    }

    void parseSection(const std::string& section) {
        if (section.empty() || section[0] != '$') {
            scan_.fail("has words between its sections");
        }
        if (binary_ && section != "$NodeData" && section != "$ElementData") {
            scan_.restOfLine();
        }
        if (section == "$Nodes") {
            isFour_ ? parseNodes4() : parseNodes2();
        } else if (section == "$Elements") {
            isFour_ ? parseElements4() : parseElements2();
        } else if (section == "$NOD") {
            parseNodes2();
        } else if (section == "$ELM") {
            parseElements1();
        } else if (section == "$NodeData") {
            parseView(Association::Point);
        } else if (section == "$ElementData") {
            parseView(Association::Cell);
        } else if (section == "$PhysicalNames") {
            parsePhysicalNames();
        }
        endSection((section == "$NOD" || section == "$ELM" ? "$END" : "$End") + section.substr(1));
    }

    /// Lines of dimension, number and name in quotes.
    void parsePhysicalNames() {
        const std::size_t count = scan_.count("the number of physical names", 6);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t dimension = scan_.integer("the dimension of a physical group");
            const std::int64_t number = scan_.integer("the number of a physical group");
            const std::string_view rest = scan_.restOfLine();
            const std::size_t open = rest.find('"'), close = rest.rfind('"');
            if (dimension == 3 && open != std::string_view::npos && close > open)
                soup_.blockNames.push_back(
                    {"physical", static_cast<double>(number), std::string(rest.substr(open + 1, close - open - 1))});
        }
    }

    // One number, in whichever way the file is written. Counts and tags are 4 bytes in version 2 and 8 in version 4.
    std::int64_t takeInt(const char* what) {
        return binary_ ? takeBinary<std::int32_t>(scan_, swap_, what) : scan_.integer(what);
    }
    std::int64_t takeSize(const char* what) {
        return binary_ ? takeBinary<std::int64_t>(scan_, swap_, what) : scan_.integer(what);
    }
    double takeReal(const char* what) { return binary_ ? takeBinary<double>(scan_, swap_, what) : scan_.number(what); }
    std::size_t checkedCount(std::int64_t count, const char* what, std::size_t bytesEach) {
        if (count < 0 || static_cast<std::uint64_t>(count) > scan_.remaining() / bytesEach) {
            scan_.fail(fmt::format("{} is {}, but the file is too short for that", what, count));
        }
        return static_cast<std::size_t>(count);
    }
    /// A count that stands in text even in binary files of version 2.
    std::size_t textCount(const char* what, std::size_t bytesEach) {
        const std::size_t count = scan_.count(what, bytesEach);
        if (binary_) {
            scan_.restOfLine();
        }
        return count;
    }

    glm::dvec3 takePosition() {
        const double x = takeReal("a coordinate");
        const double y = takeReal("a coordinate");
        return {x, y, takeReal("a coordinate")};
    }

    void addNode(std::int64_t tag, const glm::dvec3& position) {
        pointOf_[tag] = static_cast<std::uint32_t>(soup_.points.size());
        soup_.points.push_back(position);
    }

    void parseNodes2() {
        const std::size_t count = textCount("the number of nodes", 8);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t tag = takeInt("the number of a node");
            addNode(tag, takePosition());
        }
    }

    void parseNodes4() {
        const std::size_t blocks = checkedCount(takeSize("the number of blocks"), "the number of blocks", 8);
        for (int i = 0; i < 3; ++i) {
            takeSize("the numbers of nodes");
        }
        std::vector<std::int64_t> tags;
        for (std::size_t block = 0; block < blocks; ++block) {
            const std::int64_t dimension = takeInt("the dimension of a block");
            takeInt("the entity of a block");
            const bool parametric = takeInt("the flag of parameters") != 0;
            const std::size_t count = checkedCount(takeSize("the number of nodes"), "the number of nodes", 8);
            tags.clear();
            for (std::size_t i = 0; i < count; ++i) {
                tags.push_back(takeSize("the number of a node"));
            }
            for (const std::int64_t tag : tags) {
                addNode(tag, takePosition());
                for (std::int64_t d = 0; parametric && d < dimension; ++d) {
                    takeReal("a parameter");
                }
            }
        }
    }

    /// Takes the nodes of one element. They stay tags until all nodes are known.
    void takeElement(std::int64_t tag, const GmshElement& element, std::int64_t entity, bool wideTags) {
        std::vector<std::int64_t>& nodes = elementNodes_;
        nodes.resize(static_cast<std::size_t>(element.points));
        for (std::int64_t& node : nodes) {
            node = wideTags ? takeSize("a node of an element") : takeInt("a node of an element");
        }
        if (soup_.offsets.empty()) {
            soup_.offsets.push_back(0);
        }
        cellOf_[tag] = static_cast<std::uint32_t>(soup_.types.size());
        entities_.push_back(static_cast<double>(entity));
        soup_.types.push_back(element.type);
        for (const int place : element.order) {
            nodeTags_.push_back(nodes[static_cast<std::size_t>(place)]);
        }
        soup_.offsets.push_back(nodeTags_.size());
    }

    GmshElement knownElement(std::int64_t type) {
        const GmshElement element = gmshElement(type >= 0 && type < 1000 ? static_cast<int>(type) : 0);
        if (element.points == 0) {
            scan_.refuse(fmt::format("has elements of Gmsh's type {}, which is not known", type),
                         "save it with complete elements of order 10 or less (Mesh.SecondOrderIncomplete = 0)");
        }
        return element;
    }

    /// Tags of an element in version 2: physical group, elementary entity, then partitions. \returns the entity.
    std::int64_t takeTags2(std::int64_t count) {
        std::int64_t entity = 0;
        physicals_.resize(entities_.size() + 1, 0.0);
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t tag = takeInt("a tag of an element");
            entity = i == 1 ? tag : entity;
            physicals_.back() = i == 0 ? static_cast<double>(tag) : physicals_.back();
        }
        return entity;
    }

    /// Version 2 names the group of each element; one that all solids have says nothing.
    void addPhysicalGroups() {
        if (!physicals_.empty()) {
            physicals_.resize(soup_.types.size(), 0.0);
            addRegionField(soup_, "physical", std::move(physicals_));
            if (soup_.fields.back().bookkeeping) {
                soup_.fields.pop_back();
            }
        }
    }

    void parseElements2() {
        const std::size_t count = textCount("the number of elements", 8);
        for (std::size_t done = 0; done < count;) {
            std::int64_t tag = binary_ ? 0 : scan_.integer("the number of an element");
            const GmshElement element = knownElement(takeInt("the type of an element"));
            const std::size_t block =
                binary_ ? checkedCount(takeInt("the number of elements"), "the number of elements in a block", 4) : 1;
            const std::int64_t tags = takeInt("the number of tags");
            if (tags < 0 || block == 0) {
                scan_.fail("has a block of elements without any, or a negative number of tags");
            }
            for (std::size_t i = 0; i < block; ++i, ++done) {
                tag = binary_ ? takeInt("the number of an element") : tag;
                const std::int64_t entity = takeTags2(tags);
                takeElement(tag, element, entity, false);
            }
        }
    }

    /// Of version 1: number, type, physical group, entity, number of nodes, nodes.
    void parseElements1() {
        const std::size_t count = scan_.count("the number of elements", 12);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t tag = scan_.integer("the number of an element");
            const GmshElement element = knownElement(scan_.integer("the type of an element"));
            const std::int64_t physical = scan_.integer("the physical group of an element");
            const std::int64_t entity = scan_.integer("the entity of an element");
            const std::int64_t nodes = scan_.integer("the number of nodes of an element");
            if (nodes != element.points) {
                scan_.fail(fmt::format("has an element of {} nodes where its type has {}", nodes, element.points));
            }
            physicals_.push_back(static_cast<double>(physical));
            takeElement(tag, element, entity, false);
        }
    }

    void parseElements4() {
        const std::size_t blocks = checkedCount(takeSize("the number of blocks"), "the number of blocks", 8);
        for (int i = 0; i < 3; ++i) {
            takeSize("the numbers of elements");
        }
        for (std::size_t block = 0; block < blocks; ++block) {
            takeInt("the dimension of a block");
            const std::int64_t entity = takeInt("the entity of a block");
            const GmshElement element = knownElement(takeInt("the type of an element"));
            const std::size_t count = checkedCount(takeSize("the number of elements"), "the number of elements", 4);
            for (std::size_t i = 0; i < count; ++i) {
                const std::int64_t tag = takeSize("the number of an element");
                takeElement(tag, element, entity, true);
            }
        }
    }

    std::string quotedLine() {
        scan_.atEnd();
        std::string line(scan_.restOfLine());
        const std::size_t open = line.find('"');
        const std::size_t close = line.rfind('"');
        return open < close && close != std::string::npos ? line.substr(open + 1, close - open - 1) : line;
    }

    void parseView(Association association) {
        View view;
        view.association = association;
        const std::size_t strings = scan_.count("the number of names", 1);
        scan_.restOfLine();
        for (std::size_t i = 0; i < strings; ++i) {
            const std::string text = quotedLine();
            view.name = i == 0 ? text : view.name;
        }
        const std::size_t reals = scan_.count("the number of times", 1);
        for (std::size_t i = 0; i < reals; ++i) {
            const double real = scan_.number("a time");
            view.time = i == 0 ? real : view.time;
        }
        const std::size_t integers = scan_.count("the number of sizes", 1);
        std::size_t count = 0;
        for (std::size_t i = 0; i < integers; ++i) {
            const std::int64_t value = scan_.integer("a size");
            if (i == 1) {
                view.components = checkedCount(value, "the number of components", 1);
            } else if (i == 2) {
                count = checkedCount(value, "the number of values", 2);
            }
        }
        constexpr std::size_t mostComponents = 1000;
        if (view.components < 1 || view.components > mostComponents) {
            scan_.fail(fmt::format("has values of {} components", view.components));
        }
        if (binary_) {
            scan_.restOfLine();
        }
        for (std::size_t i = 0; i < count; ++i) {
            view.tags.push_back(takeInt("the number of a node or element"));
            for (std::size_t c = 0; c < view.components; ++c) {
                view.values.push_back(takeReal("a value"));
            }
        }
        views_.push_back(std::move(view));
    }

    using Numbers = std::unordered_map<std::int64_t, std::uint32_t>;
    static std::uint32_t indexOf(const Numbers& numbers, std::int64_t tag) {
        const auto found = numbers.find(tag);
        return found == numbers.end() ? CellSoup::invalidPoint : found->second;
    }

    /// One field for each name, from its view at the time nearest to `wanted`. Places without a value get NaN.
    void addViews(std::optional<double> wanted) {
        std::map<std::pair<Association, std::string>, std::size_t> chosen;
        std::map<double, int> times;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const auto [place, isNew] = chosen.try_emplace({views_[i].association, views_[i].name}, i);
            times[views_[i].time] = 0;
            if (!isNew && wanted &&
                std::abs(views_[i].time - *wanted) < std::abs(views_[place->second].time - *wanted)) {
                place->second = i;
            }
        }
        for (std::size_t i = 0; i < views_.size(); ++i) {
            if (chosen.at({views_[i].association, views_[i].name}) == i) {
                addView(views_[i]);
            }
        }
        for (const auto& [time, unused] : times) {
            soup_.times.push_back(time);
        }
        if (soup_.times.size() < 2) {
            soup_.times.clear();
        }
    }

    void addView(const View& view) {
        const bool onPoints = view.association == Association::Point;
        const Numbers& numbers = onPoints ? pointOf_ : cellOf_;
        Field field;
        field.name = view.name;
        field.association = view.association;
        field.components = static_cast<int>(view.components);
        field.values.assign((onPoints ? soup_.points.size() : soup_.types.size()) * view.components,
                            std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < view.tags.size(); ++i) {
            const std::uint32_t place = indexOf(numbers, view.tags[i]);
            for (std::size_t c = 0; c < view.components && place != CellSoup::invalidPoint; ++c) {
                field.values[place * view.components + c] = view.values[i * view.components + c];
            }
        }
        soup_.fields.push_back(std::move(field));
    }

    TextScanner scan_;
    bool isFour_ = false;
    bool binary_ = false;
    bool swap_ = false;
    CellSoup soup_;
    Numbers pointOf_;
    Numbers cellOf_;
    std::vector<std::int64_t> nodeTags_;  ///< the connectivity until all nodes are known
    std::vector<std::int64_t> elementNodes_;
    std::vector<double> entities_;
    std::vector<double> physicals_;
    std::vector<View> views_;
};

bool acceptsGmsh(const std::string& source) {
    return hasExtension(source, {".msh"});
}

CellSoup readGmsh(const std::string& source, const ReadOptions& options) {
    return parseGmsh(readWholeFile(source), source, options.time);
}

}  // namespace

CellSoup parseGmsh(std::string_view bytes, const std::string& source, std::optional<double> time) {
    return GmshParser(bytes, source).parse(time);
}

const MeshFormat gmshFormat{"Gmsh", ".msh", acceptsGmsh, readGmsh};

}  // namespace tetralux::mesh
