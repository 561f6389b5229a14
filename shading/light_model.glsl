// SPDX-License-Identifier: Apache-2.0
//
// Light of one cell segment in full: coloured lights, two-sided materials, and the lobes that one may choose from.
// One text for GLSL and C++; see preint/glsl_prelude.h for the common subset. With lights of intensity 1, C_spec = 1
// and Phong it is lightTerm of shading/cell_shading.glsl, which is faster.
//
//   Kraus, "Scale-Invariant Volume Rendering", IEEE Visualization 2005, Equation 19: what is reflected and what is transmitted
//   Ament & Dachsbacher, "Anisotropic Ambient Volume Shading", IEEE Visualization 2015: anisotropic lobes from the tensor of a level set
//   Ward, "Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992; Lafortune et al., "Non-Linear Approximation of Reflectance
//   Functions", SIGGRAPH 1997; Henyey & Greenstein, "Diffuse Radiation in the Galaxy", 1941
//
// Lobes are 1 at their largest, but for Ward's, which has the norm of his Equation 5a; phase functions are 1 on
// average over all directions.

// What holds for the whole picture. `kind` of highlight: 0 Phong, 1 Blinn–Phong, 2 Ward, 3 Lafortune, 4 none.
// `phase`: 1 where the diffuse part is Henyey–Greenstein's phase function.
struct LightModel {
    int kind, phase;
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

// λ₂/λ₁ ≥ 1, larger over smaller, is bounded by one over this: a level set without width has no direction to be
// trusted either.
TETRALUX_GLSL_FUNCTION real leastEigenvalueShare() { return real(1e-3); }

// Ward's u is at most this, or κ where κ is more: at 10 the highlight is half as bright as in its middle where the
// half-way vector leans 69° along the fibre. A larger u would draw it out no farther, only make it dimmer.
TETRALUX_GLSL_FUNCTION real largestRoughness() { return real(10.0); }

// (n·l)(n·v) in Ward's norm is at least this, so that 1/√((n·l)(n·v)) ≤ 100 towards silhouettes.
TETRALUX_GLSL_FUNCTION real leastGrazing() { return real(1e-4); }

// Sets tangent, bitangent, major and the lobe's u and v from the tensor (symmetric: xx, yy, zz and xy, xz, yz)
// restricted to the tangent plane. u belongs to the major direction, along which the level set extends farther: a
// fibre's highlight is drawn out along it.
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
    real wide = max(mean + root, real(0.0));
    real narrow = max(mean - root, leastEigenvalueShare() * wide);
    real ratio = (wide + real(1e-9)) / (narrow + real(1e-9));
    point.tangent = t;
    point.bitangent = b;
    point.major = vec3(difference * inverse, mixed * inverse, real(0.0));
    if (model.kind == 2) {
        // Equations 32, 33
        real most = log(max(largestRoughness() / model.kappa, real(1.0)));
        point.along = model.kappa * exp(min(model.gamma * log(ratio), most));
        point.across = model.kappa;
    } else {
        // Equations 34, 35
        point.along = real(1.0) - real(2.0) * exp(model.gamma * (real(1.0) - ratio));
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

TETRALUX_GLSL_FUNCTION vec3 halfwayVector(LitPoint point, vec3 light) {
    vec3 halfway = light + point.view;
    return halfway * (real(1.0) / sqrt(max(dot(halfway, halfway), real(1e-12))));
}

// f_s of Equations 9 to 11: exp(−((H·U)²/u + (H·V)²/v)/(H·n)²)/(4π√(uv(n·l)(n·v))).
TETRALUX_GLSL_FUNCTION real wardLobe(LitPoint point, vec3 light) {
    vec3 halfway = halfwayVector(point, light);
    real facing = point.side * dot(halfway, point.normal);
    real along = majorProduct(point, halfway, halfway);
    real across = max(dot(halfway, halfway) - facing * facing - along, real(0.0));
    real slopes = (along / point.along + across / point.across) / max(facing * facing, real(1e-4));
    real grazing = max(abs(dot(light, point.normal) * dot(point.view, point.normal)), leastGrazing());
    return real(0.0795774715) * exp(-min(slopes, real(80.0))) / sqrt(point.along * point.across * grazing);
}

// f_s of Equation 12 with n_l = 1; u = v = −1 is Phong.
TETRALUX_GLSL_FUNCTION real lafortuneLobe(LitPoint point, vec3 light, real exponent) {
    real normal = dot(light, point.normal) * dot(point.view, point.normal);
    real along = majorProduct(point, light, point.view);
    real across = dot(light, point.view) - normal - along;
    return pow(max(point.along * along + point.across * across + normal, real(0.0)), exponent);
}

// Henyey–Greenstein's phase function times 4π: 1 on average over all directions. `cosine` is that of the angle of
// deflection.
TETRALUX_GLSL_FUNCTION real phaseFunction(real asymmetry, real cosine) {
    real square = asymmetry * asymmetry;
    real base = max(real(1.0) + square - real(2.0) * asymmetry * cosine, real(1e-6));
    return (real(1.0) - square) / (base * sqrt(base));
}

// What Phong's or Blinn and Phong's lobe is a power of.
TETRALUX_GLSL_FUNCTION real lobeCosine(LightModel model, LitPoint point, vec3 light) {
    if (model.kind == 1) return point.side * dot(halfwayVector(point, light), point.normal);
    return real(2.0) * dot(light, point.normal) * dot(point.view, point.normal) - dot(light, point.view);
}

TETRALUX_GLSL_FUNCTION real highlight(LightModel model, LitPoint point, vec3 light, real exponent) {
    if (model.kind == 2) return wardLobe(point, light);
    if (model.kind == 3) return lafortuneLobe(point, light, exponent);
    return pow(max(lobeCosine(model, point, light), real(0.0)), exponent);
}

// What one light adds to a segment per unit of α and of the light's colour: of Ward's and Lafortune's highlights, and
// of any beside a phase function, k_d f_d + k_s f_s (l·n)₊ (Ament & Dachsbacher 2015, Equation 4), where n is turned
// to the eye; else one term of Kraus's Equation 19, whose specular transmission stands about −l and has the
// material's colour. f_d is the phase function, or Equation 19's diffuse light.
TETRALUX_GLSL_FUNCTION vec3 modelTerm(LightModel model, LitPoint point, vec3 diffuseColor, vec3 light) {
    real lightSide = dot(light, point.normal), straight = -dot(light, point.view);
    real facing = lightSide * point.side;
    real through = select(facing < real(0.0), real(1.0) - point.opacity, real(0.0));
    real diffuse = abs(lightSide) * select(facing > real(0.0), model.diffuse, model.diffuseThrough * through);
    if (model.phase == 1) diffuse = model.diffuse * phaseFunction(model.asymmetry, straight);
    if (model.kind == 4) return diffuse * diffuseColor;
    vec3 sideSpecular = select(point.side > real(0.0), model.frontSpecular, model.backSpecular);
    real sideExponent = select(point.side > real(0.0), model.frontExponent, model.backExponent);
    if (model.kind > 1 || model.phase == 1) {
        real lobe = highlight(model, point, light, sideExponent) * (model.specular * abs(lightSide));
        return diffuse * diffuseColor + select(facing > real(0.0), lobe, real(0.0)) * sideSpecular;
    }
    vec3 specular = select(facing > real(0.0), sideSpecular, diffuseColor);
    real exponent = select(facing > real(0.0), sideExponent, real(0.5) * (model.frontExponent + model.backExponent));
    real weight = select(facing > real(0.0), model.specular, model.specularThrough * through);
    real cosine = select(facing > real(0.0), lobeCosine(model, point, light), straight);
    return diffuse * diffuseColor + (weight * pow(max(cosine, real(0.0)), exponent)) * specular;
}

// Share of a light that is left at a distance; `fade`: constant, per length, per length squared.
TETRALUX_GLSL_FUNCTION real attenuation(vec3 fade, real reach) {
    return real(1.0) / max(fade.x + reach * (fade.y + reach * fade.z), real(1e-30));
}
