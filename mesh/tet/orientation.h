// SPDX-License-Identifier: Apache-2.0
/// \file
/// On which side of flat a tetrahedron is, with the roundoff of the answer bounded.
#pragma once

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tetralux::mesh {

inline bool isFinitePosition(const glm::dvec3& x) {
    return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
}

/// 1 if det(b − a, c − a, d − a) is certainly positive, −1 if certainly negative, 0 if it is zero, not finite or
/// within the roundoff of its own computation (Shewchuk 1997, bound A of orient3d, widened for three more roundings).
inline int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 u = b - a;
    const glm::dvec3 v = c - a;
    const glm::dvec3 w = d - a;
    const double det = (u.y * v.z - u.z * v.y) * w.x + (u.z * v.x - u.x * v.z) * w.y + (u.x * v.y - u.y * v.x) * w.z;
    const glm::dvec3 p = glm::abs(u);
    const glm::dvec3 q = glm::abs(v);
    const glm::dvec3 r = glm::abs(w);
    const double magnitude =
        (p.y * q.z + p.z * q.y) * r.x + (p.z * q.x + p.x * q.z) * r.y + (p.x * q.y + p.y * q.x) * r.z;
    constexpr double bound = 5.0 * std::numeric_limits<double>::epsilon();  // 10 units of roundoff; Shewchuk needs 7
    if (!(std::abs(det) > bound * magnitude)) {
        return 0;
    }
    return det > 0.0 ? 1 : -1;
}

}  // namespace tetralux::mesh
