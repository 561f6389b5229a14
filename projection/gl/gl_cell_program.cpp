// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_cell_program.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include <projection/core/transfer_support.h>
#include <projection/gl/gl_compute.h>
#include <projection/gl/gl_tiles.h>

namespace tetralux::projection {
namespace {

// Optical depth that stands for an opaque isosurface: exp(−1e4) is 0 in float, and a finite number can be scaled.
constexpr double opaqueDepth = 1e4;

int shaderMode(Mode mode) {
    switch (mode) {
        case Mode::Standard:
        case Mode::ScaleInvariant:
            return 0;
        case Mode::Mip:
            return 1;
        case Mode::Average:
            return 2;
        case Mode::FirstHit:
            return 3;
        case Mode::Minimum:
            return 4;
        case Mode::Additive:
        case Mode::DataAdditive:
        case Mode::Emission:
            return 5;
        case Mode::Absorption:
            return 6;
        case Mode::Depth:
            return 7;
        case Mode::Contributions:
            break;  // engines draw the sums that it shows
    }
    return 0;
}

// What tableZone[] holds (preint/table_lookup.glsl).
glm::dvec2 shaderZone(const glm::dvec2& range) {
    return {range.x, range.y > range.x ? 1.0 / (range.y - range.x) : 0.0};
}

// "vec2(…), vec2(…)": the elements of a constant array. Constants beat uniforms by far on llvmpipe, which checks the
// bounds of every load.
template <class Vector>
std::string vectorLiterals(const std::vector<Vector>& vectors) {
    std::string text;
    for (const Vector& vector : vectors) {
        text += fmt::format("{}vec{}(", text.empty() ? "" : ", ", vector.length());
        for (int i = 0; i < vector.length(); ++i) text += fmt::format("{}{:.9e}", i > 0 ? ", " : "", vector[i]);
        text += ")";
    }
    return text;
}

GlDefines variant(const RenderSettings& settings, const shading::VertexLight& vertexLight, std::size_t supports,
                  const preint::PreintegrationTable* table, const WalkedPieces* walked, GlFrameKind kind,
                  bool linearSampler) {
    const auto& shading = settings.shading;
    const bool looksUp = table != nullptr;
    const bool dataSpace = integralOf(settings.mode) == preint::Integral::ScaleInvariant;
    const bool scaleInvariant = dataSpace && (!looksUp || table->integral == preint::Integral::ScaleInvariant);
    const bool shades = looksUp && settings.mode != Mode::Depth;
    const bool silhouette = shades && shading.silhouette, levoy = shades && shading.gradientOpacity > 0;
    const bool length = settings.mode == Mode::Average || (looksUp && (!dataSpace || silhouette));
    const int lights = shades ? static_cast<int>(shading.lights.size()) : 0;
    GlDefines defines;
    defines.set("TETRALUX_ORTHOGRAPHIC", kind.orthographic);
    defines.set("TETRALUX_LIMITS", kind.clipped);
    defines.set("TETRALUX_TILES", kind.tiles);
    defines.set("TETRALUX_MODE", shaderMode(settings.mode));
    defines.set("TETRALUX_SCALE_INVARIANT", scaleInvariant);
    defines.set("TETRALUX_DATA_SPACE", dataSpace);
    const bool asksSupport = settings.mode == Mode::FirstHit || settings.mode == Mode::Depth;
    defines.set("TETRALUX_SUPPORTS", asksSupport ? static_cast<int>(supports) : 0);
    defines.set("TETRALUX_SILHOUETTE", silhouette);
    defines.set("TETRALUX_APPROXIMATE_SILHOUETTE", silhouette && shading.approximateSilhouette);
    defines.set("TETRALUX_GRADIENT_OPACITY", levoy);
    defines.set("TETRALUX_SAMPLED", shades && settings.classification != Classification::Preintegrated);
    defines.set("TETRALUX_PER_CELL", shades && settings.contributions.perCell);
    defines.set("TETRALUX_LINEAR_OPACITY", shades && settings.classification == Classification::PostLinear);
    defines.set("TETRALUX_LIGHTS", lights);
    defines.set("TETRALUX_CUT_LAYERS", kind.clipped && lights > 0 && settings.mode != Mode::Absorption);
    defines.set("TETRALUX_DEPTH_COLOR", shades && shading.depthColor.has_value());
    defines.set("TETRALUX_GRADIENT", shades && shading.needsGradient());
    const bool full = lights > 0 && !shading.plain();
    defines.set("TETRALUX_FULL_LIGHT", full);
    const bool sampled = shades && settings.classification == Classification::Pre && vertexLight.sampleAt >= 0;
    const bool smoothSilhouette = silhouette && shading.smoothSilhouettes();
    defines.set("TETRALUX_SMOOTH_SILHOUETTE", smoothSilhouette);
    defines.set("TETRALUX_ATTRIBUTES", full || sampled || smoothSilhouette ? vertexLight.stride / 4 : 0);
    defines.set("TETRALUX_SURFACE_SHADOWS", full && vertexLight.shadowAt >= 0 && !vertexLight.corners.empty());
    defines.set("TETRALUX_SAMPLE_AT", sampled ? vertexLight.sampleAt : -1);
    defines.set("TETRALUX_SPECULAR_AT", vertexLight.specularAt);
    defines.set("TETRALUX_NORMAL_AT", vertexLight.normalAt);
    defines.set("TETRALUX_TENSOR_AT", vertexLight.tensorAt);
    defines.set("TETRALUX_SHADOW_AT", vertexLight.shadowAt);
    defines.set("TETRALUX_REFLECTANCE", static_cast<int>(shading.reflectance));
    defines.set("TETRALUX_PHASE", shading.material.phaseAsymmetry.has_value());
    defines.set("TETRALUX_LENGTH", length);
    if (!looksUp) return defines;
    const glm::dvec2 zone = shaderZone(table->zones.front());
    defines.set("TETRALUX_DISCONTINUITIES", static_cast<int>(table->discontinuities.size()));
    defines.set("TETRALUX_ZONES", static_cast<int>(table->zones.size()));
    defines.set("TETRALUX_ZONE_LOW", zone.x);
    defines.set("TETRALUX_ZONE_PER_SCALAR", zone.y);
    defines.set("TETRALUX_WARPS", table->warped ? static_cast<int>(table->warp.size()) : 0);
    defines.set("TETRALUX_WARP_VALUES", vectorLiterals(table->warp));
    defines.set("TETRALUX_RAMPS", static_cast<int>(table->ramps.size()));
    defines.set("TETRALUX_RAMP_VALUES", vectorLiterals(table->ramps));
    defines.set("TETRALUX_TABLE_SIZE", static_cast<double>(table->size));
    defines.set("TETRALUX_TABLE_SLICES", static_cast<double>(table->slices));
    defines.set("TETRALUX_TABLE_LENGTH_MAX", table->lengthMax);
    defines.set("TETRALUX_TABLE_LENGTH_SCALE", table->lengthScale);
    defines.set("TETRALUX_LINEAR_SAMPLER", linearSampler);
    if (walked != nullptr) defines.set("TETRALUX_WALK", walked->count());
    return defines;
}

std::vector<std::string_view> pixelFiles(bool looksUp, bool walks) {
    std::vector<std::string_view> files{"preint/glsl_prelude.glsl",
                                        "preint/value_from_above.glsl",
                                        "projection/gl/gl_precision.glsl",
                                        "projection/gl/gl_variants.glsl",
                                        "projection/cells/cell_interval.glsl",
                                        "projection/gl/gl_cell_record.glsl",
                                        "projection/gl/gl_cell_depth.glsl",
                                        "shading/light_model.glsl",
                                        "projection/gl/gl_light.glsl"};
    if (looksUp) {
        if (walks)
            files.emplace_back("projection/gl/gl_walk.glsl");
        else
            files.insert(files.end(), {"projection/gl/gl_table.glsl", "preint/table_lookup.glsl"});
        files.insert(files.end(),
                     {"preint/gather_segment.glsl", "shading/cell_shading.glsl", "shading/silhouette.glsl",
                      "shading/surface_shadow.glsl", "projection/gl/gl_modes.glsl", "projection/gl/gl_segment.glsl"});
    }
    files.emplace_back("projection/gl/gl_cell_pixel.glsl");
    return files;
}

std::vector<GlShaderSource> shaders(bool looksUp, bool walks, bool tiles) {
    std::vector<std::string_view> files = pixelFiles(looksUp, walks);
    if (tiles) {
        files.insert(files.begin(), "projection/gl/gl_compute.glsl");
        files.insert(files.end(), {"projection/gl/gl_tile_outline.glsl", "projection/gl/gl_tile_draw.comp"});
        return {{GL_COMPUTE_SHADER, files}};
    }
    files.emplace_back("projection/gl/gl_cell.frag");
    return {{GL_VERTEX_SHADER, {"projection/gl/gl_cell.vert"}}, {GL_FRAGMENT_SHADER, files}};
}

GlDefines withTileConstants(GlDefines defines, bool tiles) {
    if (!tiles) return defines;
    defines.set("TETRALUX_TILE_SIZE", glTileSize);
    return computeDefines(std::move(defines));
}

void setVector(const GlFunctions& gl, GLint location, const glm::dvec3& value) {
    gl.Uniform3f(location, static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z));
}

}  // namespace

bool modeLooksUp(Mode mode) {
    return mode != Mode::Mip && mode != Mode::Minimum && mode != Mode::Average;
}

GlTableTexture::GlTableTexture(const GlFunctions& gl, const preint::PreintegrationTable& table)
    : gl_(gl), target_(table.integral == preint::Integral::ScaleInvariant ? GL_TEXTURE_2D : GL_TEXTURE_3D) {
    make(table.size, static_cast<GLsizei>(table.zones.size()) * table.size, table.slices, table.texels);
}

GlTableTexture::GlTableTexture(const GlFunctions& gl, const WalkedPieces& pieces) : gl_(gl), target_(GL_TEXTURE_2D) {
    make(pieces.count(), 3, 1, pieces.texels);
}

void GlTableTexture::make(GLsizei columns, GLsizei rows, GLsizei slices, const std::vector<glm::vec4>& texels) {
    GLint largest = 0;
    gl_.GetIntegerv(target_ == GL_TEXTURE_2D ? GL_MAX_TEXTURE_SIZE : GL_MAX_3D_TEXTURE_SIZE, &largest);
    if (std::max({columns, rows, slices}) > largest) {
        throw std::runtime_error(
            fmt::format("pre-integration table of {} x {} x {} texels: this OpenGL renderer takes {} along an "
                        "axis; allow a larger table error",
                        columns, rows, slices, largest));
    }
    gl_.GenTextures(1, &texture_);
    gl_.BindTexture(target_, texture_);
    if (target_ == GL_TEXTURE_2D) {
        gl_.TexStorage2D(target_, 1, GL_RGBA32F, columns, rows);
        gl_.TexSubImage2D(target_, 0, 0, 0, columns, rows, GL_RGBA, GL_FLOAT, texels.data());
    } else {
        gl_.TexStorage3D(target_, 1, GL_RGBA32F, columns, rows, slices);
        gl_.TexSubImage3D(target_, 0, 0, 0, 0, columns, rows, slices, GL_RGBA, GL_FLOAT, texels.data());
    }
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        gl_.TexParameteri(target_, axis, GL_CLAMP_TO_EDGE);
    }
    gl_.TexParameteri(target_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(target_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    checkGl(gl_, "table texture");
}

void GlTableTexture::bind(GLuint unit) const {
    gl_.ActiveTexture(GL_TEXTURE0 + unit);
    gl_.BindTexture(target_, texture_);
}

GlVertexLight::GlVertexLight(const GlFunctions& gl, const shading::VertexLight& light) : gl_(gl) {
    GLint largest = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
    const std::size_t texels = light.values.size() / 4;
    if (texels > static_cast<std::size_t>(largest))
        throw std::runtime_error(fmt::format(
            "light at vertices of {} texels: this OpenGL renderer takes {}; use --engine cpu", texels, largest));
    gl_.GenBuffers(1, &buffer_);
    gl_.BindBuffer(GL_TEXTURE_BUFFER, buffer_);
    gl_.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(light.values.size() * sizeof(float)), light.values.data(),
                   GL_STATIC_DRAW);
    gl_.GenTextures(1, &texture_);
    gl_.BindTexture(GL_TEXTURE_BUFFER, texture_);
    gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_);
    checkGl(gl_, "light at vertices");
}

GlVertexLight::~GlVertexLight() {
    gl_.DeleteTextures(1, &texture_);
    gl_.DeleteBuffers(1, &buffer_);
}

void GlVertexLight::bind(GLuint unit) const {
    gl_.ActiveTexture(GL_TEXTURE0 + unit);
    gl_.BindTexture(GL_TEXTURE_BUFFER, texture_);
}

GlCellProgram::GlCellProgram(const GlFunctions& gl, const RenderSettings& settings,
                             const shading::VertexLight& vertexLight, const preint::TransferFunction& function,
                             const preint::PreintegrationTable* table, const WalkedPieces* walked, GlFrameKind kind,
                             bool linearSampler)
    : gl_(gl),
      program_(gl,
               withTileConstants(variant(settings, vertexLight, extinctionSupport(function).size(), table, walked, kind,
                                         linearSampler),
                                 kind.tiles),
               shaders(table != nullptr, walked != nullptr, kind.tiles)),
      ndcPerPixel_(program_.uniform("ndcPerPixel")),
      centre_(program_.uniform("centre")),
      viewForward_(program_.uniform("viewForward")),
      viewRight_(program_.uniform("viewRight")),
      viewDown_(program_.uniform("viewDown")),
      rowShape_(program_.uniform("rowShape")),
      depthReference_(program_.uniform("depthReference")),
      depthOrigin_(program_.uniform("depthOrigin")),
      lightPlace_(program_.uniform("lightPlace")),
      lightFade_(program_.uniform("lightFade")) {
    program_.use();
    setConstants(settings, extinctionSupport(function), table, walked);
    checkGl(gl_, "shader constants");
}

void GlCellProgram::setConstants(const RenderSettings& settings, const std::vector<ShownScalars>& support,
                                 const preint::PreintegrationTable* table, const WalkedPieces* walked) const {
    std::vector<glm::vec3> supportFloats;
    for (const ShownScalars& shown : support)
        supportFloats.emplace_back(
            glm::clamp(glm::dvec3(shown.low, shown.high, shown.lowShows ? 1.0 : 0.0), -3e38, 3e38));
    gl_.Uniform3fv(program_.uniform("support"), static_cast<GLsizei>(supportFloats.size()),
                   reinterpret_cast<const float*>(supportFloats.data()));
    const auto& shading = settings.shading;
    std::vector<glm::vec3> lights;
    for (const auto& light : shading.lights) lights.emplace_back(glm::normalize(light.towards));
    gl_.Uniform3fv(program_.uniform("lights"), static_cast<GLsizei>(lights.size()),
                   reinterpret_cast<const float*>(lights.data()));
    gl_.Uniform1f(program_.uniform("ambient"), static_cast<float>(shading.ambient));
    gl_.Uniform1f(program_.uniform("exponent"), static_cast<float>(shading.exponent));
    gl_.Uniform1f(program_.uniform("transmission"), shading.transmission ? 1.0f : 0.0f);
    if (const auto& by = shading.depthColor)
        gl_.Uniform4f(program_.uniform("depthColor"), static_cast<float>(by->color.x), static_cast<float>(by->color.y),
                      static_cast<float>(by->color.z), static_cast<float>(by->strength));
    setLightModel(shading);
    gl_.Uniform1f(program_.uniform("gradientOpacity"), static_cast<float>(shading.gradientOpacity));
    gl_.Uniform1i(program_.uniform("limits"), static_cast<GLint>(limitsUnit));
    gl_.Uniform1i(program_.uniform("cutNormals"), static_cast<GLint>(limitsUnit) + 1);
    if (table == nullptr) return;

    gl_.Uniform1i(program_.uniform("tableTexels"), 0);
    std::vector<glm::vec2> zones;
    for (const glm::dvec2& range : table->zones) zones.emplace_back(shaderZone(range));
    gl_.Uniform2fv(program_.uniform("tableZone"), static_cast<GLsizei>(zones.size()),
                   reinterpret_cast<const float*>(zones.data()));
    std::vector<float> values;
    std::vector<glm::vec4> layers;
    std::vector<GLint> zoneAfter{table->discontinuities.empty() ? 0 : table->discontinuities.front().zoneBelow};
    for (const preint::Discontinuity& entry : table->discontinuities) {
        values.push_back(static_cast<float>(entry.value));
        layers.emplace_back(glm::vec3(entry.color),
                            static_cast<float>(std::min(-std::log1p(-entry.opacity), opaqueDepth)));
        zoneAfter.push_back(entry.zoneAbove);
    }
    const auto count = static_cast<GLsizei>(values.size());
    gl_.Uniform1fv(program_.uniform("discontinuityValue"), count, values.data());
    gl_.Uniform4fv(program_.uniform("discontinuityLayer"), count, reinterpret_cast<const float*>(layers.data()));
    gl_.Uniform1iv(program_.uniform("zoneAfter"), count + 1, zoneAfter.data());
    if (walked != nullptr)
        gl_.Uniform1iv(program_.uniform("zonePiece"), static_cast<GLsizei>(walked->zonePiece.size()),
                       walked->zonePiece.data());
}

void GlCellProgram::setLightModel(const shading::ShadingSettings& shading) const {
    const LightModelFloats model = lightModelFloats(shading);
    const glm::vec3 specular[2] = {model.frontSpecular, model.backSpecular};
    gl_.Uniform3fv(program_.uniform("specularOf"), 2, &specular[0].x);
    gl_.Uniform2f(program_.uniform("exponentOf"), model.frontExponent, model.backExponent);
    gl_.Uniform4f(program_.uniform("diffuseAndSpecular"), model.diffuse, model.specular, model.diffuseThrough,
                  model.specularThrough);
    gl_.Uniform3f(program_.uniform("kappaGammaAsymmetry"), model.kappa, model.gamma, model.asymmetry);
    gl_.Uniform3f(program_.uniform("ambientColor"), model.ambient.x, model.ambient.y, model.ambient.z);
    gl_.Uniform1i(program_.uniform("vertexLight"), static_cast<GLint>(vertexLightUnit));
}

void GlCellProgram::setLights(const std::vector<FrameLight>& lights, const SceneUnits& units) const {
    std::vector<glm::vec3> places, colors, fades;
    std::vector<GLint> kinds;
    for (const FrameLight& light : lights) {
        places.push_back(light.place);
        colors.push_back(light.color);
        fades.push_back(light.fade);
        kinds.push_back(light.kind);
    }
    const auto count = static_cast<GLsizei>(lights.size());
    gl_.Uniform3fv(lightPlace_, count, reinterpret_cast<const float*>(places.data()));
    gl_.Uniform3fv(lightFade_, count, reinterpret_cast<const float*>(fades.data()));
    gl_.Uniform3fv(program_.uniform("lightColor"), count, reinterpret_cast<const float*>(colors.data()));
    gl_.Uniform1iv(program_.uniform("lightKind"), count, kinds.data());
    gl_.Uniform1f(program_.uniform("perLength"), static_cast<float>(1.0 / units.length));
}

void GlCellProgram::setDepthRange(const DepthRange& range, double depthReference, const SceneUnits& units) const {
    gl_.Uniform2f(program_.uniform("depthRange"), static_cast<float>(1.0 - range.greyAt(depthReference * units.length)),
                  static_cast<float>(-range.greyPerDistance() * units.length));
}

void GlCellProgram::use(const CameraFrame& frame, double depthReference) const {
    program_.use();
    gl_.Uniform2f(ndcPerPixel_, 2.0f / static_cast<float>(frame.width), 2.0f / static_cast<float>(frame.height));
    const glm::dvec2 centre = sampleCentre(frame);
    gl_.Uniform2f(centre_, static_cast<float>(centre.x), static_cast<float>(centre.y));
    setVector(gl_, viewForward_, frame.forward);
    setVector(gl_, viewRight_, frame.perPixelRight);
    setVector(gl_, viewDown_, frame.perPixelDown);
    gl_.Uniform2f(rowShape_, static_cast<float>(frame.rowLean), static_cast<float>(frame.rowStretch));
    gl_.Uniform1f(depthReference_, static_cast<float>(depthReference));
    gl_.Uniform1f(depthOrigin_, static_cast<float>(frame.depthOrigin));
}

void GlCellProgram::setTiles(const CameraFrame& frame, std::size_t cellFloats, float leastTransmittance) const {
    gl_.Uniform2i(program_.uniform("viewSize"), frame.width, frame.height);
    gl_.Uniform1ui(program_.uniform("cellVectors"), static_cast<GLuint>(cellFloats / 4));
    gl_.Uniform1f(program_.uniform("leastTransmittance"), leastTransmittance);
}

}  // namespace tetralux::projection
