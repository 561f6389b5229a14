// SPDX-License-Identifier: Apache-2.0
#include "vtkTetraluxVolumeRepresentation.h"

#include <array>
#include <cstdio>

#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkPVRenderViewDataDeliveryManager.h"
#include "vtkPVView.h"
#include "vtkPlane.h"
#include "vtkRenderer.h"
#include "vtkTetraluxMapper.h"
#include "vtkTextActor.h"

vtkStandardNewMacro(vtkTetraluxVolumeRepresentation);

vtkTetraluxVolumeRepresentation::vtkTetraluxVolumeRepresentation() {
    this->AddVolumeMapper("Tetralux", this->Mapper);
    this->Superclass::SetActiveVolumeMapper("Tetralux");
    this->Mapper->AddObserver(vtkCommand::EndEvent, this, &vtkTetraluxVolumeRepresentation::TellError);
    this->Error->SetPosition(10, 10);
    this->Error->SetInput("not verified yet");
    this->Error->VisibilityOff();
}
vtkTetraluxVolumeRepresentation::~vtkTetraluxVolumeRepresentation() = default;

void vtkTetraluxVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent) {
    this->Superclass::PrintSelf(os, indent);
    os << indent << "Mapper:\n";
    this->Mapper->PrintSelf(os, indent.GetNextIndent());
}

void vtkTetraluxVolumeRepresentation::SetActiveVolumeMapper(const char*) {}

void vtkTetraluxVolumeRepresentation::SetBlendMode(int mode) {
    this->Mapper->SetBlendMode(mode);
}
void vtkTetraluxVolumeRepresentation::SetScaleInvariant(int on) {
    this->Mapper->SetScaleInvariant(on);
}
void vtkTetraluxVolumeRepresentation::SetOpacityIsAlpha(int on) {
    this->Mapper->SetOpacityIsAlpha(on);
}
void vtkTetraluxVolumeRepresentation::SetSilhouettes(int which) {
    this->Mapper->SetSilhouettes(which);
}
void vtkTetraluxVolumeRepresentation::SetSamples(int samples) {
    this->Mapper->SetSamples(samples);
}
void vtkTetraluxVolumeRepresentation::SetThreads(int threads) {
    this->Mapper->SetThreads(threads);
}

void vtkTetraluxVolumeRepresentation::SetClip(int on) {
    this->Mapper->RemoveAllClippingPlanes();
    if (on != 0) this->Mapper->AddClippingPlane(this->ClipPlane);
}
void vtkTetraluxVolumeRepresentation::SetClipOrigin(double x, double y, double z) {
    this->ClipPlane->SetOrigin(x, y, z);
}
void vtkTetraluxVolumeRepresentation::SetClipNormal(double x, double y, double z) {
    this->ClipPlane->SetNormal(x, y, z);
}

void vtkTetraluxVolumeRepresentation::SetVerify(int pixels) {
    this->Verify = pixels;
}

bool vtkTetraluxVolumeRepresentation::AddToView(vtkView* view) {
    auto* shown = vtkPVRenderView::SafeDownCast(view);
    if (shown != nullptr) (this->Renderer = shown->GetRenderer())->AddActor(this->Error);
    return this->Superclass::AddToView(view);
}

bool vtkTetraluxVolumeRepresentation::RemoveFromView(vtkView* view) {
    auto* shown = vtkPVRenderView::SafeDownCast(view);
    if (shown != nullptr) shown->GetRenderer()->RemoveActor(this->Error);
    this->Renderer = nullptr;
    return this->Superclass::RemoveFromView(view);
}

/// After the volume and before what lies over it is drawn.
void vtkTetraluxVolumeRepresentation::TellError() {
    const int* drawn = this->Mapper->GetDrawnSize();
    const int* wanted = this->Mapper->GetLastImage()->GetDimensions();
    const bool whole = this->Mapper->GetComplete() && drawn[0] == wanted[0] && drawn[1] == wanted[1];
    if (this->Verify == 0) return;
    std::array<char, 64> text{"not verified: a coarser frame"};
    if (whole)
        std::snprintf(text.data(), text.size(), "rmse %.1e (%d pixels)", this->Mapper->VerifyLastImage(this->Verify),
                      this->Verify);
    this->Error->SetInput(text.data());
    if (this->Renderer != nullptr) this->Error->RenderOpaqueGeometry(this->Renderer);  // takes up the text
}

int vtkTetraluxVolumeRepresentation::ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* in,
                                                        vtkInformation* out) {
    if (!this->Superclass::ProcessViewRequest(request, in, out)) return 0;
    if (request == vtkPVView::REQUEST_UPDATE()) {
        vtkPVRenderView::SetRedistributionModeToDuplicateBoundaryCells(in, this);
    } else if (request == vtkPVView::REQUEST_RENDER()) {
        this->Error->SetVisibility(this->GetVisibility() && this->Verify > 0);
        this->Actor->SetEnableLOD(0);  // while moving a coarser picture of the volume, no surface
        this->AllotTime(in);
        this->CutAtBox(in);
    }
    return 1;
}

/// Passes that compose pictures of several processes allot none.
void vtkTetraluxVolumeRepresentation::AllotTime(vtkInformation* in) {
    constexpr double moving = 0.2, atRest = 1e4;  // seconds
    this->Actor->SetAllocatedRenderTime(in->Has(vtkPVRenderView::USE_LOD()) ? moving : atRest, this->Renderer);
}

void vtkTetraluxVolumeRepresentation::CutAtBox(vtkInformation* in) {
    double box[6] = {0, 0, 0, 0, 0, 0};
    auto* view = vtkPVRenderView::SafeDownCast(in->Get(vtkPVView::VIEW()));
    auto* manager =
        view != nullptr ? vtkPVRenderViewDataDeliveryManager::SafeDownCast(view->GetDeliveryManager()) : nullptr;
    if (manager != nullptr && view->GetUseOrderedCompositing()) {
        const auto rank =
            static_cast<std::size_t>(vtkMultiProcessController::GetGlobalController()->GetLocalProcessId());
        if (rank < manager->GetCuts().size()) manager->GetCuts()[rank].GetBounds(box);
    }
    this->Mapper->SetRegion(box);
}
