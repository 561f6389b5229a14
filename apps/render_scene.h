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
#include <apps/kept_anisotropy.h>
#include <apps/render_options.h>
#include <mesh/tet/mesh_report.h>
#include <projection/core/engine.h>
#include <projection/frame/preview.h>
#include <projection/frame/shown_points.h>
#include <projection/frame/verification.h>

namespace tetralux::apps {

/// Which step of a series is drawn.
struct DrawnStep {
    double time = 0.0;
    std::size_t number = 0, count = 0;  ///< from 0; of so many
};

/// What was found in the mesh and what each step took; times are wall times in milliseconds.
struct RenderRecord {
    std::string fieldName;
    double scalarMin = 0.0, scalarMax = 0.0;
    std::uint64_t tetrahedra = 0;
    std::optional<DrawnStep> step;  ///< the last one that was drawn, of a series
    bool meshKept = false;          ///< whether its mesh is that of the step before
    mesh::MeshReport mesh;
    bool interfacesChecked = false;  ///< whether `mesh` says so if cells overlap or do not fit together
    projection::Camera camera;       ///< of the first frame
    double readMilliseconds = 0.0;
    double checkMilliseconds = 0.0;
    double prepareMilliseconds = 0.0;
    std::vector<projection::FrameReport> frames;
    std::optional<projection::Verification> verification;  ///< of the frame with the largest bound, if asked for
    std::optional<projection::Preview> preview;            ///< if asked for, its picture moved away
    std::string emptyBecause;                              ///< of a frame in which nothing shows; empty: of none
    std::optional<float> mostContributions;  ///< of any pixel of any frame, where the picture shows their number
};

class SceneRenderer {
public:
    /// What differs between options, each with all before it.
    enum class Change {
        Camera,  ///< where from and how large
        Look,    ///< all else that is drawn of the mesh
        Mesh     ///< what is read, and how
    };

    /// Reads and prepares everything that does not change from frame to frame.
    /// \throws std::runtime_error for bad input, naming file, field or option
    explicit SceneRenderer(const RenderOptions& options);

    /// Goes on with other options, and makes again what `change` says. Unless the eye is given, the view is fitted
    /// anew. After an error nothing can be drawn until a change of that kind has passed.
    void change(const RenderOptions& options, Change change);

    /// One frame that may be stopped (view.control), by a camera of any size, as engines give it.
    /// \throws projection::FrameStopped
    projection::Image draw(const projection::View& view, projection::FrameReport& report) const;
    /// What draw() gave, with annotation and background, as files have it.
    projection::Image finished(projection::Image image, const projection::Camera& camera) const;
    /// Where the image is without anything: why, and what would mend it.
    std::string whyEmpty(const projection::Camera& camera) const;

    /// The image seen after the eye has turned by `turn` (1: once round) about `up`, annotation and background
    /// included.
    projection::Image render(double turn);

    /// A quick one of the first frame, in the promised time if that can be; annotation and background included.
    projection::Image preview(double promisedMilliseconds);

    /// Of all steps, ascending as the file has them; empty where the mesh is no series.
    const std::vector<double>& times() const { return times_; }

    /// Goes on with that step, with the camera as it was. What follows from the mesh alone is kept where the step's
    /// mesh is the last one's.
    void moveTo(std::size_t step);

    /// What may be wrong with the transfer function, for people; empty: nothing, or it or its range was chosen on
    /// purpose.
    std::string advice() const;

    const RenderRecord& record() const { return record_; }
    const projection::Engine& engine() const { return *engine_; }
    const projection::Scene& scene() const { return scene_; }

private:
    void readStep(std::optional<double> time);
    void takeMesh(mesh::ScalarMesh mesh);
    void makeScene();
    glm::dvec2 rangeOfAllSteps();
    void checkInterfaces(const RenderOptions& options);
    void showCounts(projection::Image& image);
    void verify(const projection::Image& image, const projection::View& view);

    void takeLook(const RenderOptions& options);
    void makeLook();
    void placeCamera();

    std::string title() const;

    RenderOptions options_;
    preint::TransferFunction function_;       ///< as it is asked for, not yet fitted to a step
    projection::OpaqueObjects givenObjects_;  ///< slices and surfaces, without the boundary
    std::vector<double> times_;
    std::optional<KeptAnisotropy> anisotropy_;
    std::shared_ptr<projection::MeshMemo> meshMemo_;
    std::shared_ptr<projection::FrameMemory> frameMemory_ = std::make_shared<projection::FrameMemory>();
    projection::Scene scene_;
    projection::SceneParts parts_;
    AnnotationOptions annotation_;
    AnnotatedScene annotated_;
    std::optional<glm::vec3> background_;
    bool keepsNumbers_ = false;  ///< whether the file holds numbers beyond 1
    std::unique_ptr<projection::Engine> engine_;
    RenderRecord record_;
};

}  // namespace tetralux::apps
