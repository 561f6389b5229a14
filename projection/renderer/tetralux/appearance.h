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

/// What a transfer function is put together of, in the words of ParaView, PyVista and matplotlib.
struct TransferWords {
    /// A name of TransferFunction::colorMaps() in any case, or an alias; "_r" at the end reverses it.
    std::string colorMap = "cool-to-warm";
    /// A name of TransferFunction::opacities(): "linear", "geom", "sigmoid_5", "foreground" …, "_r" at the end reverses
    /// it. Empty, and no `opacities`: an extinction that shows the mesh.
    std::string opacity;
    std::vector<double> opacities;  ///< in its place: α, 0 to 1, at equal distances over the range
    /// The length over which that α counts, mesh units (Mode::ScaleInvariant: units of the scalar): τ = −ln(1 − α)/d,
    /// and α = 1 is τ = 1e4/diagonal. Nothing: 1/50 of the mesh's diagonal (of the scalar's range).
    std::optional<double> unitDistance;
    double opacityScale = 1;  ///< extinction times this
    std::optional<std::array<double, 2>>
        range;              ///< scalars of the first and the last colour; nothing: the field's range
    bool logScale = false;  ///< over the logarithm of the scalar
};

/// Colour and extinction over the scalar, and isosurfaces. Extinction τ counts per unit of length of the mesh
/// (Mode::ScaleInvariant: per unit of the scalar).
class TransferFunction {
public:
    /// JSON: {"color": [[s, r, g, b], …] or "colorMap": name, "extinction": [[s, tau], …] or "opacity": [[s, alpha], …]
    /// or a word, "isosurfaces": [{"value": v, "opacity": a, "color": [r, g, b]}, …], "normalized": true|false,
    /// "range": [low, high], "logScale": true|false, "unitDistance": d, "opacityScale": f}, or a colour map that
    /// ParaView or VisIt exported. \throws Error (BadInput) naming the place.
    static TransferFunction parse(std::string_view json);
    static TransferFunction load(const std::filesystem::path& file);  ///< \throws Error naming the file
    /// \throws Error (BadInput) for names that there are not, naming those nearest, and numbers that none can have.
    static TransferFunction ofWords(const TransferWords& words);
    /// The colours of that name, with an extinction that shows the mesh. \throws Error naming those nearest.
    static TransferFunction preset(std::string_view name);

    /// This function with extinction times `factor`, and isosurfaces' opacity, up to 1.
    TransferFunction scaled(double factor) const;
    /// This function stretched over these scalars, whatever the field's range.
    TransferFunction stretched(double low, double high) const;

    static std::vector<std::string> presets();    ///< the names that are asked for most
    static std::vector<std::string> colorMaps();  ///< all of matplotlib's and ParaView's
    static std::vector<std::string> opacities();  ///< words for opacity

    struct Data;  ///< the library's own
    /// The library's own.
    explicit TransferFunction(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
    const Data& data() const { return *data_; }  ///< the library's own

private:
    std::shared_ptr<const Data> data_;
};

/// What a picture shows of the scalars along a ray.
enum class Mode {
    Standard,                ///< opacity per length
    ScaleInvariant,          ///< opacity per change of the scalar (Kraus 2005)
    Mip,                     ///< colour of the largest scalar
    Minimum,                 ///< of the smallest
    Average,                 ///< of the length-weighted mean of the scalar
    Additive,                ///< light of all segments, hidden by nothing; alpha min(1, ∫ τ dt)
    AdditiveScaleInvariant,  ///< likewise, per change of the scalar
    Emission,                ///< likewise with alpha 0 (Max 1995)
    Absorption,              ///< black, alpha 1 − exp(−∫ τ dt): a radiograph over its background (Max 1995)
    FirstHit,                ///< colour of the first segment with opacity, opaque
    Depth                    ///< grey: distance to where anything first shows
};

/// What becomes of thin layers that are seen edge-on: they become denser, or not.
enum class Silhouettes {
    None,        ///< no denser than elsewhere
    Exact,       ///< Kraus 2005, Equations 15 and 17
    Approximate  ///< Equation 16
};

/// A light without a place, at a place, or at the eye. At the distance d (mesh units) there is left of it
/// color/(attenuation[0] + attenuation[1]·d + attenuation[2]·d²); Directional lights do not fade.
struct Light {
    /// Where it is.
    enum class Kind {
        Directional,  ///< infinitely far away
        Point,        ///< at `position`
        Head          ///< at the eye (orthographic: behind every pixel)
    };
    Kind kind = Kind::Directional;  ///< which of the members below count
    Vector direction{0, 0, 1};      ///< Directional: towards the light, any length
    Vector position{};              ///< Point: mesh units
    Vector color{1, 1, 1};          ///< times intensity
    Vector attenuation{1, 0, 0};    ///< constant, per mesh unit, per mesh unit squared
};

/// Kraus 2005, Equation 19: one term per light. Without lights colours are emitted as they are.
struct Lighting {
    std::vector<Light> lights;   ///< none: colours as they are
    double ambient = 0.1;        ///< intensity of ambient light
    double exponent = 32.0;      ///< of the highlight
    bool transmission = true;    ///< light that comes through
    bool smoothNormals = false;  ///< gradients fitted at the vertices instead of each cell's own
    bool shadows = false;        ///< volume and surfaces cast shadows
};

/// A plane through a point, in mesh units.
struct Plane {
    Vector point{};          ///< on the plane
    Vector normal{0, 0, 1};  ///< any length
};

/// Shows only the side towards which the normal points.
using Cut = Plane;

/// The mesh on a plane, in the colours of the scalar.
struct Slice {
    Plane plane;           ///< its normal may point either way
    double opacity = 1.0;  ///< 0 … 1; below 1 what lies behind shows through
};

/// Triangles in the volume, in one colour or in those of their scalars; lit by the renderer's lights unless `flat`.
struct Surface {
    std::vector<Vector> points;                           ///< mesh units
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< three numbers of points each
    Vector color{0.8, 0.8, 0.8};                          ///< display RGB
    bool flat = false;                                    ///< in that colour, without light
    std::vector<double> scalars{};                        ///< one for each point: coloured by the transfer function
    double opacity = 1.0;                                 ///< below 1 what lies behind shows too
};

/// The mesh's outer faces, and what cuts lay open, as a surface.
struct Boundary {
    double opacity = 1.0;             ///< below 1 the volume within shows too
    std::optional<Vector> color{};    ///< not given: the transfer function's of the field
    bool flat = false;                ///< without light
    double featureAngle = 30.0;       ///< degrees: edges that are bent by less look round
    bool edges = false;               ///< lines along the edges of its triangles
    double edgeWidth = 1.0;           ///< pixels
    Vector edgeColor{0.1, 0.1, 0.1};  ///< display RGB
};

}  // namespace tetralux
