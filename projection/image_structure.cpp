// SPDX-License-Identifier: Apache-2.0
#include <projection/image_structure.h>

#include <cmath>

namespace tetralux::projection {

namespace {

constexpr int scales = 3;

/// Values on a grid that shrinks from scale to scale.
struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;

    Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    double& at(int x, int y) {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

Plane luminance(const Image& image) {
    Plane plane(image.width, image.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec4& pixel = image.pixels[i];
        plane.values[i] = 0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z;
    }
    return plane;
}

/// Turns A_{i−1} into A_i; returns the mean of E_i.
double nextScale(Plane& plane, int step) {
    Plane coarse(plane.width - step, plane.height - step);
    double sum = 0.0;
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x) {
            const double a = plane.at(x, y), b = plane.at(x + step, y);
            const double c = plane.at(x, y + step), d = plane.at(x + step, y + step);
            const double horizontal = 0.25 * (a - b + c - d), vertical = 0.25 * (a + b - c - d),
                         diagonal = 0.25 * (a - b - c + d);
            coarse.at(x, y) = 0.25 * (a + b + c + d);
            sum += std::sqrt(horizontal * horizontal + vertical * vertical + diagonal * diagonal);
        }
    const double mean = sum / static_cast<double>(coarse.values.size());
    plane = std::move(coarse);
    return mean;
}

}  // namespace

double structureScore(const Image& image) {
    Plane plane = luminance(image);
    double sum = 0.0;
    int used = 0;
    for (int step = 1; used < scales && step < plane.width && step < plane.height; step *= 2, ++used)
        sum += nextScale(plane, step);
    return used > 0 ? sum / used : 0.0;
}

}  // namespace tetralux::projection
