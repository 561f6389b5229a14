// SPDX-License-Identifier: Apache-2.0
/// \file
/// Depth from a render window, and a float picture into it.
#pragma once

#include <memory>
#include <vector>

#include "view_camera.h"

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace tetralux::vtk {

/// Depth, 0 to 1, of that part, bottom row first.
std::vector<float> windowDepths(vtkOpenGLRenderWindow& window, const WindowPart& part);

/// Puts pictures over what a window shows.
class WindowPicture {
public:
    WindowPicture();
    ~WindowPicture();
    WindowPicture(const WindowPicture&) = delete;
    WindowPicture& operator=(const WindowPicture&) = delete;

    /// Premultiplied RGBA of the current viewport's size, bottom row first, without a test of depth.
    void show(vtkOpenGLRenderWindow& window, const WindowPart& part, const float* rgba);
    void release(vtkWindow* window);

private:
    struct Resources;
    std::unique_ptr<Resources> resources_;
};

}  // namespace tetralux::vtk
