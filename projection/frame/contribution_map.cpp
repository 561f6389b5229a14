// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/contribution_map.h>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace tetralux::projection {

namespace {

struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;
    float at(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

/// Mean of the values that are not 0, weighted; 0 where there are none.
struct Mean {
    double sum = 0, weights = 0;
    void add(double value, double weight) {
        if (!(value > 0)) return;
        sum += weight * value;
        weights += weight;
    }
    float value() const { return weights > 0 ? static_cast<float>(sum / weights) : 0.0f; }
};

Camera reduced(const Camera& camera, int factor) {
    Camera result = camera;
    result.width = (camera.width + factor - 1) / factor;
    result.height = (camera.height + factor - 1) / factor;
    return result;
}

/// The pixel of `from` that sees what coordinate `at` of `to` sees, along one axis (size along it, height of the
/// image).
double matching(double at, int size, int height, int otherSize, int otherHeight) {
    return 0.5 * ((2.0 * (at + 0.5) - size) / height * otherHeight + otherSize) - 0.5;
}

/// Limits of the nearest pixel for every pixel of the smaller view.
PixelMaps reducedLimits(const PixelMaps& maps, const Camera& camera, const Camera& small) {
    PixelMaps result;
    const auto take = [&](const std::vector<double>& from, std::vector<double>& to) {
        if (from.empty()) return;
        for (int y = 0; y < small.height; ++y)
            for (int x = 0; x < small.width; ++x) {
                const auto nearest = [](double at, int size) {
                    return static_cast<std::size_t>(std::clamp(static_cast<int>(std::lround(at)), 0, size - 1));
                };
                const std::size_t column =
                    nearest(matching(x, small.width, small.height, camera.width, camera.height), camera.width);
                const std::size_t row =
                    nearest(matching(y, small.height, small.height, camera.height, camera.height), camera.height);
                to.push_back(from[row * static_cast<std::size_t>(camera.width) + column]);
            }
    };
    take(maps.nearest, result.nearest);
    take(maps.farthest, result.farthest);
    return result;
}

Plane gaussian(const Plane& plane, double sigma) {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<double> weights;
    for (int i = -reach; i <= reach; ++i) weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    // sum and weight are both filtered, so that the two one-dimensional passes make the two-dimensional mean
    std::vector<Mean> rows(plane.values.size());
    Plane result = plane;
    const auto width = static_cast<std::size_t>(plane.width);
    tbb::parallel_for(0, plane.height, [&](int y) {
        for (int x = 0; x < plane.width; ++x) {
            Mean& mean = rows[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
            for (int i = std::max(-reach, -x); i <= std::min(reach, plane.width - 1 - x); ++i)
                mean.add(static_cast<double>(plane.at(x + i, y)), weights[static_cast<std::size_t>(i + reach)]);
        }
    });
    tbb::parallel_for(0, plane.height, [&](int y) {
        for (int x = 0; x < plane.width; ++x) {
            Mean mean;
            for (int i = std::max(-reach, -y); i <= std::min(reach, plane.height - 1 - y); ++i) {
                const Mean& row = rows[static_cast<std::size_t>(y + i) * width + static_cast<std::size_t>(x)];
                mean.sum += weights[static_cast<std::size_t>(i + reach)] * row.sum;
                mean.weights += weights[static_cast<std::size_t>(i + reach)] * row.weights;
            }
            result.values[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = mean.value();
        }
    });
    return result;
}

std::vector<float> interpolated(const Plane& plane, const Camera& camera) {
    std::vector<float> result(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
    tbb::parallel_for(0, camera.height, [&](int y) {
        for (int x = 0; x < camera.width; ++x) {
            const double atX =
                std::clamp(matching(x, camera.width, camera.height, plane.width, plane.height), 0.0, plane.width - 1.0);
            const double atY = std::clamp(matching(y, camera.height, camera.height, plane.height, plane.height), 0.0,
                                          plane.height - 1.0);
            const int x0 = static_cast<int>(atX), y0 = static_cast<int>(atY);
            const int x1 = std::min(x0 + 1, plane.width - 1), y1 = std::min(y0 + 1, plane.height - 1);
            const double u = atX - x0, v = atY - y0;
            Mean mean;
            mean.add(static_cast<double>(plane.at(x0, y0)), (1 - u) * (1 - v));
            mean.add(static_cast<double>(plane.at(x1, y0)), u * (1 - v));
            mean.add(static_cast<double>(plane.at(x0, y1)), (1 - u) * v);
            mean.add(static_cast<double>(plane.at(x1, y1)), u * v);
            result[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(x)] =
                mean.value();
        }
    });
    return result;
}

}  // namespace

std::vector<float> contributionMap(const View& view, const AdaptiveSettings& settings,
                                   const std::function<Image(const View&)>& measure) {
    const int factor = settings.filter == AdaptiveSettings::Filter::Bilinear2   ? 2
                       : settings.filter == AdaptiveSettings::Filter::Bilinear4 ? 4
                                                                                : 1;
    const Camera camera = reduced(view.camera, factor);
    PixelMaps limits;
    if (view.maps != nullptr) limits = reducedLimits(*view.maps, view.camera, camera);
    const Image image = measure({camera, limits.changeVolume() ? &limits : nullptr, view.control});
    Plane plane{image.width, image.height, {}};
    for (const glm::vec4& pixel : image.pixels) plane.values.push_back(pixel.a);
    if (settings.filter == AdaptiveSettings::Filter::Gaussian) plane = gaussian(plane, settings.sigma);
    return factor == 1 ? std::move(plane.values) : interpolated(plane, view.camera);
}

}  // namespace tetralux::projection
