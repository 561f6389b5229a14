// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/eye_contact.h>

#include <algorithm>
#include <array>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// Of a cell's size, and of the mesh's where positions are that coarse: how far from a face the eye may stand.
constexpr double touching = 1e-5, ofMesh = 1e-12;

using FaceKey = std::array<mesh::PointIndex, 3>;

/// The cells about the eye, and the faces that it touches, each once for either side.
class Contacts {
public:
    Contacts(const mesh::ScalarMesh& mesh, const glm::dvec3& eye)
        : mesh_(mesh), eye_(eye), least_(ofMesh * mesh.bounds.diagonal()) {}

    void meet(mesh::CellIndex cell) {
        std::array<glm::dvec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = mesh_.positions[mesh_.cells[cell][k]];
        const glm::dvec3 low = glm::min(glm::min(p[0], p[1]), glm::min(p[2], p[3])),
                         high = glm::max(glm::max(p[0], p[1]), glm::max(p[2], p[3]));
        const double near = touching * glm::length(high - low) + least_;
        if (glm::any(glm::lessThan(eye_, low - near)) || glm::any(glm::greaterThan(eye_, high + near))) return;
        std::array<bool, 4> touched{};
        for (std::size_t k = 0; k < 4; ++k) {
            const auto corner = [&](std::size_t i) { return p[static_cast<std::size_t>(mesh::faceVertices[k][i])]; };
            const glm::dvec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
            const double size = glm::length(normal);
            const double outside = size > 0 ? glm::dot(normal, eye_ - corner(0)) / size : 0.0;  // faces turn outwards
            if (outside > near) return;
            touched[k] = outside > -near;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            if (!touched[k]) continue;
            FaceKey key;
            for (std::size_t i = 0; i < 3; ++i)
                key[i] = mesh_.cells[cell][static_cast<std::size_t>(mesh::faceVertices[k][i])];
            std::sort(key.begin(), key.end());
            ++sides_[key];
        }
        if (std::any_of(touched.begin(), touched.end(), [](bool one) { return one; })) contact_.cells.push_back(cell);
    }

    EyeContact found() {
        contact_.onBoundary =
            std::any_of(sides_.begin(), sides_.end(), [](const auto& face) { return face.second == 1; });
        return std::move(contact_);
    }

private:
    const mesh::ScalarMesh& mesh_;
    const glm::dvec3 eye_;
    const double least_;
    EyeContact contact_;
    std::map<FaceKey, int> sides_;
};

}  // namespace

EyeContact eyeContact(const mesh::ScalarMesh& mesh, const glm::dvec3& eye) {
    const double near = touching * mesh.bounds.diagonal();
    if (glm::any(glm::lessThan(eye, mesh.bounds.low - near)) ||
        glm::any(glm::greaterThan(eye, mesh.bounds.high + near)))
        return {};
    Contacts contacts(mesh, eye);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) contacts.meet(static_cast<mesh::CellIndex>(cell));
    return contacts.found();
}

}  // namespace tetralux::projection
