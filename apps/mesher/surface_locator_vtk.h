// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "geometry.h"

namespace tetralux::mesher {

/// Where on a surface the point nearest to a given one lies. VTK's static cell locator behind it.
class SurfaceLocator {
public:
    /// `surface` must outlive the locator and have triangles.
    explicit SurfaceLocator(const TriangleSurface& surface);
    ~SurfaceLocator();
    SurfaceLocator(const SurfaceLocator&) = delete;
    SurfaceLocator& operator=(const SurfaceLocator&) = delete;

    struct Nearest {
        std::uint32_t triangle = 0;
        std::array<double, 3> weights{};  ///< of its corners, sum 1, none negative
        double distance = 0.0;            ///< mesh units
    };
    Nearest nearest(const glm::dvec3& p) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace tetralux::mesher
