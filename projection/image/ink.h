// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace tetralux::projection {

/// The colour of what is drawn upon `ground` (display RGB): black upon a bright one, white upon a dark one.
inline glm::dvec3 inkUpon(const glm::dvec3& ground) {
    return glm::dvec3(0.2126 * ground.r + 0.7152 * ground.g + 0.0722 * ground.b > 0.5 ? 0.0 : 1.0);
}

}  // namespace tetralux::projection
