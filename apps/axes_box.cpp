// SPDX-License-Identifier: Apache-2.0
#include <apps/axes_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <apps/nice_ticks.h>

namespace tetralux::apps {

namespace {

constexpr int mostTicks = 6;
constexpr double tickSpacing = 30.0;  // pixels, so that numbers do not run into each other

/// An edge along `axis`; `high` tells for the other two axes (in cyclic order) on which side of the box it lies.
struct Edge {
    int axis;
    std::array<bool, 2> high;
    glm::dvec3 from, to;

    int otherAxis(int which) const { return (axis + 1 + which) % 3; }
};

std::vector<Edge> edgesOf(const mesh::BoundingBox& box) {
    std::vector<Edge> edges;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool first : {false, true})
            for (const bool second : {false, true}) {
                Edge edge{axis, {first, second}, box.low, box.high};
                const int a = edge.otherAxis(0), b = edge.otherAxis(1);
                edge.from[a] = edge.to[a] = first ? box.high[a] : box.low[a];
                edge.from[b] = edge.to[b] = second ? box.high[b] : box.low[b];
                edges.push_back(edge);
            }
    return edges;
}

class BoxView {
public:
    BoxView(const mesh::BoundingBox& box, const projection::Camera& camera)
        : box_(box), frame_(projection::cameraFrame(camera)), perPixel_(glm::length(frame_.perPixelRight)) {}

    /// Whether the box's side at the high or low end of `axis` shows its outside.
    bool showsOutside(int axis, bool high) const {
        const double limit = high ? box_.high[axis] : box_.low[axis];
        const double towardsEye = frame_.orthographic ? -frame_.forward[axis] : frame_.eye[axis] - limit;
        return high ? towardsEye > 0 : towardsEye < 0;
    }

    int outsidesShown(const Edge& edge) const {
        return (showsOutside(edge.otherAxis(0), edge.high[0]) ? 1 : 0) +
               (showsOutside(edge.otherAxis(1), edge.high[1]) ? 1 : 0);
    }

    double depth(const glm::dvec3& point) const { return glm::dot(point - frame_.eye, frame_.forward); }
    double nearest() const { return 1e-6 * box_.diagonal(); }

    glm::dvec2 project(const glm::dvec3& point) const {
        const glm::dvec3 p = point - frame_.eye;
        const double scale = perPixel_ * (frame_.orthographic ? 1.0 : glm::dot(p, frame_.forward));
        return glm::dvec2(glm::dot(p, frame_.right), -glm::dot(p, frame_.up)) / scale + frame_.centre + 0.5;
    }

    /// The part before the eye.
    std::optional<BoxLine> line(const Edge& edge) const {
        glm::dvec3 a = edge.from, b = edge.to;
        double depthA = depth(a), depthB = depth(b);
        if (!(std::max(depthA, depthB) > nearest())) return std::nullopt;
        if (depthA < nearest()) a += (nearest() - depthA) / (depthB - depthA) * (b - a);
        if (depthB < nearest()) b += (nearest() - depthB) / (depthA - depthB) * (a - b);
        return BoxLine{project(a), project(b), outsidesShown(edge) == 0};
    }

    /// Whether the edge is part of the box's outline and wholly before the eye.
    bool onOutline(const Edge& edge) const {
        return outsidesShown(edge) == 1 && depth(edge.from) > nearest() && depth(edge.to) > nearest();
    }

    glm::dvec2 outward(const Edge& edge) const {
        const glm::dvec2 a = project(edge.from), b = project(edge.to);
        const glm::dvec2 along = b - a, away = 0.5 * (a + b) - project(box_.centre());
        glm::dvec2 across(-along.y, along.x);
        if (glm::dot(across, away) < 0) across = -across;
        const double length = glm::length(across);
        return length > 0 ? across / length : glm::dvec2(0, 1);
    }

private:
    const mesh::BoundingBox& box_;
    projection::CameraFrame frame_;
    double perPixel_;
};

/// The outline's edge along `axis` whose outer side looks most to the lower left, where scales are looked for.
std::optional<Edge> labelledEdge(const std::vector<Edge>& edges, const BoxView& view, int axis) {
    std::optional<Edge> best;
    double bestRating = 0;
    for (const Edge& edge : edges) {
        if (edge.axis != axis || !view.onOutline(edge)) continue;
        const glm::dvec2 outward = view.outward(edge);
        const double rating = outward.y - 0.7 * outward.x;
        if (!best || rating > bestRating) {
            best = edge;
            bestRating = rating;
        }
    }
    return best;
}

void addLabels(const Edge& edge, const BoxView& view, std::vector<BoxLabel>& labels) {
    const glm::dvec2 outward = view.outward(edge);
    const double low = edge.from[edge.axis], high = edge.to[edge.axis];
    const double length = glm::length(view.project(edge.to) - view.project(edge.from));
    if (length < tickSpacing) return;  // no room
    for (const Tick& tick : niceTicks(low, high, std::clamp(static_cast<int>(length / tickSpacing), 2, mostTicks))) {
        glm::dvec3 point = edge.from;
        point[edge.axis] = std::clamp(tick.value, low, high);
        labels.push_back({view.project(point), outward, tick.label, false});
    }
    labels.push_back({view.project(0.5 * (edge.from + edge.to)), outward, std::string(1, "xyz"[edge.axis]), true});
}

}  // namespace

AxesBox axesBox(const mesh::BoundingBox& bounds, const projection::Camera& camera) {
    const BoxView view(bounds, camera);
    const std::vector<Edge> edges = edgesOf(bounds);
    AxesBox result;
    for (const Edge& edge : edges)
        if (const auto line = view.line(edge)) result.lines.push_back(*line);
    for (int axis = 0; axis < 3; ++axis)
        if (const auto edge = labelledEdge(edges, view, axis)) addLabels(*edge, view, result.labels);
    return result;
}

}  // namespace tetralux::apps
