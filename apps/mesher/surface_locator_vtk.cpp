// SPDX-License-Identifier: Apache-2.0
#include "surface_locator_vtk.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tetralux::mesher {

struct SurfaceLocator::Impl {
    const TriangleSurface& surface;
    vtkNew<vtkPolyData> data;
    vtkNew<vtkStaticCellLocator> locator;
    vtkNew<vtkGenericCell> cell;
};

SurfaceLocator::SurfaceLocator(const TriangleSurface& surface) : impl_(new Impl{surface, {}, {}, {}}) {
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(surface.points.size()));
    for (std::size_t i = 0; i < surface.points.size(); ++i)
        points->SetPoint(static_cast<vtkIdType>(i), &surface.points[i].x);
    const vtkNew<vtkCellArray> triangles;
    for (const Triangle& t : surface.triangles) {
        const vtkIdType ids[3] = {t[0], t[1], t[2]};
        triangles->InsertNextCell(3, ids);
    }
    impl_->data->SetPoints(points);
    impl_->data->SetPolys(triangles);
    impl_->locator->SetDataSet(impl_->data);
    impl_->locator->BuildLocator();
}

SurfaceLocator::~SurfaceLocator() = default;

SurfaceLocator::Nearest SurfaceLocator::nearest(const glm::dvec3& p) const {
    double point[3] = {p.x, p.y, p.z}, closest[3] = {0.0, 0.0, 0.0}, squared = 0.0;
    vtkIdType cell = 0;
    int part = 0;
    impl_->locator->FindClosestPoint(point, closest, impl_->cell, cell, part, squared);
    Nearest found;
    found.triangle = static_cast<std::uint32_t>(std::max<vtkIdType>(cell, 0));
    const Triangle& t = impl_->surface.triangles[found.triangle];
    const auto& points = impl_->surface.points;
    const glm::dvec3 q(closest[0], closest[1], closest[2]);
    found.distance = glm::length(q - p);
    const glm::dvec3 n = glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 &b = points[t[(k + 1) % 3]], &c = points[t[(k + 2) % 3]];
        found.weights[k] = std::max(0.0, glm::dot(n, glm::cross(c - b, q - b)));
        sum += found.weights[k];
    }
    for (double& w : found.weights) w = sum > 0.0 ? w / sum : 1.0 / 3.0;
    return found;
}

}  // namespace tetralux::mesher
