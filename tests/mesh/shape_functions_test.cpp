// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/shape_functions.h>
#include <vtkGenericCell.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderTetra.h>
#include <vtkHigherOrderWedge.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

namespace tetralux::mesh {
namespace {

using Place = std::array<double, 3>;

struct Kind {
    std::uint8_t type;
    std::size_t points;
};

/// All that have an order.
std::vector<Kind> allKinds() {
    std::vector<Kind> kinds;
    for (int type = 0; type < 256; ++type) {
        for (std::size_t points = 1; points <= 1331; ++points) {
            if (curvedCellOrder(static_cast<std::uint8_t>(type), points)) {
                kinds.push_back({static_cast<std::uint8_t>(type), points});
            }
        }
    }
    return kinds;
}

std::string nameOf(const Kind& kind) {
    return std::string(cellTypeInfo(kind.type).name) + " of " + std::to_string(kind.points) + " points";
}

/// Pyramids of any order come out of a system of equations.
double roundoffOf(const Kind& kind) {
    return kind.type == cell_type::gmshPyramid ? 1e-10 : 1e-13;
}

/// Places within the parametric cell.
std::vector<Place> randomPlaces(Shape shape, std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Place> places;
    while (places.size() < count) {
        const Place p{unit(random), unit(random), unit(random)};
        const double sum = p[0] + p[1] + (shape == Shape::Tet ? p[2] : 0.0);
        if (sum <= 1.0 || (shape != Shape::Tet && shape != Shape::Wedge)) {
            places.push_back(p);
        }
    }
    return places;
}

/// The triquadratic pyramid of VTK is one in its parameters too, with its base at height 1/2.
Place vtkPlace(std::uint8_t type, const Place& p) {
    const auto across = [&](double x) { return 0.5 + (x - 0.5) * (1.0 - p[2]); };
    return type == cell_type::triquadraticPyramid ? Place{across(p[0]), across(p[1]), 0.5 + 0.5 * p[2]} : p;
}

std::vector<double> vtkFunctions(const Kind& kind, const Place& place) {
    vtkNew<vtkGenericCell> generic;
    generic->SetCellType(kind.type);
    vtkCell* const cell = generic->GetRepresentativeCell();
    const vtkIdType count = static_cast<vtkIdType>(kind.points);
    cell->PointIds->SetNumberOfIds(count);
    cell->Points->SetNumberOfPoints(count);
    if (auto* hexahedron = vtkHigherOrderHexahedron::SafeDownCast(cell)) {
        hexahedron->SetUniformOrderFromNumPoints(count);
    } else if (auto* wedge = vtkHigherOrderWedge::SafeDownCast(cell)) {
        wedge->SetUniformOrderFromNumPoints(count);
    } else if (auto* tetra = vtkHigherOrderTetra::SafeDownCast(cell)) {
        tetra->Initialize();
    }
    std::vector<double> weights(kind.points);
    const Place p = vtkPlace(kind.type, place);
    cell->InterpolateFunctions(p.data(), weights.data());
    return weights;
}

TEST(ShapeFunctions, AreThoseOfVtk) {
    const std::vector<Kind> kinds = allKinds();
    EXPECT_EQ(kinds.size(), 9u + 2u + 70u);  // of one number of points, with points within, of ten orders
    for (const Kind& kind : kinds) {
        if (kind.type == cell_type::gmshPyramid) {
            continue;  // VTK has none
        }
        const std::vector<Place> places = randomPlaces(cellTypeInfo(kind.type).shape, kind.points > 400 ? 3 : 20);
        const auto ours = shapeFunctions(kind.type, kind.points, places);
        for (std::size_t p = 0; p < places.size(); ++p) {
            const std::vector<double> theirs = vtkFunctions(kind, places[p]);
            double worst = 0.0;
            for (std::size_t k = 0; k < kind.points; ++k) {
                worst = std::max(worst, std::abs(ours[p][k] - theirs[k]));
            }
            ASSERT_LT(worst, 1e-12) << nameOf(kind);
        }
    }
}

TEST(ShapeFunctions, AddUpToOne) {
    for (const Kind& kind : allKinds()) {
        const std::vector<Place> places = randomPlaces(cellTypeInfo(kind.type).shape, 5);
        for (const std::vector<double>& row : shapeFunctions(kind.type, kind.points, places)) {
            ASSERT_NEAR(std::accumulate(row.begin(), row.end(), 0.0), 1.0, 10.0 * roundoffOf(kind)) << nameOf(kind);
        }
    }
}

TEST(ShapeFunctions, AreOneAtTheirPointsAndZeroAtOthers) {
    for (const Kind& kind : allKinds()) {
        const bool bezier = kind.type >= cell_type::bezierTetrahedron && kind.type <= cell_type::bezierPyramid;
        if (kind.points > 400 || (bezier && curvedCellOrder(kind.type, kind.points) != 1)) {
            continue;  // a Bézier cell goes through its corners only
        }
        const auto rows = shapeFunctions(kind.type, kind.points, curvedCellPoints(kind.type, kind.points));
        for (std::size_t p = 0; p < kind.points; ++p) {
            for (std::size_t k = 0; k < kind.points; ++k) {
                ASSERT_NEAR(rows[p][k], p == k ? 1.0 : 0.0, roundoffOf(kind)) << nameOf(kind) << ", point " << p;
            }
        }
    }
}

}  // namespace
}  // namespace tetralux::mesh
