// SPDX-License-Identifier: Apache-2.0
// vtkTetraluxMapper from C++: a hexahedron of one scalar, whose opacity is known, in a window with a wall behind.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <vtkTetraluxMapper.h>

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellType.h"
#include "vtkColorTransferFunction.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

namespace {

void expectNear(double value, double expected, double tolerance, const char* what) {
    if (std::abs(value - expected) <= tolerance) return;
    std::fprintf(stderr, "%s: %.9g, not %.9g\n", what, value, expected);
    std::exit(1);
}

/// [-1, 1]³ as one cell with the scalar 2.
vtkNew<vtkUnstructuredGrid> cube() {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetName("s");
    const double at[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                             {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    for (const auto& point : at) {
        points->InsertNextPoint(point);
        scalars->InsertNextValue(2);
    }
    grid->SetPoints(points);
    const vtkIdType corners[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
    grid->GetPointData()->SetScalars(scalars);
    return grid;
}

/// A white square in the plane z.
vtkNew<vtkActor> wall(double z) {
    vtkNew<vtkPoints> points;
    for (const auto& [x, y] : {std::pair{-3.0, -3.0}, {3.0, -3.0}, {3.0, 3.0}, {-3.0, 3.0}})
        points->InsertNextPoint(x, y, z);
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->AllocateExact(1, 4);
    const vtkIdType corners[4] = {0, 1, 2, 3};
    surface->InsertNextCell(VTK_QUAD, 4, corners);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    return actor;
}

const float* middle(vtkTetraluxMapper& mapper) {
    vtkImageData* image = mapper.GetLastImage();
    const int* size = image->GetDimensions();
    return static_cast<const float*>(image->GetScalarPointer(size[0] / 2, size[1] / 2, 0));
}

}  // namespace

int main() {
    vtkNew<vtkTetraluxMapper> mapper;
    mapper->SetInputData(cube());
    vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    vtkNew<vtkColorTransferFunction> colors;
    colors->AddRGBPoint(0, 1, 0, 0);
    colors->AddRGBPoint(4, 0, 0, 1);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0, 0);
    opacity->AddPoint(4, 1);
    volume->GetProperty()->SetColor(colors);
    volume->GetProperty()->SetScalarOpacity(opacity);
    volume->GetProperty()->SetScalarOpacityUnitDistance(2);

    vtkNew<vtkRenderer> renderer;
    renderer->AddVolume(volume);
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(101, 101);
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->SetPosition(0, 0, 10);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer->GetActiveCamera()->ParallelProjectionOn();
    renderer->GetActiveCamera()->SetParallelScale(2);

    // extinction 0.5/2 over a length of 2
    const double alpha = 1 - std::exp(-0.5);
    window->Render();
    expectNear(mapper->GetCellsDrawn() >= 5 ? 1 : 0, 1, 0, "tetrahedra");
    expectNear(middle(*mapper)[3], alpha, 1e-6, "alpha");
    expectNear(middle(*mapper)[0], 0.5 * alpha, 1e-6, "red");
    expectNear(middle(*mapper)[2], 0.5 * alpha, 1e-6, "blue");

    // a wall in the middle leaves half the length
    renderer->AddActor(wall(0));
    window->Render();
    const double half = 1 - std::exp(-0.25);
    expectNear(middle(*mapper)[3], half, 1e-5, "alpha before a wall");
    unsigned char* shown = window->GetRGBACharPixelData(50, 50, 50, 50, 0);
    expectNear(shown[0], 255 * (0.5 * half + 1 - half), 1, "red in the window");
    expectNear(shown[1], 255 * (1 - half), 1, "green in the window");
    delete[] shown;

    expectNear(mapper->VerifyLastImage(100), 0, 1e-6, "rmse");
    std::puts("mapper: right");
    return 0;
}
