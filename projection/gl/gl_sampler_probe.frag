// SPDX-License-Identifier: Apache-2.0
//
// Samples between two texels, 0 and 1, at the weight (x + 0.37)/256, which comes back.
uniform sampler2D twoTexels;
layout(location = 0) out vec4 result;

void main() {
    float weight = (gl_FragCoord.x - 0.5 + 0.37) / 256.0;
    result = vec4(textureLod(twoTexels, vec2(0.25 + 0.5 * weight, 0.5), 0.0).x - weight);
}
