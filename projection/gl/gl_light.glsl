// SPDX-License-Identifier: Apache-2.0
//
// Light in full (shading/light_model.glsl) of a segment, with what the vertices carry for it (shading/vertex_light.h).

uniform vec2 rowShape;  // rowLean, rowStretch of the camera
uniform vec3 viewForward, viewRight, viewDown;  // world space; right and down per pixel (perspective: at depth 1)

#if TETRALUX_FULL_LIGHT
uniform vec3 lightPlace[TETRALUX_LIGHTS];  // towards it, or its place from where middlePlace is, scene lengths
uniform vec3 lightColor[TETRALUX_LIGHTS];
uniform vec3 lightFade[TETRALUX_LIGHTS];
uniform int lightKind[TETRALUX_LIGHTS];    // 0 directional, 1 point, 2 at the eye
uniform vec3 specularOf[2];                // front, back
uniform vec2 exponentOf;
uniform vec4 diffuseAndSpecular;           // reflection, reflection, transmission, transmission
uniform vec3 kappaGammaAsymmetry;
uniform vec3 ambientColor;
uniform float perLength;                   // scene lengths per mesh unit
#else
const float perLength = 0.0;
#endif

#if TETRALUX_FULL_LIGHT || TETRALUX_ATTRIBUTES
vec3 middlePlace;   // of the segment, from the point on the view's axis at depthReference, scene lengths
vec4 middleWeight;  // barycentric coordinates there

#if TETRALUX_ATTRIBUTES
TETRALUX_OF_CELL vec4 eyeWeight;
TETRALUX_OF_CELL uvec4 points;
uniform samplerBuffer vertexLight;  // TETRALUX_ATTRIBUTES texels per point

float attributeAt(int place) {
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        sum += middleWeight[k] * texelFetch(vertexLight, int(points[k]) * TETRALUX_ATTRIBUTES + place / 4)[place % 4];
    }
    return sum;
}
vec3 vectorAt(int place) { return vec3(attributeAt(place), attributeAt(place + 1), attributeAt(place + 2)); }
#endif

#if TETRALUX_ATTRIBUTES && TETRALUX_NORMAL_AT >= 0
// Unit smoothed gradient (shading::Normals::Smooth) at the middle, and 1; zeros where there is none.
vec4 smoothNormal() {
    vec3 smoothed = vectorAt(TETRALUX_NORMAL_AT);
    float square = dot(smoothed, smoothed);
    return square > 1e-30 ? vec4(smoothed * inversesqrt(square), sqrt(square)) : vec4(0.0);
}
#endif

// Where the middle of the segment between inverseDepth.x and inverseDepth.y lies.
void setMiddle(CellRecord cell, vec2 inverseDepth, float dx, float dy, vec2 fromCentre) {
#if TETRALUX_ORTHOGRAPHIC
    float constant = 1.0, rayInverseDepth = 0.5 * (inverseDepth.x + inverseDepth.y);
    middlePlace = perLength * (fromCentre.x * viewRight + fromCentre.y * viewDown) +
                  (beyondReference(cell) - abs(cell.scale) * rayInverseDepth) * viewForward;
#else
    vec2 ratio = vec2(depthRatio(inverseDepth.x), depthRatio(inverseDepth.y));
    float constant = 0.5 * (ratio.x + ratio.y), rayInverseDepth = 0.5 * (ratio.x * inverseDepth.x + ratio.y * inverseDepth.y);
    middlePlace = 0.5 * (depthBeyond(cell, inverseDepth.x) + depthBeyond(cell, inverseDepth.y)) * viewForward +
                  cell.scale * constant * (fromCentre.x * viewRight + fromCentre.y * viewDown);
#endif
#if TETRALUX_ATTRIBUTES
    for (int k = 0; k < 4; ++k) {
        float face = planeInverseDepth(cell.plane[k].x, cell.plane[k].y, cell.plane[k].z, dx, dy);
        middleWeight[k] = clamp(eyeWeight[k] * (rayInverseDepth - constant * face), 0.0, 1.0);
    }
    middleWeight /= max(middleWeight.x + middleWeight.y + middleWeight.z + middleWeight.w, 1e-30);
#endif
}
#endif

#if TETRALUX_SURFACE_SHADOWS
float surfaceShadows(vec3 towards);  // gl_segment.glsl
#endif

#if TETRALUX_FULL_LIGHT
// What of light i arrives at the middle, shadows apart, and the direction to it.
vec3 arriving(int i, vec3 view, out vec3 towards) {
    towards = lightPlace[i];
    if (lightKind[i] == 0) return lightColor[i];
    if (lightKind[i] == 2) {  // in orthographic views behind each pixel
        towards = view;
        return attenuation(lightFade[i], dot(lightPlace[i] - middlePlace, view)) * lightColor[i];
    }
    vec3 way = lightPlace[i] - middlePlace;
    float reach = length(way);
    towards = reach > 0.0 ? way / max(reach, 1e-18) : view;
    return attenuation(lightFade[i], reach) * lightColor[i];
}

// Colour per α. `gradient`: the cell's unit normal and |g|.
vec3 lightInFull(vec3 meanColor, float opacity, float side, vec3 view, vec4 gradient, bool cut) {
    LightModel model;
    model.kind = TETRALUX_REFLECTANCE;
    model.phase = TETRALUX_PHASE;
    model.frontSpecular = specularOf[0];
    model.backSpecular = specularOf[1];
    model.frontExponent = exponentOf.x;
    model.backExponent = exponentOf.y;
    model.diffuse = diffuseAndSpecular.x;
    model.specular = diffuseAndSpecular.y;
    model.diffuseThrough = diffuseAndSpecular.z;
    model.specularThrough = diffuseAndSpecular.w;
    model.kappa = kappaGammaAsymmetry.x;
    model.gamma = kappaGammaAsymmetry.y;
    model.asymmetry = kappaGammaAsymmetry.z;

#if TETRALUX_SPECULAR_AT >= 0
    float specularFactor = attributeAt(TETRALUX_SPECULAR_AT);
    model.specular = specularFactor;
    model.specularThrough *= specularFactor;
#endif

    vec3 light = ambientColor * meanColor;
    LitPoint point;
    point.normal = gradient.xyz;
    float magnitude = gradient.w;
#if TETRALUX_NORMAL_AT >= 0
    if (!cut) {
        vec4 smoothed = smoothNormal();
        point.normal = smoothed.xyz;
        magnitude = smoothed.w;
    }
#endif
    if (!(magnitude > 0.0)) {
        if (TETRALUX_PHASE == 0) return light;
        point.normal = vec3(0.0);
    }
    point.view = view;
    point.side = side;
    point.opacity = opacity;
#if TETRALUX_TENSOR_AT >= 0
    setAnisotropy(model, vectorAt(TETRALUX_TENSOR_AT), vectorAt(TETRALUX_TENSOR_AT + 3), point);
#endif
    for (int i = 0; i < TETRALUX_LIGHTS; ++i) {
        vec3 towards;
        vec3 color = arriving(i, view, towards);
#if TETRALUX_SHADOW_AT >= 0
        color *= attributeAt(TETRALUX_SHADOW_AT + i);
#endif
#if TETRALUX_SURFACE_SHADOWS
        color *= surfaceShadows(towards);
#endif
        light += color * modelTerm(model, point, meanColor, towards);
    }
    return light;
}
#endif
