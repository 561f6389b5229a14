// SPDX-License-Identifier: Apache-2.0
/// \file
/// What VTK's properties and lights ask for, in Tetralux's words. Texts are compared to see what has changed.
#pragma once

#include <string>

#include <tetralux/tetralux.h>

class vtkRenderer;
class vtkVolumeProperty;

namespace tetralux::vtk {

/// What decides about opacity besides the property.
struct OpacityUse {
    bool isAlpha = false;      ///< opacity of a piece of the unit distance's length, else extinction times it
    bool isosurfaces = false;  ///< at the property's contour values, instead of extinction
    double unitFactor = 1.0;   ///< the property's unit distance times this counts
};

/// The transfer function as TransferFunction::parse takes it. Nodes that are joined by straight lines are taken as they
/// are, others followed to 1e-4 of the largest value.
std::string functionText(vtkVolumeProperty& property, const OpacityUse& use);

/// The lighting as Renderer::setLighting takes it; empty where the property is not shaded.
std::string lightingText(vtkVolumeProperty& property, vtkRenderer& renderer);

}  // namespace tetralux::vtk
