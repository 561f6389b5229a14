// SPDX-License-Identifier: Apache-2.0
/// \file
/// Tetralux as a library: a Renderer keeps a mesh, a field, a transfer function with light and cuts, and draws them
/// before any camera. Each of these is made again only when it, or one above it, has changed:
///
///     Mesh  →  Field  →  TransferFunction, lights, cuts  →  Camera
///
///     auto mesh = tetralux::Mesh::fromTetrahedra(xyz, cells);
///     tetralux::Renderer renderer(mesh);
///     renderer.setField(tetralux::Field::onPoints(values));
///     renderer.setTransferFunction(tetralux::TransferFunction::preset("viridis"));
///     std::vector<float> rgba(4 * 640 * 480);
///     renderer.render(tetralux::cameraHolding(mesh->bounds(), 640, 480), {rgba.data(), 640, 480, 4 * 640});
///
/// The library does not print, start processes, read the environment, or take more threads than it was given.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <tetralux/appearance.h>
#include <tetralux/error.h>
#include <tetralux/mesh.h>

namespace tetralux {

/// Right-handed; the picture's size comes with the ImageView. Pixel (x, y), row 0 at the top, is seen by the ray
/// through its centre. Only what lies before the eye (orthographic: before the plane through it) is seen.
struct Camera {
    Vector eye{0, 0, 1};            ///< where from, mesh units
    Vector target{0, 0, 0};         ///< where to: the middle of the picture unless windowCentre says otherwise
    Vector up{0, 1, 0};             ///< what is up; any length, not along the view
    double fovDegrees = 30;         ///< vertical
    double orthographicHeight = 0;  ///< > 0: orthographic, so many mesh units over the picture's height
    /// Where the picture's middle lies beside the optical axis, in half widths to the right and half heights up, as
    /// VTK's window centre has it. For stereo pairs and walls of displays.
    std::array<double, 2> windowCentre{0, 0};
    double aspect = 0;  ///< the whole picture's width over its height, as lengths; 0: that of square pixels
    double shear = 0;   ///< by how much the picture's top lies farther right than its middle, in half heights

    /// The camera of a host's 4×4 matrix, row after row, from column vectors (x, y, z, 1) in mesh units to clip
    /// coordinates, projection · view: the picture spans −1 … 1 in x/w (to the right) and y/w (up). Off-centre, sheared
    /// and stretched views are taken, perspective or parallel. Perspective: what has w > 0 is seen. Parallel: z/w grows
    /// away from the eye, whose plane, across the rays, touches the picture's rectangle in the plane z/w = −1. No other
    /// use is made of z: depths are limited by Control. \throws Error (BadInput) if a number is not finite, the matrix
    /// makes no picture, or its picture is mirrored (then turn the sign of its second row, and the rows of the image).
    static Camera fromMatrix(const std::array<double, 16>& clipFromWorld);
};

/// A view that Renderer::fittedCamera fits to what shows.
struct FittedView {
    Vector direction{-1, -0.7, -1.5};  ///< from the eye into the picture, any length
    Vector up{0, 1, 0};                ///< what is up in the picture
    double azimuth = 0;                ///< then turned as vtkCamera turns, degrees
    double elevation = 0;              ///< likewise
    double roll = 0;                   ///< likewise
    double fovDegrees = 30;            ///< vertical
    bool orthographic = false;         ///< then of the height that what shows asks for
    double zoom = 1;                   ///< then narrowed by this factor
    double margin = 0.02;              ///< share of the picture that stays free at each edge, or a pixel
    bool wholeMesh = false;            ///< held are hidden cells as well

    /// x, -x, y, -y, z, -z (the eye stands on that side), iso (from 1, 1, 1), and xy, xz, yz, yx, zx, zy as PyVista has
    /// them. \throws Error for other names.
    static FittedView named(std::string_view name);
};

/// A three-quarter view that holds the whole box, and holds it too when the eye goes round its middle, for a picture of
/// that shape; field of view, height, up and window are those of `like`. Renderer::fittedCamera comes nearer.
Camera cameraHolding(const BoundingBox& bounds, int width, int height, const Camera& like = {});

/// The caller's memory: linear RGBA, premultiplied by alpha, over nothing; the top row first.
struct ImageView {
    float* rgba = nullptr;            ///< the top row's first pixel
    int width = 0;                    ///< pixels
    int height = 0;                   ///< pixels
    std::ptrdiff_t floatsPerRow = 0;  ///< 0: 4 · width
};

/// Which part of a larger picture the ImageView is: its left upper pixel, and the size of the whole. 0: all of it.
struct ImageTile {
    int left = 0;         ///< of its first pixel in the whole
    int top = 0;          ///< of its first row in the whole
    int wholeWidth = 0;   ///< pixels of the whole picture
    int wholeHeight = 0;  ///< pixels of the whole picture
};

/// Only what lies within the box is drawn, every ray cut at it exactly. An empty box (low ≥ high): everything.
struct ClipBox {
    Vector low{};   ///< mesh units
    Vector high{};  ///< mesh units
};

/// What a caller asks of one frame.
struct Control {
    std::stop_token stop;                  ///< a frame ends within some 20 ms of the request
    std::function<void(double)> progress;  ///< share done, 0 … 1; called by the thread that renders
    double budgetMilliseconds = 0;         ///< > 0: a coarser picture rather than a later one
    /// width × height of the ImageView, top row first: the volume ends at this distance along the ray from the eye
    /// (orthographic: from the eye's plane), mesh units; infinite where nothing stands. Opaque geometry of the host.
    const float* depthLimit = nullptr;
    ImageTile tile{};  ///< a part of the picture
    ClipBox region{};  ///< a part of space
};

/// What one frame did.
struct FrameResult {
    bool complete = false;                              ///< false: it was stopped, and the picture is transparent
    double milliseconds = 0;                            ///< wall time, what had to be made anew included
    std::uint64_t cellsDrawn = 0;                       ///< tetrahedra
    std::map<std::string, std::uint64_t> cellsSkipped;  ///< by reason
    std::uint64_t pixelsRepaired = 0;                   ///< composed by the exact reference
    std::uint64_t pixelsWrong = 0;                      ///< that nothing vouches for and nothing repaired
    std::map<std::string, double> stageMilliseconds;    ///< wall time by stage
    std::string emptyBecause;  ///< why nothing shows and what would mend it; empty where something does
    int drawnWidth = 0;        ///< less than the picture's where a budget asked for it
    int drawnHeight = 0;       ///< likewise
};

/// How far a picture is from the exact one, by pixels computed again in double precision.
struct Verification {
    std::size_t pixels = 0;  ///< so many were computed again
    double rmse = 0;         ///< over RGBA of these
    double rmseBound = 0;    ///< of the whole picture, with 95 % confidence
    double max = 0;          ///< largest difference of a channel among these
    double unseenShare = 0;  ///< with 95 % confidence no more than this share of the pixels differs by more than max
};

/// What one ray meets, nearest first.
struct PixelProbe {
    /// The part of the ray within one tetrahedron.
    struct Segment {
        double begin;        ///< distance from the eye (orthographic: its plane), mesh units
        double end;          ///< likewise
        double scalarBegin;  ///< there
        double scalarEnd;    ///< there
        double alpha;        ///< of the segment alone
    };
    std::vector<Segment> segments;  ///< nearest first
    bool hit = false;               ///< whether anything shows; what follows is of where it first does
    double distance = 0;            ///< from the eye
    Vector position{};              ///< mesh units
    double scalar = 0;              ///< there
};

/// Which engine draws, with what.
struct RendererOptions {
    std::string engine = "auto";   ///< a name of engines(), or auto
    std::string context = "auto";  ///< of OpenGL: auto, egl, osmesa
    int threads = 0;               ///< 0: as many as the machine has; all parallel work keeps to it
    /// Instead of threads: runs the work that it is given within the host's oneTBB arena and returns when that is done,
    /// [&arena](const std::function<void()>& work) { arena.execute(work); }
    std::function<void(const std::function<void()>&)> arena{};
};

/// One thread at a time; several may share a Mesh, each in a thread of its own. Setters only note what they are given:
/// render() makes what it needs. \throws Error from every member.
class Renderer {
public:
    /// Makes nothing yet. \throws Error (BadInput) without a mesh, or for an engine that there is not.
    explicit Renderer(std::shared_ptr<const Mesh> mesh, RendererOptions options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;             ///< what was moved from may only be assigned to or destroyed
    Renderer& operator=(Renderer&&) noexcept;  ///< likewise

    void setField(Field field);  ///< needed before the first frame
    /// Nothing: one that shows the mesh, whatever it is.
    void setTransferFunction(std::optional<TransferFunction> function);
    void setMode(Mode mode);              ///< Mode::Standard without
    void setLighting(Lighting lighting);  ///< none without
    /// The same by a JSON document, which can say more: materials, reflectance, fibres, soft shadows (README, lights).
    void setLighting(std::string_view document);
    void setSilhouettes(Silhouettes silhouettes);  ///< Silhouettes::None without
    /// What lies within `layer` behind a cut (mesh units; 1/200 of the mesh's diagonal where nothing is said) is lit by
    /// the cut's normal.
    void setCuts(std::vector<Cut> cuts, std::optional<double> layer = {});
    void setSlices(std::vector<Slice> slices);        ///< in the place of those there were
    void setSurfaces(std::vector<Surface> surfaces);  ///< in the place of those there were
    /// Anti-aliasing: the mean of at least so many rays a pixel, 1 to 64, on a regular grid.
    void setSamples(int samples);
    void setBoundary(std::optional<Boundary> boundary);  ///< nothing: it is not drawn

    /// The camera that looks along the view's direction, as near as it can be with all that shows in the picture: cells
    /// that the transfer function shows, within cuts, slices and surfaces. \throws Error when nothing shows.
    Camera fittedCamera(const FittedView& view, int width, int height);

    /// Draws into `image`, all of whose pixels are written. What was set since the last frame is made first. A frame
    /// that is stopped leaves the picture transparent, and the next one goes on as if it had not been.
    FrameResult render(const Camera& camera, ImageView image, const Control& control = {});

    /// Computes `pixels` pixels of the picture again, which must be what render() made last with this camera.
    Verification verify(const Camera& camera, ImageView image, std::size_t pixels);

    /// What the ray through pixel (x, y) of a picture of the last frame's size meets.
    PixelProbe probe(const Camera& camera, int x, int y);

    std::string engine() const;    ///< that draws: "cpu", "gl", "reference"
    std::string renderer() const;  ///< what does the work: instruction set and threads, or OpenGL's name

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// An engine of this build.
struct EngineInfo {
    std::string name;        ///< for RendererOptions::engine
    bool available = false;  ///< whether this machine can run it
    std::string whyNot;      ///< where it is not
};

/// The engines of this build, and whether this machine can run them.
std::vector<EngineInfo> engines();

}  // namespace tetralux
