// SPDX-License-Identifier: Apache-2.0
//
// All of VTK's unstructured mappers take "scalar opacity" for attenuation: light falls by
// exp(−opacity·length/unitDistance), with no logarithm (a slab of constant scalar shows it). So nodes of τ·unitDistance
// say exactly what the reference integrates.
#include <apps/bench_vtk/vtk_picture.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiThreader.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridPartialPreIntegration.h>
#include <vtkUnstructuredGridPreIntegration.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkUnstructuredGridVolumeZSweepMapper.h>
#include <vtkVersion.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

namespace tetralux::bench_vtk {

namespace {

using MapperPointer = vtkSmartPointer<vtkUnstructuredGridVolumeMapper>;

/// Full resolution always: by default these two mappers draw fewer pixels when they find themselves slow.
template <class Mapper>
vtkSmartPointer<Mapper> fullResolution() {
    auto mapper = vtkSmartPointer<Mapper>::New();
    mapper->AutoAdjustSampleDistancesOff();
    mapper->SetImageSampleDistance(1.0);
    return mapper;
}

template <class Integrator>
MapperPointer rayCaster() {
    auto mapper = fullResolution<vtkUnstructuredGridVolumeRayCastMapper>();
    mapper->SetRayIntegrator(vtkSmartPointer<Integrator>::New());
    return mapper;
}

MapperPointer zSweep() {
    auto mapper = fullResolution<vtkUnstructuredGridVolumeZSweepMapper>();
    mapper->SetRayIntegrator(vtkSmartPointer<vtkUnstructuredGridPreIntegration>::New());
    return mapper;
}

struct NamedMapper {
    const char* name;
    MapperPointer (*make)();
    bool usesOpenGl;
    /// Its rays run through the lower left corners of pixels: without half a pixel of correction it errs twice as much.
    bool throughCorners;
};
const NamedMapper mappers[] = {
    {"projected", [] { return MapperPointer(vtkSmartPointer<vtkProjectedTetrahedraMapper>::New()); }, true, false},
    {"ray-preint", rayCaster<vtkUnstructuredGridPreIntegration>, false, true},
    {"ray-partial", rayCaster<vtkUnstructuredGridPartialPreIntegration>, false, true},
    {"ray-linear", rayCaster<vtkUnstructuredGridLinearRayIntegrator>, false, true},
    {"zsweep", zSweep, false, false},
};

const NamedMapper& findMapper(const std::string& name) {
    for (const NamedMapper& mapper : mappers)
        if (name == mapper.name) return mapper;
    throw std::runtime_error(
        fmt::format("there is no mapper '{}'; take one of {}", name, fmt::join(mapperNames(), ", ")));
}

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(const MeshArrays& mesh) {
    const auto pointCount = static_cast<vtkIdType>(mesh.positions.size() / 3);
    const auto cellCount = static_cast<vtkIdType>(mesh.cells.size() / 4);
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(pointCount);
    std::copy(mesh.positions.begin(), mesh.positions.end(), coordinates->GetPointer(0));
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);

    vtkNew<vtkIdTypeArray> offsets, connectivity;
    offsets->SetNumberOfTuples(cellCount + 1);
    for (vtkIdType i = 0; i <= cellCount; ++i) offsets->SetValue(i, 4 * i);
    connectivity->SetNumberOfTuples(4 * cellCount);
    std::copy(mesh.cells.begin(), mesh.cells.end(), connectivity->GetPointer(0));
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, connectivity);

    vtkNew<vtkDoubleArray> scalars;
    scalars->SetName("scalar");
    scalars->SetNumberOfTuples(static_cast<vtkIdType>(mesh.scalars.size()));
    std::copy(mesh.scalars.begin(), mesh.scalars.end(), scalars->GetPointer(0));

    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points);
    grid->SetCells(VTK_TETRA, cells);
    if (mesh.cellData)
        grid->GetCellData()->SetScalars(scalars);
    else
        grid->GetPointData()->SetScalars(scalars);
    return grid;
}

void setTransferFunction(const Request& request, vtkVolumeProperty& property) {
    vtkNew<vtkColorTransferFunction> color;
    for (const auto& [s, r, g, b] : request.color) color->AddRGBPoint(s, r, g, b);
    vtkNew<vtkPiecewiseFunction> attenuation;
    for (const auto& [s, a] : request.attenuation) attenuation->AddPoint(s, a);
    property.SetColor(color);
    property.SetScalarOpacity(attenuation);
    property.SetScalarOpacityUnitDistance(request.unitDistance);
    property.ShadeOff();
    property.SetInterpolationTypeToLinear();
}

}  // namespace

struct VtkPicture::State {
    const NamedMapper& named;
    MapperPointer mapper;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkRenderWindow> window;
};

std::string vtkVersionText() {
    return vtkVersion::GetVTKVersion();
}

std::vector<std::string> mapperNames() {
    std::vector<std::string> names;
    for (const NamedMapper& mapper : mappers) names.emplace_back(mapper.name);
    return names;
}

VtkPicture::VtkPicture(const MeshArrays& mesh, const Request& request)
    : state_(new State{findMapper(request.mapper), {}, {}, {}}) {
    state_->mapper = state_->named.make();
    state_->mapper->SetInputData(makeGrid(mesh));
    vtkNew<vtkVolume> volume;
    volume->SetMapper(state_->mapper);
    setTransferFunction(request, *volume->GetProperty());
    state_->renderer->SetBackground(0, 0, 0);
    state_->renderer->AddVolume(volume);
    state_->window->SetOffScreenRendering(1);
    state_->window->SetMultiSamples(0);
    state_->window->SetAlphaBitPlanes(1);
    state_->window->SetSize(request.size[0], request.size[1]);
    state_->window->AddRenderer(state_->renderer);
}

VtkPicture::~VtkPicture() = default;

double VtkPicture::draw(const RequestedCamera& camera) {
    vtkCamera& view = *state_->renderer->GetActiveCamera();
    view.SetPosition(camera.eye.data());
    view.SetFocalPoint(camera.target.data());
    view.SetViewUp(camera.up.data());
    view.SetViewAngle(camera.fovDegrees);  // vertical unless UseHorizontalViewAngle
    if (state_->named.throughCorners) {    // half a pixel to the right and upwards, by turning: exact in the middle
        const double radians = std::tan(camera.fovDegrees * std::numbers::pi / 360.0) / state_->window->GetSize()[1];
        view.Yaw(-radians * 180.0 / std::numbers::pi);
        view.Pitch(radians * 180.0 / std::numbers::pi);
    }
    state_->renderer->ResetCameraClippingRange();
    const auto start = std::chrono::steady_clock::now();
    state_->window->Render();
    state_->window->WaitForCompletion();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<float> VtkPicture::pixels() const {
    const int* size = state_->window->GetSize();
    const int width = size[0], height = size[1];
    vtkNew<vtkUnsignedCharArray> bytes;
    state_->window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, bytes);
    const std::size_t row = 4 * static_cast<std::size_t>(width);
    std::vector<float> values(row * static_cast<std::size_t>(height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        const unsigned char* from = bytes->GetPointer(0) + row * (static_cast<std::size_t>(height) - 1 - y);
        for (std::size_t i = 0; i < row; ++i) values[row * y + i] = static_cast<float>(from[i]) / 255.0f;
    }
    return values;
}

std::string VtkPicture::renderer() const {
    if (!state_->named.usesOpenGl)
        return fmt::format("VTK, {} threads", vtkMultiThreader::GetGlobalDefaultNumberOfThreads());
    std::istringstream capabilities(state_->window->ReportCapabilities());
    constexpr std::string_view key = "OpenGL renderer string:";
    for (std::string line; std::getline(capabilities, line);)
        if (line.starts_with(key)) return "VTK," + line.substr(key.size());
    return "VTK, OpenGL";
}

}  // namespace tetralux::bench_vtk
