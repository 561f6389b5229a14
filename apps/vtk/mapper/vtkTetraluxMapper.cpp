// SPDX-License-Identifier: Apache-2.0
#include "vtkTetraluxMapper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include <tetralux/tetralux.h>

#include "grid_mesh.h"
#include "view_camera.h"
#include "volume_look.h"
#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkUnstructuredGridBase.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "window_picture.h"

namespace {

namespace tv = tetralux::vtk;

/// What a renderer was last told, to tell it only what has changed.
struct Appearance {
    tetralux::Mode mode = tetralux::Mode::Standard;
    tetralux::Silhouettes silhouettes = tetralux::Silhouettes::None;
    int samples = 1;
    std::string function, lighting;
    std::vector<double> cuts;  ///< point and normal of each
};

struct Machine {
    std::string engine;
    int threads = 0;
    bool operator==(const Machine&) const = default;
};

tetralux::Mode modeOf(int blend, bool scaleInvariant) {
    switch (blend) {
        case vtkTetraluxMapper::MAXIMUM_INTENSITY_BLEND:
            return tetralux::Mode::Mip;
        case vtkTetraluxMapper::MINIMUM_INTENSITY_BLEND:
            return tetralux::Mode::Minimum;
        case vtkTetraluxMapper::AVERAGE_INTENSITY_BLEND:
            return tetralux::Mode::Average;
        case vtkTetraluxMapper::ADDITIVE_BLEND:
            return scaleInvariant ? tetralux::Mode::AdditiveScaleInvariant : tetralux::Mode::Additive;
        case vtkTetraluxMapper::COMPOSITE_BLEND:
            return scaleInvariant ? tetralux::Mode::ScaleInvariant : tetralux::Mode::Standard;
        case vtkTetraluxMapper::ISOSURFACE_BLEND:
            return tetralux::Mode::Standard;
        default:
            throw tetralux::Error(tetralux::Errc::Unsupported, "there is no blend mode " + std::to_string(blend) +
                                                                   "; take composite (0) to isosurface (5)");
    }
}

tv::ChosenScalars scalarsOf(vtkTetraluxMapper& mapper, vtkVolumeProperty& property) {
    tv::ChosenScalars chosen;
    int where = 0;
    chosen.array = vtkAbstractMapper::GetScalars(mapper.GetInput(), mapper.GetScalarMode(), mapper.GetArrayAccessMode(),
                                                 mapper.GetArrayId(), mapper.GetArrayName(), where);
    if (chosen.array == nullptr || where > 1)
        throw tetralux::Error(tetralux::Errc::BadInput,
                              "no scalars on points or cells; name an array with SelectScalarArray and SetScalarMode");
    const int components = chosen.array->GetNumberOfComponents();
    if (!property.GetIndependentComponents() && components > 1)
        throw tetralux::Error(tetralux::Errc::Unsupported,
                              "dependent components are not drawn; call IndependentComponentsOn and choose a component "
                              "by the colour function's vector mode");
    chosen.onCells = where == 1;
    if (components > 1 && property.GetColorChannels(0) == 3) {
        vtkColorTransferFunction* colors = property.GetRGBTransferFunction(0);
        chosen.component =
            colors->GetVectorMode() == vtkScalarsToColors::MAGNITUDE ? -1 : std::max(0, colors->GetVectorComponent());
    }
    return chosen;
}

std::vector<double> planesOf(vtkPlaneCollection* planes) {
    std::vector<double> result;
    for (int i = 0; planes != nullptr && i < planes->GetNumberOfItems(); ++i) {
        vtkPlane* plane = planes->GetItem(i);
        result.insert(result.end(), plane->GetOrigin(), plane->GetOrigin() + 3);
        result.insert(result.end(), plane->GetNormal(), plane->GetNormal() + 3);
    }
    return result;
}

std::vector<tetralux::Cut> cutsOf(const std::vector<double>& planes) {
    std::vector<tetralux::Cut> cuts;
    for (std::size_t i = 0; i < planes.size(); i += 6)
        cuts.push_back({{planes[i], planes[i + 1], planes[i + 2]}, {planes[i + 3], planes[i + 4], planes[i + 5]}});
    return cuts;
}

void tell(tetralux::Renderer& renderer, Appearance& told, const Appearance& now) {
    if (now.mode != told.mode) renderer.setMode(now.mode);
    if (now.silhouettes != told.silhouettes) renderer.setSilhouettes(now.silhouettes);
    if (now.samples != told.samples) renderer.setSamples(now.samples);
    if (now.function != told.function) renderer.setTransferFunction(tetralux::TransferFunction::parse(now.function));
    if (now.lighting != told.lighting) {
        if (now.lighting.empty())
            renderer.setLighting(tetralux::Lighting{});
        else
            renderer.setLighting(std::string_view(now.lighting));
    }
    if (now.cuts != told.cuts) renderer.setCuts(cutsOf(now.cuts));
    told = now;
}

}  // namespace

struct vtkTetraluxMapper::Internals {
    tv::GridMesh grid;
    std::optional<tetralux::Renderer> renderer;
    Machine machine;
    Appearance appearance;
    tetralux::Camera camera;  ///< of the last frame
    vtkNew<vtkImageData> image;
    vtkNew<vtkFloatArray> pixels;
    tv::WindowPicture picture;

    /// The last image as Tetralux takes it, top row first.
    tetralux::ImageView view() {
        const int* size = image->GetDimensions();
        const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(size[0]);
        return {pixels->GetPointer(0) + (size[1] - 1) * row, size[0], size[1], -row};
    }
    bool hasImage() const { return renderer && pixels->GetNumberOfTuples() > 0; }
};

vtkStandardNewMacro(vtkTetraluxMapper);

vtkTetraluxMapper::vtkTetraluxMapper() : Own(new Internals) {
    this->Own->pixels->SetName("RGBA");
    this->Own->pixels->SetNumberOfComponents(4);
    this->Own->image->GetPointData()->SetScalars(this->Own->pixels);
}
vtkTetraluxMapper::~vtkTetraluxMapper() = default;

void vtkTetraluxMapper::PrintSelf(ostream& os, vtkIndent indent) {
    this->Superclass::PrintSelf(os, indent);
    os << indent << "ScaleInvariant: " << this->ScaleInvariant << "\n"
       << indent << "OpacityIsAlpha: " << this->OpacityIsAlpha << "\n"
       << indent << "Silhouettes: " << this->Silhouettes << "\n"
       << indent << "Samples: " << this->Samples << "\n"
       << indent << "Engine: " << this->Engine << "\n"
       << indent << "Threads: " << this->Threads << "\n"
       << indent << "Region:";
    for (const double bound : this->Region) os << " " << bound;
    os << "\n"
       << indent << "CellsDrawn: " << this->CellsDrawn << "\n"
       << indent << "EngineMilliseconds: " << this->EngineMilliseconds << "\n"
       << indent << "Complete: " << this->Complete << "\n"
       << indent << "DrawnSize: " << this->DrawnSize[0] << " " << this->DrawnSize[1] << "\n";
}

void vtkTetraluxMapper::Render(vtkRenderer* renderer, vtkVolume* volume) {
    if (renderer->GetSelector() != nullptr || this->GetInput() == nullptr) return;  // no colours into a selection
    if (const int* size = renderer->GetSize(); size[0] < 1 || size[1] < 1) return;
    this->InvokeEvent(vtkCommand::StartEvent, nullptr);
    const double start = vtkTimerLog::GetUniversalTime();
    try {
        this->Draw(renderer, volume);
    } catch (const tetralux::Error& error) {
        this->Complete = false;
        vtkErrorMacro(<< error.what());
    }
    this->TimeToDraw = vtkTimerLog::GetUniversalTime() - start;
    this->InvokeEvent(vtkCommand::EndEvent, nullptr);
}

void vtkTetraluxMapper::Draw(vtkRenderer* renderer, vtkVolume* volume) {
    Internals& own = *this->Own;
    auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
    if (window == nullptr)
        throw tetralux::Error(tetralux::Errc::Unsupported, "the window is none of OpenGL's; use one that is");
    vtkVolumeProperty& property = *volume->GetProperty();

    const tv::ChosenScalars scalars = scalarsOf(*this, property);
    const bool newMesh = own.grid.updateMesh(*this->GetInput(), *volume->GetMatrix());
    const Machine machine{this->Engine, this->Threads};
    if (newMesh || !own.renderer || !(machine == own.machine)) {
        tetralux::RendererOptions options;
        options.engine = machine.engine;
        options.threads = machine.threads;
        own.renderer.emplace(own.grid.mesh(), options);
        own.machine = machine;
        own.appearance = {};
    }
    const bool newField = own.grid.updateField(*this->GetInput(), scalars);
    if (newField || own.appearance.function.empty()) own.renderer->setField(own.grid.field());
    this->MeshesMade += newMesh ? 1 : 0;
    this->FieldsMade += newField ? 1 : 0;

    Appearance appearance;
    appearance.mode = modeOf(this->BlendMode, this->ScaleInvariant != 0);
    appearance.silhouettes = static_cast<tetralux::Silhouettes>(this->Silhouettes);
    appearance.samples = this->Samples;
    tv::OpacityUse use;
    use.isAlpha = this->OpacityIsAlpha != 0;
    use.isosurfaces = this->BlendMode == ISOSURFACE_BLEND;
    const double diagonal = own.grid.mesh()->bounds().diagonal();
    if (this->ScaleInvariant && own.grid.scalarRange() > 0) use.unitFactor = own.grid.scalarRange() / diagonal;
    appearance.function = tv::functionText(property, use);
    appearance.lighting = tv::lightingText(property, *renderer);
    appearance.cuts = planesOf(this->ClippingPlanes);
    tell(*own.renderer, own.appearance, appearance);

    const tv::WindowView view = tv::viewOf(*renderer);
    const std::vector<float> depths = tv::windowDepths(*window, view.part);
    this->OpaquePixels = std::count_if(depths.begin(), depths.end(), [](float depth) { return depth < 1; });
    std::vector<float> limits;
    if (this->OpaquePixels > 0) limits = tv::distancesOf(view, depths);

    own.image->SetDimensions(view.part.width, view.part.height, 1);
    own.pixels->SetNumberOfTuples(own.image->GetNumberOfPoints());
    std::stop_source stop;
    tetralux::Control control;
    control.stop = stop.get_token();
    control.progress = [&](double share) {
        this->UpdateProgress(share);
        if (window->CheckAbortStatus() || this->GetAbortExecute()) stop.request_stop();
    };
    constexpr double secondsOfStill = 5;  // a window at rest allows hours, a render pass that allots nothing ten
    if (volume->GetAllocatedRenderTime() < secondsOfStill)
        control.budgetMilliseconds = 1000 * volume->GetAllocatedRenderTime();
    control.depthLimit = limits.empty() ? nullptr : limits.data();
    control.region = {{this->Region[0], this->Region[2], this->Region[4]},
                      {this->Region[1], this->Region[3], this->Region[5]}};
    const tetralux::FrameResult result = own.renderer->render(view.camera, own.view(), control);
    own.camera = view.camera;
    own.pixels->Modified();
    this->Complete = result.complete;
    this->CellsDrawn = static_cast<vtkIdType>(result.cellsDrawn);
    this->EngineMilliseconds = result.milliseconds;
    this->DrawnSize[0] = result.drawnWidth;
    this->DrawnSize[1] = result.drawnHeight;
    if (!result.complete) return;
    window->MakeCurrent();  // an engine may have a context of its own
    own.picture.show(*window, view.part, own.pixels->GetPointer(0));
}

vtkImageData* vtkTetraluxMapper::GetLastImage() {
    return this->Own->image;
}

double vtkTetraluxMapper::VerifyLastImage(int pixels) {
    Internals& own = *this->Own;
    if (!own.hasImage() || !this->Complete || pixels < 1) {
        vtkErrorMacro(<< "there is no finished frame to verify, or no pixels; render first, and give 1 pixel or more");
        return -1;
    }
    try {
        return own.renderer->verify(own.camera, own.view(), static_cast<std::size_t>(pixels)).rmse;
    } catch (const tetralux::Error& error) {
        vtkErrorMacro(<< error.what());
        return -1;
    }
}

bool vtkTetraluxMapper::PickPosition(int x, int y, double position[3]) {
    Internals& own = *this->Own;
    if (!own.hasImage()) return false;
    try {
        const tetralux::PixelProbe probe = own.renderer->probe(own.camera, x, own.image->GetDimensions()[1] - 1 - y);
        std::copy(probe.position.begin(), probe.position.end(), position);
        return probe.hit;
    } catch (const tetralux::Error& error) {
        vtkErrorMacro(<< error.what());
        return false;
    }
}

double vtkTetraluxMapper::PickScalar(int x, int y) {
    Internals& own = *this->Own;
    double scalar = std::numeric_limits<double>::quiet_NaN();
    if (!own.hasImage()) return scalar;
    try {
        const tetralux::PixelProbe probe = own.renderer->probe(own.camera, x, own.image->GetDimensions()[1] - 1 - y);
        if (probe.hit) scalar = probe.scalar;
    } catch (const tetralux::Error& error) {
        vtkErrorMacro(<< error.what());
    }
    return scalar;
}

void vtkTetraluxMapper::ReleaseGraphicsResources(vtkWindow* window) {
    this->Own->picture.release(window);
    this->Superclass::ReleaseGraphicsResources(window);
}
