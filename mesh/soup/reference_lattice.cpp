// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/reference_lattice.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <map>

namespace tetralux::mesh {
namespace {

/// Collects lattice points by their integer place and cells over them.
class Builder {
public:
    Builder(Shape shape, int segments) : shape_(shape), n_(segments) {}

    int point(int i, int j, int k) {
        const auto [place, isNew] = numbers_.try_emplace({i, j, k}, static_cast<int>(lattice_.points.size()));
        if (isNew) {
            const std::array<double, 3> parameter = parameterOf(i, j, k);
            lattice_.points.push_back(parameter);
            lattice_.cornerWeights.push_back(cornerWeights(shape_, parameter));
        }
        return place->second;
    }

    void cell(std::uint8_t type, std::initializer_list<int> points) {
        ReferenceLattice::SubCell cell{type, {}, static_cast<int>(points.size())};
        std::copy(points.begin(), points.end(), cell.points.begin());
        lattice_.cells.push_back(cell);
    }

    ReferenceLattice take() { return std::move(lattice_); }

private:
    /// In a pyramid the layer at height k has n − k pieces along each side, and VTK's r and s run over each layer.
    std::array<double, 3> parameterOf(int i, int j, int k) const {
        const double across = shape_ == Shape::Pyramid ? std::max(1, n_ - k) : n_;
        return {i / across, j / across, static_cast<double>(k) / n_};
    }

    Shape shape_;
    int n_;
    ReferenceLattice lattice_;
    std::map<std::array<int, 3>, int> numbers_;
};

/// Freudenthal's simplices of the cubes that lie in n ≥ x ≥ y ≥ z ≥ 0, which is the tetrahedron with i = x − y,
/// j = y − z, k = z.
void cutTetrahedron(Builder& build, int n) {
    std::array<int, 3> axes{0, 1, 2};
    const auto inside = [n](const std::array<int, 3>& c) { return c[0] <= n && c[0] >= c[1] && c[1] >= c[2]; };
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y <= x; ++y) {
            for (int z = 0; z <= y; ++z) {
                std::sort(axes.begin(), axes.end());
                do {
                    std::array<int, 3> corner{x, y, z};
                    std::array<int, 4> ids{};
                    bool whole = true;
                    for (std::size_t step = 0; step < 4 && whole; ++step) {
                        if (step > 0) {
                            ++corner[static_cast<std::size_t>(axes[step - 1])];
                        }
                        whole = inside(corner);
                        ids[step] = whole ? build.point(corner[0] - corner[1], corner[1] - corner[2], corner[2]) : -1;
                    }
                    if (whole) {
                        const bool even = (axes[0] + 1) % 3 == axes[1];
                        build.cell(cell_type::tetrahedron, {ids[0], ids[1], ids[even ? 2 : 3], ids[even ? 3 : 2]});
                    }
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
        }
    }
}

void cutHexahedron(Builder& build, int n) {
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                build.cell(cell_type::hexahedron,
                           {build.point(i, j, k), build.point(i + 1, j, k), build.point(i + 1, j + 1, k),
                            build.point(i, j + 1, k), build.point(i, j, k + 1), build.point(i + 1, j, k + 1),
                            build.point(i + 1, j + 1, k + 1), build.point(i, j + 1, k + 1)});
            }
        }
    }
}

void cutWedge(Builder& build, int n) {
    const auto prism = [&](std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c, int k) {
        build.cell(cell_type::wedge,
                   {build.point(a[0], a[1], k), build.point(b[0], b[1], k), build.point(c[0], c[1], k),
                    build.point(a[0], a[1], k + 1), build.point(b[0], b[1], k + 1), build.point(c[0], c[1], k + 1)});
    };
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i + j < n; ++i) {
                prism({i, j}, {i + 1, j}, {i, j + 1}, k);
                if (i + j + 1 < n) {
                    prism({i + 1, j}, {i + 1, j + 1}, {i, j + 1}, k);
                }
            }
        }
    }
}

void cutPyramid(Builder& build, int n) {
    const auto upright = [&](int i, int j, int k) {
        build.cell(cell_type::pyramid, {build.point(i, j, k), build.point(i + 1, j, k), build.point(i + 1, j + 1, k),
                                        build.point(i, j + 1, k), build.point(i, j, k + 1)});
    };
    const auto inverted = [&](int i, int j, int k) {
        build.cell(cell_type::pyramid, {build.point(i, j, k), build.point(i, j + 1, k), build.point(i + 1, j + 1, k),
                                        build.point(i + 1, j, k), build.point(i + 1, j + 1, k - 1)});
    };
    for (int k = 0; k < n; ++k) {
        const int side = n - k;
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                upright(i, j, k);
                if (i + 1 < side && j + 1 < side) {
                    inverted(i, j, k + 1);
                }
                // Between two upright neighbours lies a tetrahedron: their common edge and the edge of their tips.
                if (i + 1 < side) {
                    build.cell(cell_type::tetrahedron, {build.point(i + 1, j, k), build.point(i + 1, j + 1, k),
                                                        build.point(i, j, k + 1), build.point(i + 1, j, k + 1)});
                }
                if (j + 1 < side) {
                    build.cell(cell_type::tetrahedron, {build.point(i + 1, j + 1, k), build.point(i, j + 1, k),
                                                        build.point(i, j, k + 1), build.point(i, j + 1, k + 1)});
                }
            }
        }
    }
}

}  // namespace

std::vector<double> cornerWeights(Shape shape, const std::array<double, 3>& place) {
    const auto [r, s, t] = place;
    switch (shape) {
        case Shape::Tet:
            return {1 - r - s - t, r, s, t};
        case Shape::Wedge:
            return {(1 - r - s) * (1 - t), r * (1 - t), s * (1 - t), (1 - r - s) * t, r * t, s * t};
        case Shape::Pyramid:
            return {(1 - r) * (1 - s) * (1 - t), r * (1 - s) * (1 - t), r * s * (1 - t), (1 - r) * s * (1 - t), t};
        default:
            return {(1 - r) * (1 - s) * (1 - t), r * (1 - s) * (1 - t), r * s * (1 - t), (1 - r) * s * (1 - t),
                    (1 - r) * (1 - s) * t,       r * (1 - s) * t,       r * s * t,       (1 - r) * s * t};
    }
}

ReferenceLattice referenceLattice(Shape shape, int segments) {
    Builder build(shape, segments);
    switch (shape) {
        case Shape::Tet:
            cutTetrahedron(build, segments);
            break;
        case Shape::Hexahedron:
            cutHexahedron(build, segments);
            break;
        case Shape::Wedge:
            cutWedge(build, segments);
            break;
        case Shape::Pyramid:
            cutPyramid(build, segments);
            break;
        case Shape::None:
            break;
    }
    return build.take();
}

}  // namespace tetralux::mesh
