// SPDX-License-Identifier: Apache-2.0
#include "carry_field.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <stdexcept>

#include "surface_locator_vtk.h"
#include "tet_assembly.h"

namespace tetralux::mesher {
namespace {

constexpr int isKnown = -1;  // in place of the number of an unknown

/// Which points have a value from the surface, and which number the others have among the unknowns.
struct Unknowns {
    std::vector<int> number;  // per point; `known` if its value is given
    int count = 0;
};

/// The stiffness matrix of linear elements: ∫∇φi·∇φj over a cell of volume V, with the inward face normals n_i
/// (as long as twice the face's area): ∇φi = n_i / (6V), so the entry is n_i·n_j / (36 V).
void assembleLaplace(const mesh::TetMesh& mesh, const Unknowns& unknowns, Eigen::SparseMatrix<double>& inner,
                     Eigen::SparseMatrix<double>& outer) {
    std::vector<Eigen::Triplet<double>> innerEntries, outerEntries;
    for (const auto& cell : mesh.cells) {
        std::array<glm::dvec3, 4> normal;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& face = mesh::faceVertices[k];
            const auto at = [&](int j) {
                return mesh.positions[cell[static_cast<std::size_t>(face[static_cast<std::size_t>(j)])]];
            };
            normal[k] = -glm::cross(at(1) - at(0), at(2) - at(0));
        }
        const double six = mesh::sixVolumes(mesh.positions[cell[0]], mesh.positions[cell[1]], mesh.positions[cell[2]],
                                            mesh.positions[cell[3]]);
        for (std::size_t i = 0; i < 4; ++i) {
            const int row = unknowns.number[cell[i]];
            if (row == isKnown) continue;
            for (std::size_t j = 0; j < 4; ++j) {
                const double entry = glm::dot(normal[i], normal[j]) / (6.0 * six);
                const int column = unknowns.number[cell[j]];
                if (column == isKnown)
                    outerEntries.emplace_back(row, static_cast<int>(cell[j]), entry);
                else
                    innerEntries.emplace_back(row, column, entry);
            }
        }
    }
    inner.resize(unknowns.count, unknowns.count);
    inner.setFromTriplets(innerEntries.begin(), innerEntries.end());
    outer.resize(unknowns.count, static_cast<int>(mesh.positions.size()));
    outer.setFromTriplets(outerEntries.begin(), outerEntries.end());
}

/// Solves for the unknown values of every component; `values` has components × points, the known ones filled in.
void solveLaplace(const mesh::TetMesh& mesh, const Unknowns& unknowns, std::vector<mesh::Field>& fields) {
    Eigen::SparseMatrix<double> inner, outer;
    assembleLaplace(mesh, unknowns, inner, outer);
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                             Eigen::IncompleteCholesky<double>>
        solver;
    solver.setTolerance(1e-12);
    solver.setMaxIterations(10000);
    solver.compute(inner);
    if (solver.info() != Eigen::Success)
        throw std::runtime_error("the field cannot be carried inward: Laplace's equation has no solution here");
    const auto points = static_cast<Eigen::Index>(mesh.positions.size());
    for (mesh::Field& field : fields)
        for (int k = 0; k < field.components; ++k) {
            Eigen::VectorXd known = Eigen::VectorXd::Zero(points);
            double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
            for (Eigen::Index i = 0; i < points; ++i) {
                if (unknowns.number[static_cast<std::size_t>(i)] != isKnown) continue;
                known[i] = field.values[static_cast<std::size_t>(i * field.components + k)];
                low = std::min(low, known[i]);
                high = std::max(high, known[i]);
            }
            const double middle =
                0.5 * low + 0.5 * high;  // the solver's tolerance is relative: keep offsets away from it
            const bool finite = std::isfinite(high - low);
            known.array() -= finite ? middle : 0.0;
            const Eigen::VectorXd solution = solver.solve(-(outer * known));
            for (Eigen::Index i = 0; i < points; ++i) {
                const int row = unknowns.number[static_cast<std::size_t>(i)];
                if (row == isKnown) continue;
                const double value = solution[row] + middle;
                // Obtuse cells can push a value out of the range by a little; a NaN on the surface spreads: it stays
                // NaN
                field.values[static_cast<std::size_t>(i * field.components + k)] =
                    finite && std::isfinite(value) ? std::clamp(value, low, high)
                                                   : std::numeric_limits<double>::quiet_NaN();
            }
        }
}

double blend(const mesh::Field& field, const Triangle& t, const std::array<double, 3>& weights, int component) {
    double value = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        if (weights[c] != 0.0)  // so that a NaN far corner does not spoil a point that sits on another one
            value +=
                weights[c] *
                field.values[t[c] * static_cast<std::size_t>(field.components) + static_cast<std::size_t>(component)];
    return value;
}

}  // namespace

std::vector<mesh::Field> carryFields(const TriangleSurface& given, const mesh::TetMesh& mesh,
                                     const std::vector<std::uint32_t>& source, bool sameNumbering) {
    std::vector<mesh::Field> fields;
    if (given.fields.empty()) return fields;
    std::vector<bool> onBoundary(mesh.positions.size(), false);
    for (const Triangle& t : boundaryOf(mesh).triangles)
        for (const std::uint32_t i : t) onBoundary[i] = true;
    for (const mesh::Field& field : given.fields)
        fields.push_back(
            {field.name, field.association, field.components,
             std::vector<double>(mesh.positions.size() * static_cast<std::size_t>(field.components), 0.0)});
    std::optional<SurfaceLocator> locator;
    Unknowns unknowns{std::vector<int>(mesh.positions.size(), isKnown), 0};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool isGiven = sameNumbering && source[i] < given.points.size();
        if (!isGiven && !onBoundary[i]) {
            unknowns.number[i] = unknowns.count++;
            continue;
        }
        SurfaceLocator::Nearest nearest;
        if (!isGiven) {
            if (!locator) locator.emplace(given);
            nearest = locator->nearest(mesh.positions[i]);
        }
        for (std::size_t f = 0; f < fields.size(); ++f) {
            const auto n = static_cast<std::size_t>(fields[f].components);
            for (std::size_t k = 0; k < n; ++k)
                fields[f].values[i * n + k] = isGiven ? given.fields[f].values[source[i] * n + k]
                                                      : blend(given.fields[f], given.triangles[nearest.triangle],
                                                              nearest.weights, static_cast<int>(k));
        }
    }
    if (unknowns.count > 0) solveLaplace(mesh, unknowns, fields);
    return fields;
}

}  // namespace tetralux::mesher
