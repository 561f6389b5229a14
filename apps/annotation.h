// SPDX-License-Identifier: Apache-2.0
/// \file
/// What explains a picture: colour bar, axes and title.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/camera.h>
#include <projection/core/fitted_view.h>
#include <projection/image/image.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct AnnotationOptions {
    bool colorBar = false, axes = false;
    std::string caption = "{field}";  ///< of the colour bar; {field} is the field's name
    std::string title;

    bool empty() const { return !colorBar && !axes && title.empty(); }
};

void addAnnotationOptions(CLI::App& command, AnnotationOptions& options);

/// What the annotation tells of.
struct AnnotatedScene {
    std::string fieldName;
    double low = 0.0, high = 1.0;               ///< scalars at the ends of the colour bar
    preint::TransferFunction transferFunction;  ///< absolute
    mesh::BoundingBox bounds;
    bool logarithmic = false;      ///< the bar goes over the logarithm of the scalar
    std::vector<double> values{};  ///< of a categorical map: the bar has a step for each
    glm::dvec3 background{0};      ///< ink is white before a dark one, black before a bright one
};

/// Room at the picture's edges for what explains it, so that a view can be fitted beside it.
projection::Margins marginsFor(const AnnotationOptions& options, const AnnotatedScene& scene, int width, int height);

/// The edges of the axes box that the volume hides: before a background is put under the picture.
void drawBehind(const AnnotationOptions& options, const AnnotatedScene& scene, const projection::Camera& camera,
                projection::Image& image);

/// All the rest: after it. \throws std::runtime_error when the title is not UTF-8.
void drawInFront(const AnnotationOptions& options, const AnnotatedScene& scene, const projection::Camera& camera,
                 projection::Image& image);

}  // namespace tetralux::apps
