// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/translucent_slices.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <projection/core/wrapped_engine.h>

namespace tetralux::projection {

namespace {

/// The translucent fragments of each pixel, one after the other.
class TranslucentLists {
public:
    TranslucentLists(const std::vector<TranslucentFragment>& translucent, std::size_t pixels)
        : translucent_(translucent), starts_(pixels + 1) {
        for (const TranslucentFragment& fragment : translucent) ++starts_[fragment.pixel + 1];
        for (std::size_t i = 0; i < pixels; ++i) {
            most_ = std::max(most_, starts_[i + 1]);
            starts_[i + 1] += starts_[i];
        }
    }

    std::size_t most() const { return most_; }
    std::size_t count(std::size_t pixel) const { return starts_[pixel + 1] - starts_[pixel]; }
    const TranslucentFragment& of(std::size_t pixel, std::size_t i) const { return translucent_[starts_[pixel] + i]; }

private:
    const std::vector<TranslucentFragment>& translucent_;
    std::vector<std::size_t> starts_;
    std::size_t most_ = 0;
};

/// What of the volume lies between translucent fragment `part` − 1 and `part`; nothing where a pixel has fewer.
PixelMaps partOf(const PixelMaps& whole, const TranslucentLists& translucent, std::size_t pixels, std::size_t part) {
    PixelMaps maps;
    maps.nearest = whole.nearest;
    maps.farthest = whole.farthest;
    maps.cutLayerEnd = whole.cutLayerEnd;
    maps.cutNormal = whole.cutNormal;
    maps.extinctionScale = whole.extinctionScale;
    maps.nearest.resize(pixels, 0.0);
    maps.farthest.resize(pixels, std::numeric_limits<double>::infinity());
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::size_t count = translucent.count(pixel);
        if (part > 0) {
            const double begin = count > 0 ? translucent.of(pixel, std::min(part, count) - 1).distance : 1.0;
            maps.nearest[pixel] = std::max(maps.nearest[pixel], begin);
            if (part > count) maps.farthest[pixel] = maps.nearest[pixel];
        }
        if (part < count) maps.farthest[pixel] = std::min(maps.farthest[pixel], translucent.of(pixel, part).distance);
    }
    return maps;
}

/// Counts and times of one more frame.
void add(const FrameReport& part, FrameReport& whole) {
    whole.fragments += part.fragments;
    whole.frameMilliseconds += part.frameMilliseconds;
    whole.pixelsRepaired += part.pixelsRepaired;
    for (const auto& [reason, count] : part.repairedBecause) whole.repairedBecause[reason] += count;
    whole.pixelsWrong += part.pixelsWrong;
    whole.tileEntries += part.tileEntries;
    whole.tileEntriesSaved += part.tileEntriesSaved;
    whole.bytesUploaded += part.bytesUploaded;
    for (const auto& [stage, spent] : part.stageMilliseconds) whole.stageMilliseconds[stage] += spent;
}

class TranslucentSlicesEngine final : public WrappedEngine {
public:
    using WrappedEngine::WrappedEngine;

    Image render(const View& view, FrameReport& report) override {
        if (view.maps == nullptr || view.maps->translucent.empty()) return engine_->render(view, report);
        checkPixelMaps(view);
        const auto pixels = static_cast<std::size_t>(view.camera.width) * static_cast<std::size_t>(view.camera.height);
        const TranslucentLists translucent(view.maps->translucent, pixels);
        Image image;
        for (std::size_t part = 0; part <= translucent.most(); ++part) {
            const PixelMaps maps = partOf(*view.maps, translucent, pixels, part);
            FrameReport partReport;
            Image drawn = engine_->render({view.camera, &maps, view.control}, part == 0 ? report : partReport);
            if (part == 0) {
                image = std::move(drawn);
                continue;
            }
            add(partReport, report);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                if (part > translucent.count(pixel)) continue;
                glm::vec4& whole = image.pixels[pixel];
                whole += (1.0f - whole.a) * translucent.of(pixel, part - 1).color;
                whole += (1.0f - whole.a) * drawn.pixels[pixel];
            }
        }
        return image;
    }
};

}  // namespace

std::unique_ptr<Engine> withTranslucentSlices(std::unique_ptr<Engine> engine) {
    return std::make_unique<TranslucentSlicesEngine>(std::move(engine));
}

}  // namespace tetralux::projection
