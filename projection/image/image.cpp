// SPDX-License-Identifier: Apache-2.0
#include <projection/image/image.h>

namespace tetralux::projection {

void putUnder(Image& image, const glm::vec3& background) {
    for (glm::vec4& pixel : image.pixels) {
        const float transparency = 1.0f - pixel.w;
        pixel = {pixel.x + transparency * background.x, pixel.y + transparency * background.y,
                 pixel.z + transparency * background.z, 1.0f};
    }
}

}  // namespace tetralux::projection
