// SPDX-License-Identifier: Apache-2.0
/// \file
/// Small surfaces of known volume, and files of them, for the tests of the mesher.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <apps/mesher/geometry.h>

namespace tetralux::tests {

using mesher::Triangle;
using mesher::TriangleSurface;

/// The unit cube from `low`, outward:
///
///        6-------7         corner i has x = i & 1, y = i >> 1 & 1, z = i >> 2
///       /|      /|         triangles 0, 1: the face z = 0
///      4-------5 |
///      | 2-----|-3
///      |/      |/
///      0-------1
inline TriangleSurface cube(const glm::dvec3& low = glm::dvec3(0.0), double size = 1.0) {
    TriangleSurface s;
    for (int i = 0; i < 8; ++i) s.points.push_back(low + size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2));
    s.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return s;
}

/// An octahedron, every triangle split into four `levels` times, its points on the sphere: closed, outward.
inline TriangleSurface sphere(const glm::dvec3& centre, double radius, int levels) {
    TriangleSurface s;
    s.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    s.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, isNew] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(s.points.size()));
            if (isNew) s.points.push_back(glm::normalize(s.points[a] + s.points[b]));
            return at->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : s.triangles) {
            const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        s.triangles = std::move(finer);
    }
    for (glm::dvec3& p : s.points) p = centre + radius * p;
    return s;
}

inline void turn(TriangleSurface& s) {
    for (Triangle& t : s.triangles) std::swap(t[1], t[2]);
}

inline TriangleSurface together(const TriangleSurface& a, const TriangleSurface& b) {
    TriangleSurface s = a;
    s.points.insert(s.points.end(), b.points.begin(), b.points.end());
    const auto shift = static_cast<std::uint32_t>(a.points.size());
    for (const Triangle& t : b.triangles) s.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return s;
}

inline std::string offText(const TriangleSurface& s) {
    std::string text = fmt::format("OFF\n{} {} 0\n", s.points.size(), s.triangles.size());
    for (const auto& p : s.points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    for (const auto& t : s.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

inline std::string objText(const TriangleSurface& s) {
    std::string text = "# a comment\no thing\n";
    for (const auto& p : s.points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const auto& t : s.triangles) text += fmt::format("f {}//1 {}//1 {}//1\n", t[0] + 1, t[1] + 1, t[2] + 1);
    return text;
}

/// ASCII PLY of doubles with one vertex property for each of `surface.fields`.
inline std::string plyText(const TriangleSurface& s) {
    std::string text = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
        s.points.size());
    for (const auto& field : s.fields) text += fmt::format("property double {}\n", field.name);
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", s.triangles.size());
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        text += fmt::format("{} {} {}", s.points[i].x, s.points[i].y, s.points[i].z);
        for (const auto& field : s.fields) text += fmt::format(" {}", field.values[i]);
        text += '\n';
    }
    for (const auto& t : s.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

/// Binary STL: floats, and every point as often as triangles use it.
inline std::string stlBytes(const TriangleSurface& s) {
    std::string bytes(80, ' ');
    const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    add(static_cast<std::uint32_t>(s.triangles.size()));
    for (const auto& t : s.triangles) {
        for (int k = 0; k < 3; ++k) add(0.0f);
        for (const std::uint32_t i : t)
            for (int k = 0; k < 3; ++k) add(static_cast<float>(s.points[i][k]));
        add(std::uint16_t{0});
    }
    return bytes;
}

}  // namespace tetralux::tests
