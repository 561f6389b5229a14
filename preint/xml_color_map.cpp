// SPDX-License-Identifier: Apache-2.0
/// \file
/// Colour maps in XML as ParaView exported them before JSON (<ColorMap>, <Point x o r g b>) and as VisIt saves them
/// (.ct: ColorControlPoint with colors and position), turned into the form in which ParaView exports them now.
#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <preint/json_reading.h>

namespace tetralux::preint {
namespace {

struct Element {
    std::string name;  ///< "/Point" for a closing tag
    std::map<std::string, std::string> attributes;
    std::string text;  ///< up to the next tag
};

/// The elements of an XML text in their order; such maps need no nesting.
std::vector<Element> elementsOf(std::string_view xml) {
    std::vector<Element> elements;
    for (std::size_t at = xml.find('<'); at != std::string_view::npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string_view::npos) break;
        const std::string_view tag = xml.substr(at + 1, end - at - 1);
        Element element;
        element.name = std::string(tag.substr(0, tag.find_first_of(" \t\r\n")));
        for (std::size_t equals = tag.find('='); equals != std::string_view::npos; equals = tag.find('=', equals + 1)) {
            const std::size_t quote = tag.find_first_of("\"'", equals);
            const std::size_t close = quote == std::string_view::npos ? quote : tag.find(tag[quote], quote + 1);
            if (close == std::string_view::npos) break;
            const std::size_t last = tag.find_last_not_of(" \t\r\n", equals == 0 ? 0 : equals - 1);
            const std::size_t space = tag.find_last_of(" \t\r\n", last);
            if (last != std::string_view::npos && space != std::string_view::npos)
                element.attributes[std::string(tag.substr(space + 1, last - space))] =
                    std::string(tag.substr(quote + 1, close - quote - 1));
            equals = close;
        }
        const std::size_t next = std::min(xml.find('<', end), xml.size());
        element.text = std::string(xml.substr(end + 1, next - end - 1));
        elements.push_back(std::move(element));
    }
    return elements;
}

[[noreturn]] void refuse(const std::string& origin, const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {}", origin, what));
}

double numberOf(const std::string& text, const std::string& origin) {
    std::istringstream words(text);
    double number = 0.0;
    if (!(words >> number)) refuse(origin, fmt::format("'{}' is no number; write one there", text.substr(0, 40)));
    return number;
}

nlohmann::json fromParaView(const std::vector<Element>& elements, const std::string& origin) {
    nlohmann::json colors = nlohmann::json::array(), opacities = nlohmann::json::array();
    nlohmann::json categories = nlohmann::json::array();
    bool categorical = false, logarithmic = false;
    std::string space = "RGB";
    int maps = 0;
    for (const Element& element : elements) {
        const auto number = [&](const char* attribute, double otherwise) {
            const auto found = element.attributes.find(attribute);
            return found == element.attributes.end() ? otherwise : numberOf(found->second, origin);
        };
        if (element.name == "ColorMap") {
            if (++maps > 1) refuse(origin, "holds several color maps; keep one alone");
            const auto found = element.attributes.find("space");
            space = found == element.attributes.end() ? space : found->second;
            logarithmic = number("useLogScale", 0.0) == 1.0;
            const auto indexed = element.attributes.find("indexedLookup");
            categorical = indexed != element.attributes.end() && (indexed->second == "1" || indexed->second == "true");
        } else if (element.name == "Point") {
            const double x = number("x", 0.0);
            for (const char* channel : {"r", "g", "b"}) categories.push_back(number(channel, 0.0));
            for (const double value : {x, number("r", 0.0), number("g", 0.0), number("b", 0.0)})
                colors.push_back(value);
            for (const double value : {x, number("o", 1.0), 0.5, 0.0}) opacities.push_back(value);
        }
    }
    if (categorical) return {{"IndexedColors", categories}};
    nlohmann::json map{{"ColorSpace", space}, {"RGBPoints", colors}, {"UseLogScale", logarithmic}};
    bool opaque = true;  // as maps of colours alone are
    for (std::size_t i = 1; i < opacities.size(); i += 4) opaque = opaque && opacities[i] == 1.0;
    if (!opaque) map["Points"] = opacities;
    return map;
}

nlohmann::json fromVisIt(const std::vector<Element>& elements, const std::string& origin) {
    struct Control {
        std::vector<double> rgba{0.0, 0.0, 0.0, 255.0};
        double position = 0.0;
    };
    std::vector<Control> controls;
    bool equal = false;
    for (const Element& element : elements) {
        const auto found = element.attributes.find("name");
        const std::string name = found == element.attributes.end() ? "" : found->second;
        std::istringstream words(element.text);
        if (element.name == "Object" && name == "ColorControlPoint") {
            controls.emplace_back();
        } else if (element.name == "Field" && name == "colors" && !controls.empty()) {
            for (double& channel : controls.back().rgba) words >> channel;
        } else if (element.name == "Field" && name == "position" && !controls.empty()) {
            controls.back().position = numberOf(element.text, origin);
        } else if (element.name == "Field" && (name == "equalSpacingFlag" || name == "equal")) {
            equal = element.text.find("true") != std::string::npos;
        } else if (element.name == "Field" && (name == "discreteFlag" || name == "discrete") &&
                   element.text.find("true") != std::string::npos) {
            refuse(origin, "is a discrete color table of VisIt; save a continuous one");
        }
    }
    nlohmann::json colors = nlohmann::json::array(), opacities = nlohmann::json::array();
    bool opaque = true;
    for (std::size_t i = 0; i < controls.size(); ++i) {
        const Control& control = controls[i];
        const double steps = static_cast<double>(std::max<std::size_t>(1, controls.size() - 1));
        const double s = equal ? static_cast<double>(i) / steps : control.position;
        for (const double value : {s, control.rgba[0] / 255.0, control.rgba[1] / 255.0, control.rgba[2] / 255.0})
            colors.push_back(value);
        for (const double value : {s, control.rgba[3] / 255.0, 0.5, 0.0}) opacities.push_back(value);
        opaque = opaque && control.rgba[3] == 255.0;
    }
    nlohmann::json map{{"ColorSpace", "RGB"}, {"RGBPoints", colors}};
    if (!opaque) map["Points"] = opacities;
    return map;
}

}  // namespace

nlohmann::json xmlColorMap(const std::string& text, const std::string& origin) {
    const std::vector<Element> elements = elementsOf(text);
    for (const Element& element : elements) {
        if (element.name == "ColorMap") return fromParaView(elements, origin);
        const auto found = element.attributes.find("name");
        if (element.name == "Object" && found != element.attributes.end() && found->second.starts_with("ColorControl"))
            return fromVisIt(elements, origin);
    }
    refuse(origin,
           "is XML without a <ColorMap> of ParaView or the control points of a .ct of VisIt; save one of these, "
           "or JSON as ParaView exports it");
}

}  // namespace tetralux::preint
