// SPDX-License-Identifier: Apache-2.0
/// \file
/// How it is drawn: transfer function, mode, light, cuts. Definitions are those of the manual's page on modes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tetralux {

using Vector = std::array<double, 3>;  ///< x, y, z in mesh units, or red, green, blue in [0, 1] as displays take them

/// Colour and extinction over the scalar, and isosurfaces. Extinction τ counts per unit of length of the mesh
/// (Mode::ScaleInvariant: per unit of the scalar).
class TransferFunction {
public:
    /// JSON: {"color": [[s, r, g, b], …], "extinction": [[s, tau], …], "isosurfaces": [{"value": v, "opacity": a,
    /// "color": [r, g, b]}, …], "normalized": true|false}, or a colour map that ParaView exported. \throws Error
    /// (BadInput) naming the place.
    static TransferFunction parse(std::string_view json);
    static TransferFunction load(const std::filesystem::path& file);  ///< \throws Error naming the file
    /// viridis, cool-to-warm, … (presets() lists them). \throws Error listing the names that there are.
    static TransferFunction preset(std::string_view name);
    static std::vector<std::string> presets();

    struct Data;  ///< the library's own
    explicit TransferFunction(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
    const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_;
};

enum class Mode {
    Standard,        ///< opacity per length
    ScaleInvariant,  ///< opacity per change of the scalar (Kraus 2005)
    Mip,             ///< largest scalar along the ray
    Minimum,
    Average,  ///< length-weighted mean of the scalar
    Additive,
    AdditiveScaleInvariant,
    Emission,
    Absorption,
    FirstHit,
    Depth
};

enum class Silhouettes {
    None,
    Exact,       ///< Kraus 2005, Equations 15 and 17
    Approximate  ///< Equation 16
};

struct Light {
    enum class Kind { Directional, Point, Head } kind = Kind::Directional;
    Vector direction{0, 0, 1};    ///< Directional: towards the light, any length
    Vector position{};            ///< Point: mesh units
    Vector color{1, 1, 1};        ///< times intensity
    Vector attenuation{1, 0, 0};  ///< constant, per mesh unit, per mesh unit squared
};

/// Kraus 2005, Equation 19: one term per light. Without lights colours are emitted as they are.
struct Lighting {
    std::vector<Light> lights;
    double ambient = 0.1;
    double exponent = 32.0;      ///< of the highlight
    bool transmission = true;    ///< light that comes through
    bool smoothNormals = false;  ///< gradients fitted at the vertices instead of each cell's own
    bool shadows = false;
};

struct Plane {
    Vector point{}, normal{0, 0, 1};
};

/// Shows only the side towards which the normal points.
using Cut = Plane;

struct Slice {
    Plane plane;
    double opacity = 1.0;
};

/// Opaque triangles in the volume, in one colour; lit by the renderer's lights unless `flat`.
struct Surface {
    std::vector<Vector> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Vector color{0.8, 0.8, 0.8};
    bool flat = false;
};

}  // namespace tetralux
