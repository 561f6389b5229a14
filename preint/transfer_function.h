// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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

/// A Dirac peak: crossing `value` multiplies the transparency by 1 − opacity and adds opacity·color.
struct Isosurface {
    double value;
    double opacity;  ///< α₀ in [0, 1]
    glm::dvec3 color;
};

/// Colour and extinction, piecewise linear in the scalar and constant beyond the first and last node. Nodes are
/// sorted by scalar; the same scalar twice is a jump (the first node holds from below, the second from above).
struct TransferFunction {
    std::vector<ColorNode> color;            ///< at least one
    std::vector<ExtinctionNode> extinction;  ///< at least one, unless there are isosurfaces only (then τ = 0)
    std::vector<Isosurface> isosurfaces;     ///< sorted by value
    bool normalized = false;                 ///< scalars are fractions of the field's range
    /// Extinction is per extent of what is drawn (bounding-box diagonal, or scalar range in the scale-invariant
    /// integral), so that presets look the same in any units.
    bool extinctionPerExtent = false;

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
TransferFunction preset(const std::string& name);

/// In absolute units: fractions become scalars of [scalarMin, scalarMax]; extinction per extent becomes extinction
/// per unit by division by `extent` (mesh diagonal for the standard integral, scalar range for the scale-invariant).
TransferFunction resolved(const TransferFunction& function, double scalarMin, double scalarMax, double extent);

/// Stretched over the scalars from `low` to `high`: a normalized function has its fractions count from there, any other
/// its first and last node moved to them, the rest in proportion; low = high: a step just above. Per unit extinction
/// stays, per extent it is divided by `extent`. \throws std::runtime_error when the function has no width to stretch.
TransferFunction windowed(const TransferFunction& function, double low, double high, double extent);

}  // namespace tetralux::preint
