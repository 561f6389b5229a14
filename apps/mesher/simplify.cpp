// SPDX-License-Identifier: Apache-2.0
#include "simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <queue>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tet_assembly.h"

namespace tetralux::mesher {
namespace {

using mesh::CellIndex;
using mesh::PointIndex;
using mesh::Tetrahedron;

constexpr double goodEnough = 0.05;        // shape from which on cells may get worse freely; 1 is regular
constexpr double leastTolerance = 1e-9;    // part of the diagonal: what counts as flat
constexpr double leastNormalCosine = 0.5;  // surface triangles turn by 60° at most

/// √2·6V / (longest edge)³: 1 for a regular tetrahedron, 0 for a flat one, negative for an inverted one.
double shape(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto squared = [](const glm::dvec3& e) { return glm::dot(e, e); };
    const double longest =
        std::max({squared(b - a), squared(c - a), squared(d - a), squared(c - b), squared(d - c), squared(d - b)});
    return std::numbers::sqrt2 * mesh::sixVolumes(a, b, c, d) / (longest * std::sqrt(longest));
}

double distanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double nn = glm::dot(n, n);
    if (nn > 0.0) {
        const double u = glm::dot(glm::cross(c - b, p - b), n), v = glm::dot(glm::cross(a - c, p - c), n),
                     w = glm::dot(glm::cross(b - a, p - a), n);
        if (u >= 0.0 && v >= 0.0 && w >= 0.0) return std::abs(glm::dot(p - a, n)) / std::sqrt(nn);
    }
    const auto toSegment = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 e = to - from;
        const double ee = glm::dot(e, e);
        const double t = ee > 0.0 ? std::clamp(glm::dot(p - from, e) / ee, 0.0, 1.0) : 0.0;
        return glm::length(p - (from + t * e));
    };
    return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

class Simplifier {
public:
    Simplifier(mesh::TetMesh& mesh, const SimplifyOptions& options)
        : mesh_(mesh), options_(options), cells_(mesh.cells) {
        const mesh::BoundingBox box = mesh::usedBounds(mesh.positions, mesh.cells);
        diagonal_ = glm::length(box.high - box.low);
        tolerance_ = std::max(options.surfaceTolerance, leastTolerance) * diagonal_;
        collectValues();
        const std::size_t points = mesh.positions.size();
        cellsOf_.resize(points);
        for (CellIndex c = 0; c < cells_.size(); ++c)
            for (const PointIndex i : cells_[c]) cellsOf_[i].push_back(c);
        onSurface_.resize(points, false);
        for (const Triangle& t : boundaryOf(mesh).triangles)
            for (const std::uint32_t i : t) onSurface_[i] = true;
        guests_.resize(cells_.size());
        error_.resize(points, 0.0);
        deviation_.resize(points, 0.0);
        dirty_.resize(points, false);
        parked_.resize(points, true);
        alive_ = cells_.size();
    }

    SimplifyReport run() {
        SimplifyReport report;
        report.cellsBefore = cells_.size();
        for (PointIndex u = 0; u < cellsOf_.size(); ++u)
            if (!cellsOf_[u].empty()) push(u);
        report.stopReason = "no further collapse keeps the cells, the surface and the field within their bounds";
        std::uint64_t steps = 0;
        while (!queue_.empty()) {
            if (alive_ <= options_.targetCells) {
                report.stopReason = "the target is reached";
                break;
            }
            if (++steps % 1024 == 0 && options_.deadline &&
                std::chrono::steady_clock::now() >= *options_.deadline - std::chrono::seconds(5)) {
                report.stopReason = "the time limit came first";
                break;
            }
            const auto [key, u] = queue_.top();
            queue_.pop();
            if (cellsOf_[u].empty() || parked_[u]) continue;
            if (dirty_[u]) {
                push(u);
                continue;
            }
            tryCollapse(u, key);
        }
        finish(report);
        return report;
    }

private:
    struct Candidate {
        double key;  // rough: the error that u alone gets
        PointIndex onto;
        friend bool operator<(const Candidate& a, const Candidate& b) { return a.key < b.key; }
    };
    /// What a collapse would make of the star of u.
    struct Outcome {
        std::vector<CellIndex> kept;                             // cells that stay, with u replaced
        std::vector<Tetrahedron> renewed;                        // they, so replaced
        std::vector<Triangle> surface;                           // new surface triangles (u on the surface)
        std::vector<std::pair<PointIndex, std::size_t>> placed;  // points that went → place in `kept`
        std::vector<double> errors, deviations;                  // of these points
        double worst = 0.0;                                      // largest error
    };

    /// All components of all point fields, each divided by its range, point by point.
    void collectValues() {
        for (const mesh::Field& field : mesh_.fields) {
            if (field.association == mesh::Association::Cell)
                throw std::runtime_error("coarsening needs values on points: field '" + field.name +
                                         "' is on cells; average it to points first");
            components_ += static_cast<std::size_t>(field.components);
        }
        if (components_ == 0) throw std::runtime_error("coarsening needs a field on points: give one with --field");
        values_.resize(mesh_.positions.size() * components_);
        std::size_t at = 0;
        for (const mesh::Field& field : mesh_.fields)
            for (std::size_t k = 0; k < static_cast<std::size_t>(field.components); ++k, ++at) {
                double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
                const auto n = static_cast<std::size_t>(field.components);
                for (std::size_t i = 0; i < mesh_.positions.size(); ++i)
                    if (std::isfinite(field.values[i * n + k])) {
                        low = std::min(low, field.values[i * n + k]);
                        high = std::max(high, field.values[i * n + k]);
                    }
                const double scale = high > low ? 1.0 / (high - low) : 0.0;
                for (std::size_t i = 0; i < mesh_.positions.size(); ++i)
                    values_[i * components_ + at] = (field.values[i * n + k] - low) * scale;
            }
    }

    const glm::dvec3& at(PointIndex i) const { return mesh_.positions[i]; }

    /// Barycentric coordinates of p; the smallest tells how far outside it lies.
    std::array<double, 4> weights(const Tetrahedron& t, const glm::dvec3& p) const {
        const glm::dvec3 &a = at(t[0]), &b = at(t[1]), &c = at(t[2]), &d = at(t[3]);
        const double six = mesh::sixVolumes(a, b, c, d);
        return {mesh::sixVolumes(p, b, c, d) / six, mesh::sixVolumes(a, p, c, d) / six,
                mesh::sixVolumes(a, b, p, d) / six, mesh::sixVolumes(a, b, c, p) / six};
    }

    double fieldError(const Tetrahedron& t, const std::array<double, 4>& w, PointIndex p) const {
        double worst = 0.0;
        for (std::size_t k = 0; k < components_; ++k) {
            double value = 0.0;
            for (std::size_t c = 0; c < 4; ++c) value += w[c] * values_[t[c] * components_ + k];
            const double error = std::abs(value - values_[p * components_ + k]);
            if (!(error <= worst)) worst = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
        }
        return worst;
    }

    /// Where among `cells` p lies (best), and its error there.
    std::pair<std::size_t, double> place(const std::vector<Tetrahedron>& cells, PointIndex p) const {
        std::size_t best = 0;
        double inside = -std::numeric_limits<double>::infinity();
        std::array<double, 4> bestWeights{};
        for (std::size_t i = 0; i < cells.size() && inside < 0.0; ++i) {
            const auto w = weights(cells[i], at(p));
            const double least = *std::min_element(w.begin(), w.end());
            if (least > inside) {
                inside = least;
                best = i;
                bestWeights = w;
            }
        }
        return {best, fieldError(cells[best], bestWeights, p)};
    }

    /// The surface triangles at u, outward, each turned so that u comes first.
    std::vector<Triangle> surfaceFan(PointIndex u) const {
        std::vector<Triangle> faces;
        for (const CellIndex c : cellsOf_[u])
            for (const auto& local : mesh::faceVertices) {
                Triangle f{};
                for (std::size_t k = 0; k < 3; ++k) f[k] = cells_[c][static_cast<std::size_t>(local[k])];
                const auto first = std::find(f.begin(), f.end(), u);
                if (first == f.end()) continue;
                std::rotate(f.begin(), first, f.end());
                // A face between two cells is met twice, the second time the other way round.
                const auto twin = std::find(faces.begin(), faces.end(), Triangle{u, f[2], f[1]});
                if (twin != faces.end())
                    faces.erase(twin);
                else
                    faces.push_back(f);
            }
        return faces;
    }

    /// Whether the fan closes up once around u: where surfaces only touch, nothing is collapsed.
    static bool isOneFan(const std::vector<Triangle>& fan) {
        if (fan.size() < 3) return false;
        PointIndex at = fan[0][2];
        std::size_t seen = 1;
        while (at != fan[0][1]) {
            const auto next = std::find_if(fan.begin(), fan.end(), [&](const Triangle& f) { return f[1] == at; });
            if (next == fan.end() || ++seen > fan.size()) return false;
            at = (*next)[2];
        }
        return seen == fan.size();
    }

    /// Puts v in u's place within the surface; nothing if that moves or folds it too much.
    bool renewSurface(const std::vector<Triangle>& fan, PointIndex u, PointIndex v, Outcome& outcome) const {
        bool neighbours = false;
        for (const Triangle& f : fan) {
            if (f[1] == v || f[2] == v) {
                neighbours = true;
                continue;
            }
            const glm::dvec3 before = glm::cross(at(f[1]) - at(u), at(f[2]) - at(u)),
                             after = glm::cross(at(f[1]) - at(v), at(f[2]) - at(v));
            const double lengths = glm::length(before) * glm::length(after);
            if (!(lengths > 0.0) || glm::dot(before, after) < leastNormalCosine * lengths) return false;
            outcome.surface.push_back({v, f[1], f[2]});
        }
        return neighbours && deviationOf(u, outcome.surface) <= tolerance_;
    }

    /// The surface triangles opposite u among its cells: they stay whatever becomes of u.
    std::vector<Triangle> surfaceOpposite(PointIndex u) const {
        std::vector<Triangle> faces;
        for (const CellIndex c : cellsOf_[u]) {
            Triangle f{};
            std::copy_if(cells_[c].begin(), cells_[c].end(), f.begin(), [&](PointIndex i) { return i != u; });
            if (!onSurface_[f[0]] || !onSurface_[f[1]] || !onSurface_[f[2]]) continue;
            const auto shared = std::count_if(cellsOf_[f[0]].begin(), cellsOf_[f[0]].end(), [&](CellIndex other) {
                const Tetrahedron& t = cells_[other];
                return std::find(t.begin(), t.end(), f[1]) != t.end() && std::find(t.begin(), t.end(), f[2]) != t.end();
            });
            if (shared == 1) faces.push_back(f);
        }
        return faces;
    }

    double deviationOf(PointIndex p, const std::vector<Triangle>& surface) const {
        double least = std::numeric_limits<double>::infinity();
        for (const Triangle& t : surface)
            least = std::min(least, distanceToTriangle(at(p), at(t[0]), at(t[1]), at(t[2])));
        return least;
    }

    /// The cells after pulling u onto v; nothing where one would be flat, inverted or misshapen.
    std::optional<Outcome> reshape(PointIndex u, PointIndex v, const std::vector<Triangle>& fan,
                                   double worstBefore) const {
        Outcome outcome;
        if (onSurface_[u] && (!onSurface_[v] || !renewSurface(fan, u, v, outcome))) return std::nullopt;
        const double floor = std::min(goodEnough, worstBefore);
        for (const CellIndex c : cellsOf_[u]) {
            Tetrahedron t = cells_[c];
            if (std::find(t.begin(), t.end(), v) != t.end()) continue;
            std::replace(t.begin(), t.end(), u, v);
            if (!(shape(at(t[0]), at(t[1]), at(t[2]), at(t[3])) > std::max(0.0, 0.999 * floor))) return std::nullopt;
            outcome.kept.push_back(c);
            outcome.renewed.push_back(t);
        }
        if (outcome.kept.empty()) return std::nullopt;
        return outcome;
    }

    double worstShape(PointIndex u) const {
        double worst = 1.0;
        for (const CellIndex c : cellsOf_[u]) {
            const Tetrahedron& t = cells_[c];
            worst = std::min(worst, shape(at(t[0]), at(t[1]), at(t[2]), at(t[3])));
        }
        return worst;
    }

    /// Finds the new cells of u and of all points that went before; false if one errs or deviates beyond the bounds.
    bool placeAll(PointIndex u, Outcome& outcome) const {
        std::vector<Triangle> surface = outcome.surface;
        if (onSurface_[u]) {
            const auto opposite = surfaceOpposite(u);
            surface.insert(surface.end(), opposite.begin(), opposite.end());
        }
        const auto take = [&](PointIndex p) {
            const auto [cell, error] = place(outcome.renewed, p);
            const double deviation = onSurface_[p] && onSurface_[u] ? deviationOf(p, surface) : deviation_[p];
            outcome.placed.emplace_back(p, cell);
            outcome.errors.push_back(error);
            outcome.deviations.push_back(deviation);
            outcome.worst = std::max(outcome.worst, error);
            return error <= options_.maxFieldError && deviation <= tolerance_;
        };
        if (!take(u)) return false;
        for (const CellIndex c : cellsOf_[u])
            for (const PointIndex p : guests_[c])
                if (!take(p)) return false;
        return true;
    }

    std::vector<PointIndex> neighboursOf(PointIndex u) const {
        std::vector<PointIndex> neighbours;
        for (const CellIndex c : cellsOf_[u])
            for (const PointIndex i : cells_[c])
                if (i != u) neighbours.push_back(i);
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
        return neighbours;
    }

    std::vector<Candidate> candidates(PointIndex u) const {
        std::vector<Candidate> found;
        const std::vector<Triangle> fan = onSurface_[u] ? surfaceFan(u) : std::vector<Triangle>{};
        if (onSurface_[u] && !isOneFan(fan)) return found;
        const double worst = worstShape(u);
        for (const PointIndex v : neighboursOf(u)) {
            const auto outcome = reshape(u, v, fan, worst);
            if (!outcome) continue;
            const double error = place(outcome->renewed, u).second;
            if (error > options_.maxFieldError) continue;
            found.push_back({error + lengthWeight * glm::length(at(u) - at(v)) / diagonal_, v});
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    /// (Re)enters u with its best rough key; parks it when nothing is possible.
    void push(PointIndex u) {
        dirty_[u] = false;
        const auto found = candidates(u);
        parked_[u] = found.empty();
        if (!found.empty()) queue_.emplace(found.front().key, u);
    }

    void tryCollapse(PointIndex u, double key) {
        const std::vector<Triangle> fan = onSurface_[u] ? surfaceFan(u) : std::vector<Triangle>{};
        const double worst = worstShape(u);
        std::optional<Outcome> best;
        PointIndex onto = 0;
        std::size_t tried = 0;
        for (const Candidate& candidate : candidates(u)) {
            auto outcome = reshape(u, candidate.onto, fan, worst);
            if (!outcome || !placeAll(u, *outcome)) continue;
            if (!best || outcome->worst < best->worst) {
                best = std::move(outcome);
                onto = candidate.onto;
            }
            if (++tried == 4) break;
        }
        if (!best) {
            parked_[u] = true;
            return;
        }
        const double full = best->worst + lengthWeight * glm::length(at(u) - at(onto)) / diagonal_;
        if (full > 1.01 * key && !queue_.empty() && full > queue_.top().first) {
            queue_.emplace(full, u);  // the points that went before make it dearer than it looked: others first
            return;
        }
        commit(u, onto, *best);
    }

    void commit(PointIndex u, PointIndex v, const Outcome& outcome) {
        const std::vector<PointIndex> around = neighboursOf(u);
        const std::vector<CellIndex> star = cellsOf_[u];
        for (const CellIndex c : star) guests_[c].clear();
        for (const CellIndex c : star) {
            if (std::find(outcome.kept.begin(), outcome.kept.end(), c) != outcome.kept.end()) continue;
            for (const PointIndex i : cells_[c])
                if (i != u) std::erase(cellsOf_[i], c);
            cells_[c] = {0, 0, 0, 0};
            --alive_;
        }
        for (std::size_t k = 0; k < outcome.kept.size(); ++k) {
            cells_[outcome.kept[k]] = outcome.renewed[k];
            cellsOf_[v].push_back(outcome.kept[k]);
        }
        for (std::size_t k = 0; k < outcome.placed.size(); ++k) {
            const auto [p, cell] = outcome.placed[k];
            guests_[outcome.kept[cell]].push_back(p);
            error_[p] = outcome.errors[k];
            deviation_[p] = outcome.deviations[k];
        }
        cellsOf_[u].clear();
        for (const PointIndex i : around) {
            if (parked_[i]) {
                parked_[i] = false;
                queue_.emplace(0.0, i);  // its key is found when it comes up
            }
            dirty_[i] = true;
        }
    }

    /// Brings cells and points together again and sums up the errors.
    void finish(SimplifyReport& report) {
        double sum = 0.0;
        for (std::size_t p = 0; p < error_.size(); ++p) {
            report.maxError = std::max(report.maxError, error_[p]);
            report.surfaceDeviation = std::max(report.surfaceDeviation, deviation_[p]);
            sum += error_[p] * error_[p];
        }
        report.rmsError = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(error_.size(), 1)));
        RawTetrahedra raw;
        raw.points = mesh_.positions;
        for (const Tetrahedron& t : cells_)
            if (t[0] != t[1]) raw.cells.push_back(t);
        Assembly assembly = assemble(raw);
        for (mesh::Field& field : mesh_.fields) {
            mesh::Field taken{field.name, field.association, field.components, {}};
            const auto n = static_cast<std::size_t>(field.components);
            for (const std::uint32_t i : assembly.source)
                for (std::size_t k = 0; k < n; ++k) taken.values.push_back(field.values[i * n + k]);
            assembly.mesh.fields.push_back(std::move(taken));
        }
        mesh_ = std::move(assembly.mesh);
    }

    static constexpr double lengthWeight = 1e-6;  // among equal errors, short edges first

    mesh::TetMesh& mesh_;
    const SimplifyOptions& options_;
    std::vector<Tetrahedron> cells_;           // {0, 0, 0, 0} once gone
    double diagonal_ = 0.0, tolerance_ = 0.0;  // mesh units
    std::size_t components_ = 0;
    std::vector<double> values_;  // components_ per point, each in parts of its range
    std::vector<std::vector<CellIndex>> cellsOf_;
    std::vector<bool> onSurface_, dirty_, parked_;
    std::vector<std::vector<PointIndex>> guests_;  // per cell: the points that went and lie in it
    std::vector<double> error_, deviation_;        // per point that went
    std::uint64_t alive_ = 0;
    using Entry = std::pair<double, PointIndex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

SimplifyReport simplify(mesh::TetMesh& mesh, const SimplifyOptions& options) {
    return Simplifier(mesh, options).run();
}

}  // namespace tetralux::mesher
