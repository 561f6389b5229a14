// SPDX-License-Identifier: Apache-2.0
/// \file
/// Light in full (shading/light_model.glsl) in SIMD lanes: what cpu_shading.h's short way does not know. Included once
/// per instruction set. Directions are along the world's axes here, places as FrameLight has them.
#include <projection/cpu/cpu_shading_vectors.h>

#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_LIGHT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_LIGHT_H
#undef TETRALUX_CPU_LIGHT_H
#else
#define TETRALUX_CPU_LIGHT_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

#include <shading/light_model.glsl>
#include <shading/surface_shadow.glsl>

/// Where a block's segments run, as light needs it.
struct SegmentMiddles {
    real dx, dy;           ///< of the pixels from the cell's reference point
    real weight;           ///< of the constant part: mean depth ratio (orthographic: 1)
    real rayInverseDepth;  ///< mean of depth ratio times inverseDepth (orthographic: mean inverseDepth)
};

/// Of segments between two values of inverseDepth.
HWY_INLINE SegmentMiddles segmentMiddles(real dx, real dy, real in, real out, bool orthographic) {
    const real half(0.5f);
    if (orthographic) return {dx, dy, real(1.0f), half * (in + out)};
    const real ratioIn = reciprocal(real(1.0f) + in), ratioOut = reciprocal(real(1.0f) + out);
    return {dx, dy, half * (ratioIn + ratioOut), half * (ratioIn * in + ratioOut * out)};
}

/// A segment that is lit, as the short way hands it on.
struct SegmentToLight {
    vec3 color;        ///< C_seg/α_seg
    real opacity;      ///< after the silhouette
    real side;         ///< sign of s_f − s_b
    real front, back;  ///< scalars at its ends
    vec3 towards;      ///< of the ray, unit, (right, down, forward)
    const vec3* cut;   ///< normal of the cut in whose layer the segments lie (pixel_maps.h); nullptr: they lie in none
};

HWY_INLINE vec3 broadcast(const glm::vec3& v) {
    return {real(v.x), real(v.y), real(v.z)};
}

/// From (right, down, forward) to the world's axes.
HWY_INLINE vec3 worldFromCamera(const TileFrame& frame, vec3 v) {
    return v.x * broadcast(frame.axes[0]) + v.y * broadcast(frame.axes[1]) + v.z * broadcast(frame.axes[2]);
}

/// Barycentric coordinates of the segments' middles: λ_k is proportional to the distance from face k, and so to
/// inverseDepth − inverseDepth_k times its value at the eye (cell_interval.glsl).
HWY_INLINE void middleCoordinates(const CellBatch& batch, std::size_t j, const SegmentMiddles& middles,
                                  real (&weights)[4]) {
    real sum(0.0f);
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& plane = batch.plane[k];
        const real inverseDepth = planeInverseDepth(cell_real{plane[0][j]}, cell_real{plane[1][j]},
                                                    cell_real{plane[2][j]}, middles.dx, middles.dy);
        weights[k] = clamp(real(batch.eyeWeight[k][j]) * (middles.rayInverseDepth - middles.weight * inverseDepth),
                           real(0.0f), real(1.0f));
        sum += weights[k];
    }
    const real inverse = real(1.0f) / max(sum, real(1e-30f));
    for (real& weight : weights) weight = weight * inverse;
}

/// One attribute at the middles; `values` of the four corners.
HWY_INLINE real attributeAt(const float* const (&values)[4], int place, const real (&weights)[4]) {
    return weights[0] * real(values[0][place]) + weights[1] * real(values[1][place]) +
           (weights[2] * real(values[2][place]) + weights[3] * real(values[3][place]));
}
HWY_INLINE vec3 vectorAt(const float* const (&values)[4], int place, const real (&weights)[4]) {
    return {attributeAt(values, place, weights), attributeAt(values, place + 1, weights),
            attributeAt(values, place + 2, weights)};
}

/// What the vertices of cell j carry, in the order of the planes.
struct CornerValues {
    const float* of[4];
    CornerValues(const shading::VertexLight& kept, const CellBatch& batch, std::size_t j) {
        for (std::size_t k = 0; k < 4; ++k) of[k] = kept.of(static_cast<std::uint32_t>(batch.corner[k][j]));
    }
};

/// Unit smoothed gradient (shading::Normals::Smooth), its size, and where there is one; else 0.
struct SmoothNormal {
    vec3 normal;
    real magnitude;
    mask any;
};
HWY_INLINE SmoothNormal smoothNormalAt(const shading::VertexLight& kept, const float* const (&values)[4],
                                       const real (&weights)[4]) {
    const vec3 gradient = vectorAt(values, kept.normalAt, weights);
    const real square = dot(gradient, gradient);
    const mask any = square > real(1e-30f);
    const real magnitude = sqrt(max(square, real(1e-30f)));
    return {keep(any, real(1.0f) / magnitude) * gradient, keep(any, magnitude), any};
}

/// The smoothed gradient ḡ that silhouettes follow: |ḡ| in ranges per diagonal, and ḡ·d/|ḡ|; 1 where there is none.
struct SmoothSlope {
    real magnitude, cosine;
};
inline HWY_NOINLINE SmoothSlope smoothSlope(const TileFrame& frame, const CellBatch& batch, std::size_t j,
                                            const SegmentMiddles& middles, vec3 towards) {
    real weights[4];
    middleCoordinates(batch, j, middles, weights);
    const CornerValues values(*frame.vertexLight, batch, j);
    const SmoothNormal smooth = smoothNormalAt(*frame.vertexLight, values.of, weights);
    return {smooth.magnitude, select(smooth.any, dot(smooth.normal, worldFromCamera(frame, towards)), real(1.0f))};
}

/// What the isosurfaces of the segments' cell leave of light that comes from `towards` (world).
HWY_INLINE real surfaceShadows(const TileFrame& frame, const CellBatch& batch, std::size_t j,
                               const SegmentToLight& segment, vec3 towards) {
    const float low = batch.scalarLow[j], high = batch.scalarHigh[j];
    real through(1.0f);
    for (const TransferIsosurface& isosurface : frame.transfer->isosurfaces()) {
        if (!(low < isosurface.value && isosurface.value <= high)) continue;
        const vec3 normal(real(batch.normal[0][j]), real(batch.normal[1][j]), real(batch.normal[2][j]));
        const real rise = dot(worldFromCamera(frame, normal), towards);
        through = through * surfaceShadow(real(isosurface.value), real(isosurface.opacity), segment.front, segment.back,
                                          real(low), real(high), rise);
    }
    return through;
}

HWY_INLINE LightModel broadcastModel(const LightModelFloats& floats) {
    LightModel model;
    model.kind = floats.kind;
    model.phase = floats.phase;
    model.frontSpecular = broadcast(floats.frontSpecular);
    model.backSpecular = broadcast(floats.backSpecular);
    model.frontExponent = real(floats.frontExponent);
    model.backExponent = real(floats.backExponent);
    model.diffuse = real(floats.diffuse);
    model.specular = real(floats.specular);
    model.diffuseThrough = real(floats.diffuseThrough);
    model.specularThrough = real(floats.specularThrough);
    model.kappa = real(floats.kappa);
    model.gamma = real(floats.gamma);
    model.asymmetry = real(floats.asymmetry);
    return model;
}

/// Direction to a light and what of its colour arrives at `place`, shadows apart.
HWY_INLINE vec3 arriving(const FrameLight& light, vec3 place, vec3 view, vec3& towards) {
    const vec3 color = broadcast(light.color);
    if (light.kind == 0) {
        towards = broadcast(light.place);
        return color;
    }
    if (light.kind == 2) {  // in orthographic views behind each pixel
        towards = view;
        return attenuation(broadcast(light.fade), dot(broadcast(light.place) - place, view)) * color;
    }
    const vec3 way = broadcast(light.place) - place;
    const real reach = sqrt(dot(way, way));
    const real inverse = real(1.0f) / max(reach, real(1e-18f));
    towards = select(reach > real(0.0f), inverse * way, view);
    return attenuation(broadcast(light.fade), reach) * color;
}

/// Colour per α in the light. `place`: the segments' middles, (right, down, forward) from where FrameLight's places
/// are, scene lengths.
inline HWY_NOINLINE vec3 lightInFull(const TileFrame& frame, const CellBatch& batch, std::size_t j,
                                     const SegmentMiddles& middles, vec3 place, const SegmentToLight& segment) {
    LightModel model = broadcastModel(frame.lightModel);
    const shading::VertexLight& kept = *frame.vertexLight;
    const vec3 ambient = broadcast(frame.lightModel.ambient);
    const vec3 dark(ambient.x * segment.color.x, ambient.y * segment.color.y, ambient.z * segment.color.z);
    if (!(batch.gradient[j] > 0) && kept.normalAt < 0 && model.phase == 0 && segment.cut == nullptr) return dark;

    const float* values[4] = {};
    real weights[4];
    if (kept.any()) {
        middleCoordinates(batch, j, middles, weights);
        for (std::size_t k = 0; k < 4; ++k) values[k] = kept.of(static_cast<std::uint32_t>(batch.corner[k][j]));
    }
    if (kept.specularAt >= 0) {
        const real factor = attributeAt(values, kept.specularAt, weights);
        model.specular = factor;
        model.specularThrough = model.specularThrough * factor;
    }
    LitPoint point;
    point.view = worldFromCamera(frame, -segment.towards);
    point.side = segment.side;
    point.opacity = segment.opacity;
    if (segment.cut != nullptr) {
        point.normal = worldFromCamera(frame, *segment.cut);
    } else if (kept.normalAt >= 0) {
        point.normal = smoothNormalAt(kept, values, weights).normal;
    } else if (batch.gradient[j] > 0) {
        point.normal =
            worldFromCamera(frame, vec3(real(batch.normal[0][j]), real(batch.normal[1][j]), real(batch.normal[2][j])));
    } else {
        point.normal = vec3(real(0.0f));
    }
    if (kept.tensorAt >= 0)
        setAnisotropy(model, vectorAt(values, kept.tensorAt, weights), vectorAt(values, kept.tensorAt + 3, weights),
                      point);
    vec3 light = dark;
    const vec3 middle = worldFromCamera(frame, place);
    for (std::size_t i = 0; i < frame.fullLights.size(); ++i) {
        vec3 towards;
        vec3 color = arriving(frame.fullLights[i], middle, point.view, towards);
        if (kept.shadowAt >= 0) {
            real shadow = attributeAt(values, kept.shadowAt + static_cast<int>(i), weights);
            if (!kept.corners.empty()) shadow = shadow * surfaceShadows(frame, batch, j, segment, towards);
            color = shadow * color;
        }
        const vec3 term = modelTerm(model, point, segment.color, towards);
        light = light + vec3(color.x * term.x, color.y * term.y, color.z * term.z);
    }
    return light;
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
