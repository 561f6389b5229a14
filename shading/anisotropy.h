// SPDX-License-Identifier: Apache-2.0
/// \file
/// In which direction the level set about a vertex extends farthest (Ament & Dachsbacher, "Anisotropic Ambient Volume
/// Shading", IEEE Visualization 2015): what anisotropic lobes stand on.
#pragma once

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <shading/lights.h>

namespace tetralux::shading {

/// Symmetric 3×3: xx, yy, zz, xy, xz, yz.
using Tensor = std::array<double, 6>;

/// Per point v the second moments, about v, of the points x near it whose scalar is nearly the same:
///
///     Σ w·d dᵀ / (r²·Σ w),   d = (I − n nᵀ)(x − v),   |x − v| ≤ r,   |s(x) − s(v)| ≤ ε,   w = (1 − |x − v|²/r²)(1 −
///     (s(x) − s(v))²/ε²)·|∇s|·dV,
///
/// where |∇s|·dV = dA·ds counts the level sets by their area: by volume they would count for more where they lie apart,
/// as towards an ellipsoid's ends. n is the direction of the gradient at v (`gradients`, shading/vertex_gradients.h).
///
/// The paper draws n random samples from the sphere, counts all within ε alike, takes moments about the centroid of
/// their projections, and has the weight fall with the distance in the tangent plane. On a cylinder of more than the
/// ball's radius that finds the direction across the axis: what bends away is seen shortened, so that more of it counts
/// where the ball cuts it off than where the plane's weight has fallen to 0 along the axis. Distances in space and
/// moments about v find the axis at any radius (tests/outside/anisotropy_estimates.py compares both;
/// projection/modes.md has the numbers). And here every cell near v is filled with `settings.samples` points that are
/// the same in every run, and the weight falls to 0 towards ε, since a sharp end takes more than four times as many
/// points for the same accuracy. Four points are those of the quadrature that is exact for quadratics (ratios within
/// 0.002 of those of 64 points on the level sets of the tests). Found in float: within 2e-6 of the same sum in double.
/// The larger eigenvalue in the tangent plane is called λ₂: its direction is that along which the level set extends
/// farther, and λ₂/λ₁ ≥ 1 is 1 where it extends alike. Zero for cell data and where there is no gradient. What the
/// points' number alone may make of a level set without a direction, (λ₂ − λ₁)/(λ₂ + λ₁) ≤ 6·Σw²/(Σw)², is taken out,
/// since γ would blow it up: planes have a ratio of 1.
///
/// Where the mesh's border cuts the level set off, the sums are completed to what they would be if the mesh went on
/// (shading/cut_disc.h): as they stand, a plane near a face of the mesh would have a ratio of 1.45, near an edge of 4,
/// and a cylinder near its end the direction across it. On spheres that come near faces, edges and corners ratios stay
/// below 1.1; cylinders that end at a face keep their ratio within 5 % and, but for the points of the border, whose
/// gradients are one-sided, their direction within 1°. Where an edge of the mesh lets less than half a disc be seen,
/// what is not seen is taken to be round.
std::vector<Tensor> levelSetTensors(const mesh::ScalarMesh& mesh, const std::vector<glm::dvec3>& gradients,
                                    const AnisotropySettings& settings);

/// Eigenvalues λ₁ ≤ λ₂ of a tensor in the plane across `normal`, and λ₂'s direction.
struct Anisotropy {
    double minor, major;
    glm::dvec3 direction;
};
Anisotropy anisotropyAcross(const Tensor& tensor, const glm::dvec3& normal);

}  // namespace tetralux::shading
