// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace tetralux::shading {

/// A light. Colours are display values times intensity; what reaches a point at distance d (mesh units) is
/// color/(attenuation.x + attenuation.y·d + attenuation.z·d²).
struct Light {
    enum class Kind {
        Directional,  ///< infinitely far away: no distance, no attenuation
        Point,
        Head  ///< at the eye; of orthographic views, behind every pixel
    };
    glm::dvec3 towards{0, 0, 1};  ///< directional: unit vector towards the light, world space
    Kind kind = Kind::Directional;
    glm::dvec3 color{1};
    glm::dvec3 position{0};           ///< point: mesh units
    glm::dvec3 attenuation{1, 0, 0};  ///< constant, per mesh unit, per mesh unit squared
};

/// How the highlight f_s is formed (H: half-way vector; U, V: along and across a fibre of the field). Ward's and
/// Lafortune's, and any beside a phase function (Material::phaseAsymmetry), count times the cosine (l·n)₊ with n
/// turned to the eye (Ament & Dachsbacher 2015, Equation 4), and take the place of specular transmission; Phong's and
/// Blinn and Phong's are otherwise the third term of Kraus's Equation 19, whose fifth is the same for both.
enum class Reflectance {
    Phong,       ///< about 2n(n·l) − l
    BlinnPhong,  ///< (n·H)^exponent
    Ward,  ///< roughness u = κ(λ₂/λ₁)^γ along U and v = κ along V, normalized; u ≤ max(κ, 10), 1/√((n·l)(n·v)) ≤ 100
    Lafortune,  ///< (u·l_U·v_U − l_V·v_V + l_n·v_n)₊^exponent, u = 2(1 − exp(γ(1 − λ₂/λ₁))) − 1
    None        ///< no highlights and no specular transmission
};

/// Whose normal is lit, and whose direction silhouettes follow; the side of a segment is that of the cell's gradient in
/// any case.
enum class Normals {
    Cell,   ///< that of the cell's gradient
    Smooth  ///< gradients fitted at the vertices (least squares), interpolated to the segment's middle
};

/// Of one side of a two-sided material. The front is the side of larger scalars, that which n points to.
struct MaterialSide {
    glm::dvec3 specular{1};          ///< C_spec, of reflection alone
    std::optional<double> exponent;  ///< nothing: ShadingSettings::exponent
};

/// k_s = |∇τ| in the place of Material::specular (Ament & Dachsbacher 2015, Equation 6), and times
/// specularTransmission: only what looks like a surface shines. ∇τ is fitted at the vertices; isosurfaces have no part
/// in it.
enum class GradientSpecular {
    Off,
    Relative,  ///< over its largest; 1 where extinction is the same everywhere
    Absolute   ///< extinction per mesh unit
};

struct Material {
    double diffuse = 1, specular = 1;                          ///< factors of reflection
    double diffuseTransmission = 1, specularTransmission = 1;  ///< factors of transmission
    MaterialSide front, back;                                  ///< transmission takes their mean exponent
    /// Henyey–Greenstein's g, −1 … 1: 4π times that phase function takes the place of diffuse reflection and
    /// transmission, also where there is no gradient. Nothing: Equation 19's diffuse light.
    std::optional<double> phaseAsymmetry;
    GradientSpecular specularByGradient = GradientSpecular::Off;
};

/// Anisotropy of the field's level sets about each vertex (shading/anisotropy.h), and what lobes make of it.
struct AnisotropySettings {
    double radius = 4.0;     ///< of the neighbourhood, in mean edge lengths of the mesh
    double interval = 0.05;  ///< half-width in scalar, as a share of the field's range
    int samples = 4;         ///< points that stand for one cell
    int smoothing = 0;       ///< how often tensors are averaged with those of neighbouring vertices
    /// κ: roughness of an isotropic Ward lobe, and across fibres of any; exponent of Lafortune's. Nothing: 0.2, and the
    /// exponent of the material's side.
    std::optional<double> kappa;
    double gamma = 10.0;  ///< γ: how strongly anisotropy counts; 0: not at all
};

struct ShadowSettings {
    bool on = false;
    double softness = 0.0;  ///< radius of an area light: point lights in mesh units, directional as a slope; 0: hard
};

/// Colours go over into this one with the distance from the eye (after the depth-based colouring of Marchesin, Dischler
/// & Mongenet, Volume Graphics 2007, which keeps near and far apart where opacity no longer does): c ← (1 − w)·c +
/// w·color, w = strength·(share of the way from the near to the far end of the mesh's bounding sphere), after light.
struct DepthColor {
    glm::dvec3 color{0.35, 0.45, 0.75};
    double strength = 1.0;  ///< 0 … 1: w at the far end
};

struct ShadingSettings {
    bool silhouette = false;             ///< Kraus 2005, Equations 15 and 17
    bool approximateSilhouette = false;  ///< α' = min(1, α·k), Equation 16, where there are silhouettes
    /// Levoy's scaling by the gradient's magnitude, which Kraus 2005, Eq. 18 relates to silhouettes: the depth of a
    /// segment is multiplied by this times |g|, g in ranges of the scalar per diagonal of the mesh. 0: off.
    double gradientOpacity = 0.0;
    std::vector<Light> lights;   ///< none: colours are emitted as they are
    double ambient = 0.1;        ///< intensity of ambient light, used when there are lights
    glm::dvec3 ambientColor{1};  ///< times `ambient`
    double exponent = 32.0;      ///< of the specular lobes, where a material's side has none of its own
    bool transmission = true;    ///< diffuse and specular light through the cell
    Reflectance reflectance = Reflectance::Phong;
    Normals normals = Normals::Cell;
    Material material;
    AnisotropySettings anisotropy;
    ShadowSettings shadows;
    std::optional<DepthColor> depthColor;

    bool lit() const { return !lights.empty(); }
    double wardRoughness() const { return anisotropy.kappa.value_or(0.2); }  ///< κ
    /// Of a side's highlight.
    double exponentOf(const MaterialSide& side) const {
        const double own = side.exponent.value_or(exponent);
        return reflectance == Reflectance::Lafortune ? anisotropy.kappa.value_or(own) : own;
    }
    /// Whether segments are shaded one by one.
    bool needsGradient() const { return silhouette || gradientOpacity > 0 || lit() || depthColor.has_value(); }
    bool needsAnisotropy() const {
        return lit() && (reflectance == Reflectance::Ward || reflectance == Reflectance::Lafortune);
    }
    /// Silhouettes follow the smoothed gradient: k = |ḡ|/|ḡ·d|; 1 where ḡ = 0.
    bool smoothSilhouettes() const { return silhouette && normals == Normals::Smooth; }
    bool needsSmoothNormals() const { return normals == Normals::Smooth && (lit() || silhouette); }
    bool needsShadows() const;  ///< a light that is not at the eye, and shadows on

    /// Whether lights and material are those of shading/cell_shading.glsl's lightTerm: directional, intensity 1, the
    /// cell's normal, C_spec = 1, Phong. Engines have a faster way for it.
    bool plain() const;
};

}  // namespace tetralux::shading
