// SPDX-License-Identifier: Apache-2.0
/// \file
/// From options to images: reads the mesh, makes scene, camera and engine, renders frame by frame.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <apps/annotation.h>
#include <apps/render_options.h>
#include <mesh/tet/mesh_report.h>
#include <projection/core/engine.h>
#include <projection/frame/preview.h>
#include <projection/frame/verification.h>

namespace tetralux::apps {

/// What was found in the mesh and what each step took; times are wall times in milliseconds.
struct RenderRecord {
    std::string fieldName;
    double scalarMin = 0.0, scalarMax = 0.0;
    std::uint64_t tetrahedra = 0;
    mesh::MeshReport mesh;
    bool interfacesChecked = false;  ///< whether `mesh` says so if cells overlap or do not fit together
    projection::Camera camera;       ///< of the first frame
    double readMilliseconds = 0.0;
    double checkMilliseconds = 0.0;
    double prepareMilliseconds = 0.0;
    std::vector<projection::FrameReport> frames;
    std::optional<projection::Verification> verification;  ///< of the frame with the largest bound, if asked for
    std::optional<projection::Preview> preview;            ///< if asked for, its picture moved away
    std::optional<float> mostContributions;  ///< of any pixel of any frame, where the picture shows their number
};

class SceneRenderer {
public:
    /// Reads and prepares everything that does not change from frame to frame.
    /// \throws std::runtime_error for bad input, naming file, field or option
    explicit SceneRenderer(const RenderOptions& options);

    /// The image seen after the eye has turned by `turn` (1: once round) about `up`, annotation and background
    /// included.
    projection::Image render(double turn);

    /// A quick one of the first frame, in the promised time if that can be; annotation and background included.
    projection::Image preview(double promisedMilliseconds);

    const RenderRecord& record() const { return record_; }
    const projection::Engine& engine() const { return *engine_; }

private:
    void readScene(const RenderOptions& options);
    void checkInterfaces(const RenderOptions& options);
    void showCounts(projection::Image& image);
    void verify(const projection::Image& image, const projection::View& view);

    /// With annotation and background.
    projection::Image finished(projection::Image image, const projection::Camera& camera) const;

    projection::Scene scene_;
    projection::EngineOptions engineOptions_;
    AnnotationOptions annotation_;
    AnnotatedScene annotated_;
    std::optional<glm::vec3> background_;
    int verifiedPixels_ = 0;
    bool keepsNumbers_ = false;  ///< whether the file holds numbers beyond 1
    std::unique_ptr<projection::Engine> engine_;
    RenderRecord record_;
};

}  // namespace tetralux::apps
