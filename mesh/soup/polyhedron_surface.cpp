// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/polyhedron_surface.h>

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace tetralux::mesh {
namespace {

struct DirectedEdge {
    std::uint32_t low, high;
    std::uint32_t face;
    bool ascending;  ///< the face runs from low to high
    bool sameEdge(const DirectedEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<DirectedEdge> sortedEdges(const std::vector<std::vector<std::uint32_t>>& faces) {
    std::vector<DirectedEdge> edges;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t i = 0; i < faces[f].size(); ++i) {
            const std::uint32_t a = faces[f][i];
            const std::uint32_t b = faces[f][(i + 1) % faces[f].size()];
            edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(f), a < b});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& x, const DirectedEdge& y) {
        return std::tie(x.low, x.high, x.face) < std::tie(y.low, y.high, y.face);
    });
    return edges;
}

struct Link {
    std::uint32_t other;
    bool agrees;  ///< the faces run along their edge in opposite directions
};

}  // namespace

bool makeFacesAgree(std::vector<std::vector<std::uint32_t>>& faces) {
    const std::vector<DirectedEdge> edges = sortedEdges(faces);
    std::vector<std::vector<Link>> links(faces.size());
    for (std::size_t first = 0; first < edges.size();) {
        std::size_t last = first + 1;
        while (last < edges.size() && edges[last].sameEdge(edges[first])) {
            ++last;
        }
        if ((last - first) % 2 != 0) {
            return false;
        }
        if (last - first == 2) {  // more than two faces at an edge do not say which belong together
            const bool agrees = edges[first].ascending != edges[first + 1].ascending;
            links[edges[first].face].push_back({edges[first + 1].face, agrees});
            links[edges[first + 1].face].push_back({edges[first].face, agrees});
        }
        first = last;
    }
    enum class State : std::uint8_t { Unseen, Kept, Reversed };
    std::vector<State> states(faces.size(), State::Unseen);
    for (std::size_t seed = 0; seed < faces.size(); ++seed) {
        if (states[seed] != State::Unseen) {
            continue;
        }
        states[seed] = State::Kept;
        std::vector<std::size_t> open{seed};
        while (!open.empty()) {
            const std::size_t face = open.back();
            open.pop_back();
            for (const Link& link : links[face]) {
                const bool reversed = (states[face] == State::Reversed) == link.agrees;
                const State wanted = reversed ? State::Reversed : State::Kept;
                if (states[link.other] == State::Unseen) {
                    states[link.other] = wanted;
                    open.push_back(link.other);
                } else if (states[link.other] != wanted) {
                    return false;
                }
            }
        }
    }
    for (std::size_t face = 0; face < faces.size(); ++face) {
        if (states[face] == State::Reversed) {
            std::reverse(faces[face].begin(), faces[face].end());
        }
    }
    return true;
}

}  // namespace tetralux::mesh
