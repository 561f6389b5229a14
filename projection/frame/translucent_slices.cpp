// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/veiled_volume.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <projection/core/wrapped_engine.h>

namespace tetralux::projection {

namespace {

/// The veils of each pixel, one after the other.
class VeilLists {
public:
    VeilLists(const std::vector<Veil>& veils, std::size_t pixels) : veils_(veils), starts_(pixels + 1) {
        for (const Veil& veil : veils) ++starts_[veil.pixel + 1];
        for (std::size_t i = 0; i < pixels; ++i) {
            most_ = std::max(most_, starts_[i + 1]);
            starts_[i + 1] += starts_[i];
        }
    }

    std::size_t most() const { return most_; }
    std::size_t count(std::size_t pixel) const { return starts_[pixel + 1] - starts_[pixel]; }
    const Veil& of(std::size_t pixel, std::size_t i) const { return veils_[starts_[pixel] + i]; }

private:
    const std::vector<Veil>& veils_;
    std::vector<std::size_t> starts_;
    std::size_t most_ = 0;
};

/// What of the volume lies between veil `part` − 1 and veil `part`; nothing where a pixel has fewer veils.
PixelMaps partOf(const PixelMaps& whole, const VeilLists& veils, std::size_t pixels, std::size_t part) {
    PixelMaps maps;
    maps.nearest = whole.nearest;
    maps.farthest = whole.farthest;
    maps.cutLayerEnd = whole.cutLayerEnd;
    maps.cutNormal = whole.cutNormal;
    maps.extinctionScale = whole.extinctionScale;
    maps.nearest.resize(pixels, 0.0);
    maps.farthest.resize(pixels, std::numeric_limits<double>::infinity());
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::size_t count = veils.count(pixel);
        if (part > 0) {
            const double begin = count > 0 ? veils.of(pixel, std::min(part, count) - 1).distance : 1.0;
            maps.nearest[pixel] = std::max(maps.nearest[pixel], begin);
            if (part > count) maps.farthest[pixel] = maps.nearest[pixel];
        }
        if (part < count) maps.farthest[pixel] = std::min(maps.farthest[pixel], veils.of(pixel, part).distance);
    }
    return maps;
}

/// Counts and times of one more frame.
void add(const FrameReport& part, FrameReport& whole) {
    whole.fragments += part.fragments;
    whole.frameMilliseconds += part.frameMilliseconds;
    whole.pixelsRepaired += part.pixelsRepaired;
    for (const auto& [doubt, count] : part.repairedBecause) whole.repairedBecause[doubt] += count;
    whole.pixelsWrong += part.pixelsWrong;
    whole.tileEntries += part.tileEntries;
    whole.tileEntriesSaved += part.tileEntriesSaved;
    whole.bytesUploaded += part.bytesUploaded;
    for (const auto& [stage, spent] : part.stageMilliseconds) whole.stageMilliseconds[stage] += spent;
}

class VeiledEngine final : public WrappedEngine {
public:
    using WrappedEngine::WrappedEngine;

    Image render(const View& view, FrameReport& report) override {
        if (view.maps == nullptr || view.maps->veils.empty()) return engine_->render(view, report);
        checkPixelMaps(view);
        const auto pixels = static_cast<std::size_t>(view.camera.width) * static_cast<std::size_t>(view.camera.height);
        const VeilLists veils(view.maps->veils, pixels);
        Image image;
        for (std::size_t part = 0; part <= veils.most(); ++part) {
            const PixelMaps maps = partOf(*view.maps, veils, pixels, part);
            FrameReport partReport;
            Image drawn = engine_->render({view.camera, &maps, view.control}, part == 0 ? report : partReport);
            if (part == 0) {
                image = std::move(drawn);
                continue;
            }
            add(partReport, report);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                if (part > veils.count(pixel)) continue;
                glm::vec4& whole = image.pixels[pixel];
                whole += (1.0f - whole.a) * veils.of(pixel, part - 1).color;
                whole += (1.0f - whole.a) * drawn.pixels[pixel];
            }
        }
        return image;
    }
};

}  // namespace

std::unique_ptr<Engine> withVeils(std::unique_ptr<Engine> engine) {
    return std::make_unique<VeiledEngine>(std::move(engine));
}

}  // namespace tetralux::projection
