// SPDX-License-Identifier: Apache-2.0
/// \file
/// Level of detail: fewer tetrahedra with nearly the same field, by half-edge collapses.
///
/// After Cignoni, Costanza, Montani, Rocchini and Scopigno, "Simplification of tetrahedral meshes with accurate error
/// evaluation" (Visualization 2000): every point that goes is remembered by the cell it comes to lie in, so that the
/// field's error at all points of the fine mesh is known at each step, not estimated. VTK's
/// vtkUnstructuredGridQuadricDecimation gives no such bound and CGAL's tetrahedral remeshing knows no field, which is
/// why this is our own.
///
/// A point u is pulled onto its neighbour v. That is allowed only if
///  - every new cell is positive and not much worse shaped than the worst before: for an inner point the new cells then
///  tile exactly what
///    the old ones filled (they are the cone from v over the faces opposite u);
///  - on the surface: v is a surface neighbour, and every surface triangle of u lies in one plane with v, or, with a
///  surface
///    tolerance, no point that went comes to lie farther than that from the new surface and no normal turns by more
///    than 60°;
///  - no field errs by more than the bound.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <mesh/tet/tet_mesh.h>

#include "child_process.h"

namespace tetralux::mesher {

struct SimplifyOptions {
    std::uint64_t targetCells = 0;  ///< stop at this many
    double maxFieldError =
        std::numeric_limits<double>::infinity();  ///< part of each point field's range, at every point of the fine mesh
    double surfaceTolerance = 0.0;                ///< part of the bounding box' diagonal
    Deadline deadline;                            ///< stops there with what is reached
};

struct SimplifyReport {
    std::uint64_t cellsBefore = 0;
    double maxError = 0.0;          ///< largest over fields and points of the fine mesh, part of the field's range
    double rmsError = 0.0;          ///< the same, root mean square
    double surfaceDeviation = 0.0;  ///< largest distance of a surface point that went from the new surface, mesh units
    std::string stopReason;
};

/// Coarsens `mesh` in place. Point fields go with their points. \throws std::runtime_error when it has cell fields
/// (they would have to be averaged) or no point field.
SimplifyReport simplify(mesh::TetMesh& mesh, const SimplifyOptions& options);

}  // namespace tetralux::mesher
