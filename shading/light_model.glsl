// SPDX-License-Identifier: Apache-2.0
//
// Light of one cell segment in full: coloured lights, two-sided materials, and the lobes that one may choose from. One text for GLSL and
// C++; see preint/glsl_prelude.h for the common subset. With lights of intensity 1, C_spec = 1 and Phong it is lightTerm of
// shading/cell_shading.glsl, which is faster.
//
//   Kraus, "Scale-Invariant Volume Rendering", IEEE Visualization 2005, Equation 19: what is reflected and what is transmitted
//   Ament & Dachsbacher, "Anisotropic Ambient Volume Shading", IEEE Visualization 2015: anisotropic lobes from the tensor of a level set
//   Ward, "Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992; Lafortune et al., "Non-Linear Approximation of Reflectance
//   Functions", SIGGRAPH 1997; Henyey & Greenstein, "Diffuse Radiation in the Galaxy", 1941
//
// All lobes are 1 at their largest where isotropic (the phase function: 1 on average), so that intensities mean the same for each.

// What holds for the whole picture. `kind`: 0 Phong, 1 Blinn–Phong, 2 Ward, 3 Lafortune, 4 Henyey–Greenstein.
struct LightModel {
    int kind;
    vec3 frontSpecular, backSpecular;  // C_spec where n points to the eye, and away
    real frontExponent, backExponent;
    real diffuse, specular, diffuseThrough, specularThrough;
    real kappa, gamma;
    real asymmetry;  // Henyey–Greenstein's g
};

// A segment to be lit.
struct LitPoint {
    vec3 normal, view;        // unit; view = −d, towards the eye
    real side;                // sign of v·n, taken from s_f − s_b
    real opacity;             // α, after the silhouette
    vec3 tangent, bitangent;  // unit, with the normal a frame; for anisotropic lobes only, like what follows
    vec3 major;               // x, y: cosine and sine of twice the angle from the tangent to the major direction (0, 0: none)
    real along, across;       // the lobe's u and v
    real height;              // Ward: how much brighter the lobe is in its middle for being narrower than an isotropic one
};

// Any unit vector across n (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
TETRALUX_GLSL_FUNCTION vec3 tangentOf(vec3 n) {
    real turn = select(n.z < real(0.0), real(-1.0), real(1.0));
    real a = real(-1.0) / (turn + n.z);
    return vec3(real(1.0) + turn * n.x * n.x * a, turn * n.x * n.y * a, -turn * n.x);
}
TETRALUX_GLSL_FUNCTION vec3 bitangentOf(vec3 n) {
    real turn = select(n.z < real(0.0), real(-1.0), real(1.0));
    real a = real(-1.0) / (turn + n.z);
    return vec3(n.x * n.y * a, turn + n.y * n.y * a, -n.y);
}

// λ₂/λ₁ ≥ 1, larger over smaller, is bounded by this: a level set without width has no direction to be trusted either.
TETRALUX_GLSL_FUNCTION real leastEigenvalueShare() { return real(1e-3); }

// Sets tangent, bitangent, major and the lobe's u and v from the tensor (symmetric: xx, yy, zz and xy, xz, yz) restricted to the tangent
// plane. u belongs to the major direction, along which the level set extends farther: a fibre's highlight is narrow along it.
TETRALUX_GLSL_FUNCTION void setAnisotropy(LightModel model, vec3 diagonal, vec3 others, TETRALUX_GLSL_INOUT(LitPoint) point) {
    vec3 t = tangentOf(point.normal), b = bitangentOf(point.normal);
    vec3 ct = vec3(diagonal.x * t.x + others.x * t.y + others.y * t.z, others.x * t.x + diagonal.y * t.y + others.z * t.z,
                   others.y * t.x + others.z * t.y + diagonal.z * t.z);
    vec3 cb = vec3(diagonal.x * b.x + others.x * b.y + others.y * b.z, others.x * b.x + diagonal.y * b.y + others.z * b.z,
                   others.y * b.x + others.z * b.y + diagonal.z * b.z);
    real mean = real(0.5) * (dot(t, ct) + dot(b, cb));
    real difference = real(0.5) * (dot(t, ct) - dot(b, cb));
    real mixed = dot(b, ct);
    real root = sqrt(difference * difference + mixed * mixed);
    real inverse = real(1.0) / max(root, real(1e-12));
    real least = leastEigenvalueShare() * mean + real(1e-9);
    real ratio = (mean + root + least) / (max(mean - root, real(0.0)) + least);
    point.tangent = t;
    point.bitangent = b;
    point.major = vec3(difference * inverse, mixed * inverse, real(0.0));
    // u of Ward grows to κ·e⁶ at most: what is narrower would glitter from pixel to pixel
    real narrowing = exp(real(0.5) * min(model.gamma * log(ratio), real(6.0)));
    point.height = narrowing;
    real ward = model.kappa * narrowing * narrowing;
    real lafortune = real(1.0) - real(2.0) * exp(model.gamma * (real(1.0) - ratio));
    if (model.kind == 2) {
        point.along = ward;
        point.across = model.kappa;
    } else {
        point.along = lafortune;
        point.across = real(-1.0);
    }
}

// The part along the major direction of the product of two vectors' tangential components.
TETRALUX_GLSL_FUNCTION real majorProduct(LitPoint point, vec3 a, vec3 b) {
    real ax = dot(a, point.tangent), ay = dot(a, point.bitangent), bx = dot(b, point.tangent), by = dot(b, point.bitangent);
    real straight = ax * bx - ay * by;
    real crossed = ax * by + ay * bx;
    real whole = ax * bx + ay * by;
    return real(0.5) * (whole + point.major.x * straight + point.major.y * crossed);
}

// Gaussian in the slopes of the half-way vector (Ward's Equation 5a, its normalization √(uv)/π over that of an isotropic lobe, κ/π):
// √(u/κ)·exp(−tan²θ(u cos²φ + v sin²φ)). The light that a fibre's highlight does not send along it makes it brighter.
TETRALUX_GLSL_FUNCTION real wardLobe(LitPoint point, vec3 halfway) {
    real facing = point.side * dot(halfway, point.normal);
    real along = majorProduct(point, halfway, halfway);
    real across = max(dot(halfway, halfway) - facing * facing - along, real(0.0));
    real slopes = (point.along * along + point.across * across) / max(facing * facing, real(1e-4));
    return select(facing > real(0.0), point.height * exp(-min(slopes, real(80.0))), real(0.0));
}

// (u·l₂v₂ + v·l₁v₁ + l_n v_n)^exponent; u = v = −1 is Phong. With a quarter of Blinn and Phong's exponent a lobe about the mirrored
// direction is as wide as theirs about the half-way vector: cos(2θ)^(n/4) = cosⁿθ·(1 + O(θ⁴)).
TETRALUX_GLSL_FUNCTION real lafortuneLobe(LitPoint point, vec3 light, real exponent) {
    real normal = dot(light, point.normal) * dot(point.view, point.normal);
    real along = majorProduct(point, light, point.view);
    real across = dot(light, point.view) - normal - along;
    return pow(max(point.along * along + point.across * across + normal, real(0.0)), exponent);
}

// Henyey–Greenstein's phase function times 4π: 1 on average over all directions. `cosine` is that of the angle of deflection.
TETRALUX_GLSL_FUNCTION real phaseFunction(real asymmetry, real cosine) {
    real square = asymmetry * asymmetry;
    real base = max(real(1.0) + square - real(2.0) * asymmetry * cosine, real(1e-6));
    return (real(1.0) - square) / (base * sqrt(base));
}

TETRALUX_GLSL_FUNCTION vec3 halfwayVector(LitPoint point, vec3 light) {
    vec3 halfway = light + point.view;
    return halfway * (real(1.0) / sqrt(max(dot(halfway, halfway), real(1e-12))));
}

// What Phong's or Blinn and Phong's lobe is a power of.
TETRALUX_GLSL_FUNCTION real lobeCosine(LightModel model, LitPoint point, vec3 light) {
    if (model.kind == 1) return point.side * dot(halfwayVector(point, light), point.normal);
    return real(2.0) * dot(light, point.normal) * dot(point.view, point.normal) - dot(light, point.view);
}

// What one light adds to a segment per unit of α and of the light's colour (Equation 19, one term of the sum). Light that goes through
// stands about −l with any lobe and has the material's colour.
TETRALUX_GLSL_FUNCTION vec3 modelTerm(LightModel model, LitPoint point, vec3 diffuseColor, vec3 light) {
    if (model.kind == 4) return phaseFunction(model.asymmetry, -dot(light, point.view)) * diffuseColor;
    real lightSide = dot(light, point.normal);
    real facing = lightSide * point.side;
    vec3 sideSpecular = select(point.side > real(0.0), model.frontSpecular, model.backSpecular);
    real sideExponent = select(point.side > real(0.0), model.frontExponent, model.backExponent);
    vec3 specular = select(facing > real(0.0), sideSpecular, diffuseColor);
    real exponent = select(facing > real(0.0), sideExponent, real(0.5) * (model.frontExponent + model.backExponent));
    real through = select(facing < real(0.0), real(1.0) - point.opacity, real(0.0));
    real diffuseWeight = select(facing > real(0.0), model.diffuse, model.diffuseThrough * through);
    real specularWeight = select(facing > real(0.0), model.specular, model.specularThrough * through);
    real straight = -dot(light, point.view);
    real lobe;
    if (model.kind < 2) {
        lobe = pow(max(select(facing > real(0.0), lobeCosine(model, point, light), straight), real(0.0)), exponent);
    } else {
        real reflected = real(0.0);
        if (model.kind == 2) reflected = wardLobe(point, halfwayVector(point, light));
        if (model.kind == 3) reflected = lafortuneLobe(point, light, real(0.25) * exponent);
        lobe = select(facing > real(0.0), reflected, pow(max(straight, real(0.0)), exponent));
    }
    return (diffuseWeight * abs(lightSide)) * diffuseColor + (specularWeight * lobe) * specular;
}

// Share of a light that is left at a distance; `fade`: constant, per length, per length squared.
TETRALUX_GLSL_FUNCTION real attenuation(vec3 fade, real reach) {
    return real(1.0) / max(fade.x + reach * (fade.y + reach * fade.z), real(1e-30));
}
