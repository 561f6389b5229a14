// SPDX-License-Identifier: Apache-2.0
/// \file
/// Colour maps by the names that people know, each with one extinction ramp. Control points are the published ones:
/// viridis and inferno are matplotlib's 256-entry lists thinned to those entries between which straight lines keep
/// every listed colour within 1/510; the others are ParaView's built-in maps, in their own colour spaces.
#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <preint/color_space.h>
#include <preint/transfer_function.h>

namespace tetralux::preint {
namespace {

struct Preset {
    const char* name;
    ColorSpace space;
    double scalarUnit;  ///< control points are given in units of 1/scalarUnit of the range
    std::vector<ColorNode> nodes;
};

// clang-format off
const std::vector<Preset>& presets() {
    static const std::vector<Preset> all{
        {"viridis", ColorSpace::Rgb, 255.0, {
            {0, {0.267004, 0.004874, 0.329415}}, {7, {0.276022, 0.044167, 0.370164}}, {20, {0.283197, 0.115680, 0.436115}},
            {32, {0.278826, 0.175490, 0.483397}}, {44, {0.265145, 0.232956, 0.516599}}, {58, {0.241237, 0.296485, 0.539709}},
            {78, {0.203063, 0.379716, 0.553925}}, {110, {0.151918, 0.500685, 0.557587}}, {131, {0.124395, 0.578002, 0.548287}},
            {142, {0.119699, 0.618490, 0.536347}}, {150, {0.128087, 0.647749, 0.523491}}, {158, {0.150148, 0.676631, 0.506589}},
            {166, {0.185783, 0.704891, 0.485273}}, {176, {0.246070, 0.738910, 0.452024}}, {187, {0.327796, 0.773980, 0.406640}},
            {200, {0.440137, 0.811138, 0.340967}}, {215, {0.585678, 0.846661, 0.249897}}, {233, {0.772852, 0.877868, 0.131109}},
            {239, {0.835270, 0.886029, 0.102646}}, {243, {0.876168, 0.891125, 0.095250}}, {247, {0.916242, 0.896091, 0.100717}},
            {252, {0.964894, 0.902323, 0.123941}}, {255, {0.993248, 0.906157, 0.143936}},
        }},
        {"inferno", ColorSpace::Rgb, 255.0, {
            {0, {0.001462, 0.000466, 0.013866}}, {3, {0.004547, 0.003392, 0.030909}}, {11, {0.022447, 0.017199, 0.097327}},
            {19, {0.056449, 0.034569, 0.168414}}, {28, {0.104551, 0.047008, 0.253430}}, {36, {0.155850, 0.044559, 0.325338}},
            {42, {0.197297, 0.038400, 0.367535}}, {48, {0.238273, 0.036621, 0.396353}}, {56, {0.290763, 0.045644, 0.418637}},
            {67, {0.360284, 0.069247, 0.431497}}, {81, {0.447428, 0.101597, 0.431080}}, {96, {0.540920, 0.134729, 0.415123}},
            {111, {0.633998, 0.168992, 0.383704}}, {126, {0.724103, 0.209670, 0.337424}}, {141, {0.807082, 0.262692, 0.278898}},
            {155, {0.873741, 0.326906, 0.216886}}, {169, {0.926470, 0.405389, 0.150292}}, {182, {0.961293, 0.488716, 0.084289}},
            {192, {0.978422, 0.557937, 0.034931}}, {196, {0.982881, 0.586606, 0.024661}}, {200, {0.985952, 0.615750, 0.025592}},
            {204, {0.987622, 0.645320, 0.039886}}, {210, {0.987464, 0.690366, 0.079990}}, {219, {0.981173, 0.759135, 0.156863}},
            {227, {0.969783, 0.820825, 0.238686}}, {234, {0.956834, 0.874129, 0.323974}}, {240, {0.947594, 0.917399, 0.410665}},
            {245, {0.947937, 0.949318, 0.491426}}, {250, {0.961812, 0.975924, 0.571925}}, {255, {0.988362, 0.998364, 0.644924}},
        }},
        {"cool-to-warm", ColorSpace::Diverging, 1.0, {
            {0.0, {0.231373, 0.298039, 0.752941}}, {0.5, {0.865003, 0.865003, 0.865003}}, {1.0, {0.705882, 0.0156863, 0.14902}},
        }},
        {"grayscale", ColorSpace::Rgb, 1.0, {{0.0, {0, 0, 0}}, {1.0, {1, 1, 1}}}},
        {"rainbow", ColorSpace::Rgb, 4.0, {  // HSV from blue to red: exactly these five corners
            {0.0, {0, 0, 1}}, {1.0, {0, 1, 1}}, {2.0, {0, 1, 0}}, {3.0, {1, 1, 0}}, {4.0, {1, 0, 0}},
        }},
        {"black-body", ColorSpace::Rgb, 1.0, {
            {0.0, {0, 0, 0}}, {0.4, {230.0 / 255.0, 0, 0}}, {0.8, {230.0 / 255.0, 230.0 / 255.0, 0}}, {1.0, {1, 1, 1}},
        }},
        {"blue-to-yellow", ColorSpace::Rgb, 1.0, {
            {0.0, {10.0 / 255.0, 10.0 / 255.0, 242.0 / 255.0}}, {1.0, {242.0 / 255.0, 242.0 / 255.0, 10.0 / 255.0}},
        }},
    };
    return all;
}
// clang-format on

/// Low values show through, high ones hide what is behind: across the whole range the optical depth is 8.0, most of it
/// above the middle.
const std::vector<ExtinctionNode> defaultExtinction{{0.0, 0.0}, {0.15, 0.3}, {0.5, 4.0}, {1.0, 25.0}};

}  // namespace

std::vector<std::string> presetNames() {
    std::vector<std::string> names;
    for (const Preset& one : presets()) names.emplace_back(one.name);
    return names;
}

TransferFunction preset(const std::string& name) {
    const auto found =
        std::find_if(presets().begin(), presets().end(), [&](const Preset& one) { return name == one.name; });
    if (found == presets().end()) {
        throw std::runtime_error(fmt::format("there is no transfer function preset \"{}\"; known are {}", name,
                                             fmt::join(presetNames(), ", ")));
    }
    TransferFunction function;
    function.color = sampledInRgb(found->space, found->nodes);
    for (ColorNode& node : function.color) node.scalar /= found->scalarUnit;
    function.extinction = defaultExtinction;
    function.normalized = true;
    function.extinctionPerExtent = true;
    return function;
}

}  // namespace tetralux::preint
