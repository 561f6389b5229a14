// SPDX-License-Identifier: Apache-2.0
#include "volume_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkVolumeProperty.h"

namespace tetralux::vtk {

namespace {

using Value = std::array<double, 3>;  ///< of an opacity: the first alone

struct Node {
    double scalar;
    Value value;
};

/// A function of VTK's as nodes, straight between them, constant beyond.
struct Sampled {
    std::function<Value(double)> at;
    std::vector<Node> nodes;     ///< VTK's, ascending
    std::vector<bool> straight;  ///< whether the interval after each node is
};

double distance(const Value& a, const Value& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Adds nodes between two so that straight lines keep within `tolerance`; jumps are found to 2^-16 of an interval.
void follow(const Sampled& function, const Node& low, const Node& high, double tolerance, int depth,
            std::vector<Node>& out) {
    const auto between = [&](double share) {
        return Node{std::lerp(low.scalar, high.scalar, share), function.at(std::lerp(low.scalar, high.scalar, share))};
    };
    double error = 0;
    for (const double share : {0.25, 0.5, 0.75}) {
        Value line{};
        for (std::size_t c = 0; c < 3; ++c) line[c] = std::lerp(low.value[c], high.value[c], share);
        error = std::max(error, distance(line, between(share).value));
    }
    if (error <= tolerance || depth == 0) return;
    const Node middle = between(0.5);
    follow(function, low, middle, tolerance, depth - 1, out);
    out.push_back(middle);
    follow(function, middle, high, tolerance, depth - 1, out);
}

std::vector<Node> straightNodes(const Sampled& function) {
    constexpr int first = 4, deepest = 12;
    double largest = 0;
    for (const Node& node : function.nodes) largest = std::max(largest, distance(node.value, {}));
    std::vector<Node> result;
    for (std::size_t i = 0; i < function.nodes.size(); ++i) {
        const Node& node = function.nodes[i];
        if (result.size() >= 2 && result[result.size() - 2].scalar == node.scalar)
            result.pop_back();  // two make a jump
        result.push_back(node);
        if (i + 1 == function.nodes.size() || function.straight[i]) continue;
        const Node& next = function.nodes[i + 1];
        Node last = node;
        for (int part = 1; part <= (1 << first); ++part) {
            const double scalar = std::lerp(node.scalar, next.scalar, part / static_cast<double>(1 << first));
            const Node here = part == 1 << first ? next : Node{scalar, function.at(scalar)};
            follow(function, last, here, 1e-4 * largest, deepest, result);
            if (part != 1 << first) result.push_back(here);
            last = here;
        }
    }
    return result;
}

/// Beyond the nodes that value: a jump at the first, and one just beyond the last, whose own scalar keeps its value.
void endBelow(std::vector<Node>& nodes, const Value& value) {
    nodes.insert(nodes.begin(),
                 {std::nextafter(nodes.front().scalar, -std::numeric_limits<double>::infinity()), value});
    nodes.insert(nodes.begin() + 1, {nodes.front().scalar, nodes[1].value});
}
void endAbove(std::vector<Node>& nodes, const Value& value) {
    const double scalar = std::nextafter(nodes.back().scalar, std::numeric_limits<double>::infinity());
    nodes.push_back({scalar, nodes.back().value});
    nodes.push_back({scalar, value});
}

/// \throws Error for a function without nodes.
void requireNodes(const std::vector<Node>& nodes, const char* what) {
    if (nodes.empty())
        throw Error(Errc::BadInput, std::string(what) + " of the volume's property has no points; add some");
}

bool midpointIsPlain(double midpoint, double sharpness) {
    return midpoint == 0.5 && sharpness == 0;
}

/// ParaView's functions are tables of 256 colours unless somebody wants fewer, which are steps to be seen.
bool inSteps(vtkColorTransferFunction& function) {
    constexpr vtkIdType smooth = 128;
    auto* discretizable = vtkDiscretizableColorTransferFunction::SafeDownCast(&function);
    return discretizable != nullptr && discretizable->GetDiscretize() && discretizable->GetNumberOfValues() < smooth;
}

Value colorAt(vtkColorTransferFunction& function, double scalar) {
    Value color;
    if (inSteps(function))
        function.GetColor(scalar, color.data());
    else
        function.vtkColorTransferFunction::GetColor(scalar, color.data());
    return color;
}

std::vector<Node> colorNodes(vtkColorTransferFunction& function) {
    Sampled sampled;
    sampled.at = [&](double scalar) { return colorAt(function, scalar); };
    const bool rgb =
        function.GetColorSpace() == VTK_CTF_RGB && function.GetScale() == VTK_CTF_LINEAR && !inSteps(function);
    for (int i = 0; i < function.GetSize(); ++i) {
        double node[6];
        function.GetNodeValue(i, node);
        sampled.nodes.push_back({node[0], {node[1], node[2], node[3]}});
        sampled.straight.push_back(rgb && midpointIsPlain(node[4], node[5]));
    }
    requireNodes(sampled.nodes, "the colour function");
    std::vector<Node> nodes = straightNodes(sampled);
    const bool clamped = function.GetClamping() != 0;
    const double* below = function.GetBelowRangeColor();
    const double* above = function.GetAboveRangeColor();
    if (function.GetUseBelowRangeColor())
        endBelow(nodes, {below[0], below[1], below[2]});
    else if (!clamped)
        endBelow(nodes, {});
    if (function.GetUseAboveRangeColor())
        endAbove(nodes, {above[0], above[1], above[2]});
    else if (!clamped)
        endAbove(nodes, {});
    return nodes;
}

std::vector<Node> scalarNodes(vtkPiecewiseFunction& function, const char* what) {
    Sampled sampled;
    sampled.at = [&](double scalar) {
        const double value = function.GetValue(scalar);
        return Value{value, value, value};
    };
    for (int i = 0; i < function.GetSize(); ++i) {
        double node[4];
        function.GetNodeValue(i, node);
        sampled.nodes.push_back({node[0], {node[1], node[1], node[1]}});
        sampled.straight.push_back(midpointIsPlain(node[2], node[3]) && !function.GetUseLogScale());
    }
    requireNodes(sampled.nodes, what);
    std::vector<Node> nodes = straightNodes(sampled);
    if (!function.GetClamping()) {
        endBelow(nodes, {});
        endAbove(nodes, {});
    }
    return nodes;
}

std::string numbers(std::initializer_list<double> values) {
    std::string text = "[";
    for (const double value : values) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.17g", value);
        text += (text.size() > 1 ? "," : "") + std::string(digits);
    }
    return text + "]";
}
std::string number(double value) {
    const std::string one = numbers({value});
    return one.substr(1, one.size() - 2);
}

double fraction(double value) {
    return std::clamp(value, 0.0, 1.0);
}
std::string colorText(const double* rgb) {
    return numbers({fraction(rgb[0]), fraction(rgb[1]), fraction(rgb[2])});
}

template <class Text>
std::string listOf(const std::vector<Node>& nodes, const Text& text) {
    std::string list = "[";
    for (const Node& node : nodes) list += (list.size() > 1 ? "," : "") + text(node);
    return list + "]";
}

std::string isosurfaceList(vtkVolumeProperty& property, const std::function<Value(double)>& colorOf) {
    vtkContourValues* values = property.GetIsoSurfaceValues();
    std::string list = "[";
    for (int i = 0; i < values->GetNumberOfContours(); ++i) {
        const double value = values->GetValue(i);
        const Value color = colorOf(value);
        list += std::string(i > 0 ? "," : "") + R"({"value":)" + number(value) + R"(,"opacity":)" +
                number(fraction(property.GetScalarOpacity(0)->GetValue(value))) + R"(,"color":)" +
                colorText(color.data()) + "}";
    }
    return list + "]";
}

std::string lightText(vtkLight& light) {
    const double intensity = light.GetIntensity();
    const double* color = light.GetDiffuseColor();
    std::string text =
        R"("color":)" + numbers({intensity * color[0], intensity * color[1], intensity * color[2]}) + "}";
    if (light.GetLightType() == VTK_LIGHT_TYPE_HEADLIGHT) return R"({"type":"head",)" + text;
    double position[3], focal[3];
    light.GetTransformedPosition(position);
    light.GetTransformedFocalPoint(focal);
    if (!light.GetPositional())
        return R"({"type":"directional","towards":)" +
               numbers({position[0] - focal[0], position[1] - focal[1], position[2] - focal[2]}) + "," + text;
    const double* fade = light.GetAttenuationValues();
    return R"({"type":"point","position":)" + numbers({position[0], position[1], position[2]}) + R"(,"attenuation":)" +
           numbers({fade[0], fade[1], fade[2]}) + "," + text;
}

}  // namespace

std::string functionText(vtkVolumeProperty& property, const OpacityUse& use) {
    std::vector<Node> colors;
    std::function<Value(double)> colorOf;
    if (property.GetColorChannels(0) == 1) {
        vtkPiecewiseFunction* gray = property.GetGrayTransferFunction(0);
        colors = scalarNodes(*gray, "the gray function");
        colorOf = [gray](double s) { return Value{gray->GetValue(s), gray->GetValue(s), gray->GetValue(s)}; };
    } else {
        vtkColorTransferFunction* rgb = property.GetRGBTransferFunction(0);
        colors = colorNodes(*rgb);
        colorOf = [rgb](double s) { return colorAt(*rgb, s); };
    }
    std::string text =
        R"({"normalized":false,"color":)" + listOf(colors, [](const Node& node) {
            return numbers({node.scalar, fraction(node.value[0]), fraction(node.value[1]), fraction(node.value[2])});
        });
    if (use.isosurfaces) return text + R"(,"isosurfaces":)" + isosurfaceList(property, colorOf) + "}";
    const double unit = property.GetScalarOpacityUnitDistance(0) * use.unitFactor;
    if (!(unit > 0))
        throw Error(Errc::BadInput, "the volume's property has no unit distance of opacity; set one above 0");
    const std::vector<Node> opacities = scalarNodes(*property.GetScalarOpacity(0), "the opacity function");
    if (use.isAlpha)
        return text + R"(,"unitDistance":)" + number(unit) + R"(,"opacity":)" +
               listOf(opacities,
                      [](const Node& node) {
                          return numbers({node.scalar, fraction(node.value[0])});
                      }) +
               "}";
    return text + R"(,"extinction":)" +
           listOf(opacities,
                  [unit](const Node& node) {
                      return numbers({node.scalar, std::max(0.0, node.value[0]) / unit});
                  }) +
           "}";
}

std::string lightingText(vtkVolumeProperty& property, vtkRenderer& renderer) {
    if (!property.GetShade(0)) return "";
    std::string lights;
    vtkLightCollection* collection = renderer.GetLights();
    vtkCollectionSimpleIterator place;
    collection->InitTraversal(place);
    while (vtkLight* light = collection->GetNextLight(place))
        if (light->GetSwitch()) lights += (lights.empty() ? "" : ",") + lightText(*light);
    if (lights.empty()) return "";
    return R"({"ambient":)" + number(property.GetAmbient(0)) + R"(,"exponent":)" +
           number(property.GetSpecularPower(0)) + R"(,"transmission":false,"material":{"diffuse":)" +
           number(property.GetDiffuse(0)) + R"(,"specular":)" + number(property.GetSpecular(0)) + R"(},"lights":[)" +
           lights + "]}";
}

}  // namespace tetralux::vtk
