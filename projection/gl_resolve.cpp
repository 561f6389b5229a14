// SPDX-License-Identifier: Apache-2.0
#include <projection/gl_resolve.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tetralux::projection {

float clearValue(Mode mode) {
    return mode == Mode::Mip ? -1.0f : 0.0f;  // scene scalars are in [0, 1]
}

void resolveOrderFree(Image& image, Mode mode, const preint::TransferFunction& function, const SceneUnits& units) {
    if (mode != Mode::Mip && mode != Mode::Average) return;
    const auto resolve = [&](glm::vec4& pixel) {
        const bool hit = mode == Mode::Mip ? pixel.x >= 0.0f : pixel.y > 0.0f;
        if (!hit) {
            pixel = glm::vec4(0);
            return;
        }
        const double scalar = mode == Mode::Mip ? static_cast<double>(pixel.x)
                                                : static_cast<double>(pixel.x) / static_cast<double>(pixel.y);
        const glm::dvec3 color = function.colorAt(units.scalarOffset + scalar * units.scalarScale);
        pixel = glm::vec4(glm::vec3(color), 1.0f);
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.pixels.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) resolve(image.pixels[i]);
    });
}

}  // namespace tetralux::projection
