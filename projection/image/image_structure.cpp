// SPDX-License-Identifier: Apache-2.0
#include <projection/image/image_structure.h>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

namespace {

constexpr int scales = 4;
constexpr int window = 8;                // pixels
constexpr double steadying = 0.1 * 0.1;  // C: so that d tells strong contrast from weak; Wang's 0.03² saturates

/// Luminances, row by row.
struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;

    Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

Plane luminance(const Image& image) {
    Plane plane(image.width, image.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::dvec4 pixel(image.pixels[i]);
        plane.values[i] = std::clamp(0.2126 * pixel.x + 0.7152 * pixel.y + 0.0722 * pixel.z, 0.0, 1.0);
    }
    return plane;
}

Plane halved(const Plane& plane) {
    Plane half(plane.width / 2, plane.height / 2);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            half.values[half.place(x, y)] =
                0.25 * (plane.values[plane.place(2 * x, 2 * y)] + plane.values[plane.place(2 * x + 1, 2 * y)] +
                        plane.values[plane.place(2 * x, 2 * y + 1)] + plane.values[plane.place(2 * x + 1, 2 * y + 1)]);
    return half;
}

/// Mean of h·d over the windows.
double meanDissimilarity(const Plane& a, const Plane& b) {
    constexpr double count = window * window;
    double sum = 0;
    for (int y = 0; y + window <= a.height; ++y)
        for (int x = 0; x + window <= a.width; ++x) {
            double meanA = 0, meanB = 0, squareA = 0, squareB = 0, product = 0;
            for (int j = 0; j < window; ++j)
                for (int i = 0; i < window; ++i) {
                    const std::size_t place = a.place(x + i, y + j);
                    const double u = a.values[place], v = b.values[place];
                    meanA += u / count;
                    meanB += v / count;
                    squareA += u * u / count;
                    squareB += v * v / count;
                    product += u * v / count;
                }
            const double varianceA = std::max(squareA - meanA * meanA, 0.0);
            const double varianceB = std::max(squareB - meanB * meanB, 0.0);
            const double alike = (2 * (product - meanA * meanB) + steadying) / (varianceA + varianceB + steadying);
            sum += steadying / (varianceA + steadying) * (1 - alike);
        }
    return sum / ((a.width - window + 1.0) * (a.height - window + 1.0));
}

double score(Plane a, Plane b) {
    double sum = 0;
    int used = 0;
    for (; used < scales && std::min(a.width, a.height) >= window; ++used) {
        sum += meanDissimilarity(a, b);
        a = halved(a);
        b = halved(b);
    }
    return used > 0 ? sum / used : 0.0;
}

}  // namespace

double structureScore(const Image& unlit, const Image& lit) {
    if (unlit.width != lit.width || unlit.height != lit.height)
        throw std::runtime_error(fmt::format("the unlit picture has {}x{} pixels, the lit one {}x{}; render both alike",
                                             unlit.width, unlit.height, lit.width, lit.height));
    return score(luminance(unlit), luminance(lit));
}

double structureScore(const Image& image) {
    return score(Plane(image.width, image.height), luminance(image));
}

}  // namespace tetralux::projection
