// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tetralux::preint {

struct ColorNode {
    double scalar;
    glm::dvec3 color;  ///< display RGB in [0, 1], not multiplied by opacity
};

struct ExtinctionNode {
    double scalar;
    double extinction;  ///< τ ≥ 0: per mesh length (standard) or per scalar unit (scale-invariant)
};

/// Opacity of a piece of unit length that has this scalar throughout.
struct OpacityNode {
    double scalar;
    double opacity;  ///< α in [0, 1]
};

/// An isosurface, a Dirac peak of extinction: crossing `value` multiplies the transparency by 1 − opacity and adds
/// opacity·color.
struct Isosurface {
    double value;
    double opacity;  ///< α₀ in [0, 1]
    glm::dvec3 color;
};

/// Colour and extinction, piecewise linear in the scalar and constant beyond the first and last node. Nodes are
/// sorted by scalar; the same scalar twice is a jump (the first node holds from below, the second from above).
///
/// What comes below `isosurfaces` says how such a function is fitted to a field and a mesh; in an absolute one, which
/// resolved() makes and engines take, all of it is as it stands here.
struct TransferFunction {
    std::vector<ColorNode> color;            ///< at least one
    std::vector<ExtinctionNode> extinction;  ///< at least one, unless there are isosurfaces only (then τ = 0)
    std::vector<Isosurface> isosurfaces;     ///< sorted by value

    bool normalized = false;   ///< scalars are fractions of the field's range, or of `range`
    bool logarithmic = false;  ///< of a normalized one: fractions of the logarithm's range
    /// Scalars over which it is stretched, from and to; nothing: the field's range, and one that is not normalized
    /// stays.
    std::optional<glm::dvec2> range{};
    /// Extinction is per extent of what is drawn (bounding-box diagonal, or scalar range in the scale-invariant
    /// integral), so that presets look the same in any units.
    bool extinctionPerExtent = false;
    /// Extinction, per extent, is a proposal: it may be raised until a mesh shows that is thin or mostly of low values.
    bool extinctionSuggested = false;
    /// In place of extinction: τ = −ln(1 − α)/unitDistance, and where α = 1 1e4 per diagonal of the mesh (or per range
    /// of the scalar). Linear in α between nodes, to within 1/1024.
    std::vector<OpacityNode> opacity{};
    /// Mesh units (or of the scalar); nothing: 1/50 of the diagonal (or the range).
    std::optional<double> unitDistance{};
    double opacityScale = 1.0;             ///< extinction, and the opacity of isosurfaces up to 1, times this
    std::vector<glm::dvec3> categories{};  ///< in place of `color`: one for each value (categorical_colors.h)

    glm::dvec3 colorAt(double scalar) const;  ///< at a jump: the value from above
    double extinctionAt(double scalar) const;
};

/// Reads the JSON of a transfer function, a colour map that ParaView exported or the XML of one (ParaView's, VisIt's).
/// \throws std::runtime_error naming file, place and remedy.
TransferFunction readTransferFunction(const std::string& path);

/// The same from text; `origin` names it in messages.
TransferFunction parseTransferFunction(const std::string& json, const std::string& origin);

/// viridis, inferno, plasma, magma, cividis, turbo, cool-to-warm, grayscale, rainbow, black-body, blue-to-yellow.
std::vector<std::string> presetNames();
/// The colours of any map in color_maps.h with the extinction that is suggested where nothing is said.
TransferFunction preset(const std::string& name);
/// That extinction, per extent: something everywhere, so that the whole mesh shows.
std::vector<ExtinctionNode> suggestedExtinction();

/// What a function is fitted to.
struct FitTo {
    double scalarMin = 0.0, scalarMax = 1.0;  ///< of the field
    double extent = 1.0;                      ///< what extinction per extent is divided by
    double diagonal = 0.0;  ///< of the mesh (the scalar's range in the scale-invariant integral); 0: the extent
    std::vector<double> values =
        {};  ///< that the field has, ascending, where they are few: categorical colours ask for them
};

/// In absolute units. Fractions become scalars of the field's range or of function.range; a function that is not
/// normalized and has a range has its first and last node moved to its ends, the rest in proportion; a range without
/// width is a step just above it. Extinction per extent is divided by the extent, opacity becomes extinction. \throws
/// std::runtime_error for a logarithm of what is not above 0, and when a function that must be stretched has no width.
TransferFunction resolved(const TransferFunction& function, const FitTo& to);
TransferFunction resolved(const TransferFunction& function, double scalarMin, double scalarMax, double extent);

/// resolved() with function.range from `low` to `high`.
TransferFunction windowed(const TransferFunction& function, double low, double high, double extent);

}  // namespace tetralux::preint
