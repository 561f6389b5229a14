// SPDX-License-Identifier: Apache-2.0
#include <projection/core/pixel_maps.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t pixelCount(const Camera& camera) {
    return static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
}

}  // namespace

void cutNearer(const Camera& camera, PixelMaps& maps, std::size_t pixel, const Cut& cut) {
    if (maps.nearest.empty()) maps.nearest.assign(pixelCount(camera), 0.0);
    if (maps.cutLayerEnd.empty()) maps.cutLayerEnd.assign(pixelCount(camera), 0.0);
    if (maps.cutNormal.empty()) maps.cutNormal.assign(pixelCount(camera), glm::vec3(0));
    double& nearest = maps.nearest[pixel];
    const bool last = cut.distance > nearest || (nearest == 0.0 && cut.layerEnd > maps.cutLayerEnd[pixel]);
    if (!last) return;
    nearest = std::max(nearest, cut.distance);
    maps.cutLayerEnd[pixel] = cut.layerEnd;
    maps.cutNormal[pixel] = cut.normal;
}

void cutFarther(const Camera& camera, PixelMaps& maps, std::size_t pixel, double distance) {
    if (maps.farthest.empty()) maps.farthest.assign(pixelCount(camera), infinity);
    if (distance < maps.farthest[pixel]) maps.farthest[pixel] = distance;
}

void putOpaque(const Camera& camera, PixelMaps& maps, std::size_t pixel, double distance, const glm::vec3& color) {
    if (maps.farthest.empty()) maps.farthest.assign(pixelCount(camera), infinity);
    if (maps.behind.empty()) maps.behind.assign(pixelCount(camera), glm::vec4(0));
    // what clip planes leave out behind may be hidden by something opaque still farther away: that shows
    if (maps.behind[pixel].a == 1.0f && !(distance < maps.farthest[pixel])) return;
    cutFarther(camera, maps, pixel, distance);
    maps.behind[pixel] = glm::vec4(color, 1.0f);
}

void checkPixelMaps(const View& view) {
    if (view.maps == nullptr) return;
    const std::size_t wanted = pixelCount(view.camera);
    const auto check = [&](const char* name, std::size_t size) {
        if (size != 0 && size != wanted)
            throw std::runtime_error(
                fmt::format("pixel map '{}': {} values for an image of {}x{}; give one per pixel or none", name, size,
                            view.camera.width, view.camera.height));
    };
    check("nearest", view.maps->nearest.size());
    check("farthest", view.maps->farthest.size());
    check("cutLayerEnd", view.maps->cutLayerEnd.size());
    check("cutNormal", view.maps->cutNormal.size());
    if (view.maps->cutLayerEnd.size() != view.maps->cutNormal.size())
        throw std::runtime_error("pixel map 'cutNormal': not of the size of 'cutLayerEnd'; give both or neither");
    check("extinctionScale", view.maps->extinctionScale.size());
    check("behind", view.maps->behind.size());
    const std::vector<TranslucentFragment>& translucent = view.maps->translucent;
    if (!std::is_sorted(translucent.begin(), translucent.end()) ||
        (!translucent.empty() && translucent.back().pixel >= wanted))
        throw std::runtime_error(fmt::format(
            "pixel map 'translucent': not ascending within an image of {}x{}; sort them by pixel, then by distance",
            view.camera.width, view.camera.height));
}

void composeBehind(Image& image, const PixelMaps& maps) {
    for (std::size_t i = 0; i < maps.behind.size(); ++i) {
        glm::vec4& pixel = image.pixels[i];
        pixel += (1.0f - pixel.a) * maps.behind[i];
    }
}

}  // namespace tetralux::projection
