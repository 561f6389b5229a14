// SPDX-License-Identifier: Apache-2.0
//
// Silhouettes and light of one cell segment (Kraus, "Scale-Invariant Volume Rendering", IEEE Visualization 2005). One
// text for GLSL and C++; see preint/glsl_prelude.h for the common subset.
//
// A segment is (meanColor, opticalDepth): C_seg/α_seg and −ln(1 − α_seg). In these terms Equation 15, α′ = 1 − (1 −
// α)^k, is opticalDepth′ = k·opticalDepth, with k of Equation 17, and C′ = C·α′/α (behind Equation 15) leaves
// meanColor as it is.

// Equation 15 with k = |g|/|g·d| = 1/|cosine| (Equation 17), cosine = n·d. `smoothDepthTimesK` is the part of the
// depth that stays finite as the cosine vanishes, already multiplied by k (scale-invariant: mean τ·|g|·l);
// `otherDepth` is the rest (isosurfaces; all of it in the standard integral).
TETRALUX_GLSL_FUNCTION real silhouetteDepth(real smoothDepthTimesK, real otherDepth, real cosine) {
    return smoothDepthTimesK + otherDepth / max(abs(cosine), real(1e-30));
}

// What one light of intensity 1 adds to a segment per unit of α (Equation 19, one term of the sum).
//   normal      n = g/|g|, unit
//   view        v = −d, unit, towards the eye
//   light       l, unit, towards the light
//   side        sign of v·n, taken from s_f − s_b
//   transmitted 1 − α where light may pass, 0 where transmission is off
// Reflection where (l·n)(v·n) > 0, with r = 2n(n·l) − l and a highlight in the light's colour; transmission where it
// is < 0: its specular lobe is about the direction in which light goes straight on, −l, and in the material's colour,
// which the light went through.
TETRALUX_GLSL_FUNCTION vec3 lightTerm(vec3 diffuseColor, vec3 normal, vec3 view, vec3 light, real side, real transmitted,
                                      real exponent) {
    real lightSide = dot(light, normal);
    real facing = lightSide * side;
    vec3 reflected = real(2.0) * lightSide * normal - light;
    vec3 lobe = select(facing > real(0.0), reflected, -light);
    real specular = pow(max(dot(lobe, view), real(0.0)), exponent);
    real weight = select(facing > real(0.0), real(1.0), select(facing < real(0.0), transmitted, real(0.0)));
    vec3 specularColor = select(facing > real(0.0), vec3(real(1.0)), diffuseColor);
    return weight * (diffuseColor * abs(lightSide) + specular * specularColor);
}
