// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_sampler_probe.h>

#include <algorithm>
#include <cmath>

#include <projection/gl/gl_frame_target.h>
#include <projection/gl/gl_program.h>

namespace tetralux::projection {

bool linearSamplerIsExact(const GlFunctions& gl) {
    const GlProgram program(gl, {},
                            {{GL_VERTEX_SHADER, {"projection/gl/gl_full_screen.vert"}},
                             {GL_FRAGMENT_SHADER, {"projection/gl/gl_sampler_probe.frag"}}});
    GLuint texture = 0, vertexArray = 0;
    gl.GenTextures(1, &texture);
    gl.GenVertexArrays(1, &vertexArray);
    GlFrameTarget target(gl);
    target.begin(256, 1, 1.0f);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 2, 1);
    const float texels[8] = {0, 0, 0, 0, 1, 1, 1, 1};
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2, 1, GL_RGBA, GL_FLOAT, texels);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    program.use();
    gl.Uniform1i(program.uniform("twoTexels"), 0);
    gl.Disable(GL_BLEND);
    gl.BindVertexArray(vertexArray);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    const Image differences = target.read();
    gl.BindVertexArray(0);
    gl.DeleteVertexArrays(1, &vertexArray);
    gl.DeleteTextures(1, &texture);
    // weights pass through texture coordinates near 1/2: some 1e-7; 8-bit weights would differ by up to 2e-3
    return std::all_of(differences.pixels.begin(), differences.pixels.end(),
                       [](const glm::vec4& pixel) { return std::abs(pixel.x) < 2e-6f; });
}

}  // namespace tetralux::projection
