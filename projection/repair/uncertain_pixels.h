// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tetralux::projection {

/// Why an engine cannot vouch for a pixel.
enum class Uncertainty {
    Order,        ///< of its cells (visibility_order.h), or what the engine saw of it
    NotANumber,   ///< the engine said so itself, or computed none
    EdgeMet,      ///< its ray runs along edges, where single cells show (isosurface_perturbation.h)
    EyeTouched,   ///< by a cell that ends there (eye_contact.h)
    Outline,      ///< of an isosurface (isosurface_outlines.h, isosurface_perturbation.h)
    BeyondFloat,  ///< a cell is (float_limits.h)
    FaceEdgeOn,   ///< edge_on_faces.h
    Count
};

/// Pixels (y·width + x) that an engine cannot vouch for, each counted for the first reason that names it.
class UncertainPixels {
public:
    explicit UncertainPixels(std::size_t pixels) : pixels_(pixels) {}

    void add(Uncertainty reason, std::span<const std::uint32_t> pixels) {
        for (std::uint32_t pixel : pixels) mark(reason, pixel);
    }
    void mark(Uncertainty reason, std::uint32_t pixel) {
        if (marked_.empty()) marked_.resize(pixels_);
        if (marked_[pixel]) return;
        marked_[pixel] = true;
        ++counts_[static_cast<std::size_t>(reason)];
    }

    bool any() const { return !marked_.empty(); }

    std::vector<std::uint32_t> ascending() const {
        std::vector<std::uint32_t> all;
        for (std::size_t i = 0; i < marked_.size(); ++i)
            if (marked_[i]) all.push_back(static_cast<std::uint32_t>(i));
        return all;
    }

    /// How many there are for each reason, by its name in reports.
    std::map<std::string, std::uint64_t> byReason() const {
        static constexpr std::array<const char*, static_cast<std::size_t>(Uncertainty::Count)> names{
            "order", "not a number", "edges met", "eye touched", "outlines", "beyond float", "faces edge-on"};
        std::map<std::string, std::uint64_t> named;
        for (std::size_t i = 0; i < names.size(); ++i)
            if (counts_[i] > 0) named[names[i]] = counts_[i];
        return named;
    }

private:
    std::size_t pixels_;
    std::vector<bool> marked_;  ///< none while there are none
    std::array<std::uint64_t, static_cast<std::size_t>(Uncertainty::Count)> counts_{};
};

}  // namespace tetralux::projection
