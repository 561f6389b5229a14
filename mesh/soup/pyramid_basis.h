// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace tetralux::mesh {

/// Values of the shape functions of a complete pyramid of order `order`, its points in Gmsh's sequence, at each of
/// `places`: r and s run from 0 to 1 over each layer of height t. Bergot, Cohen, Duruflé: Higher-order finite elements
/// for hybrid meshes using new nodal pyramidal elements, 2010, which are polynomials on faces, as the cells beside it
/// have them.
std::vector<std::vector<double>> pyramidShapeFunctions(int order, const std::vector<std::array<double, 3>>& places);

}  // namespace tetralux::mesh
