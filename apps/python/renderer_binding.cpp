// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <apps/python/bindings.h>
#include <apps/python/frame_thread.h>
#include <apps/python/owner.h>
#include <tetralux/tetralux.h>

namespace tetralux::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

using Rgba = nb::ndarray<float, nb::shape<-1, -1, 4>, nb::c_contig, nb::device::cpu>;
using Depth = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Triangles = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// (eye, target, up, fov in degrees, orthographic height or 0, window centre).
struct BoundCamera {
    Vector eye, target, up;
    double fov, height;
    std::array<double, 2> centre;

    Camera camera() const {
        Camera result;
        result.eye = eye;
        result.target = target;
        result.up = up;
        result.fovDegrees = fov;
        result.orthographicHeight = height;
        result.windowCentre = centre;
        return result;
    }
};

Mode modeOf(const std::string& name) {
    static const std::vector<std::pair<const char*, Mode>> modes{
        {"standard", Mode::Standard},
        {"scale-invariant", Mode::ScaleInvariant},
        {"mip", Mode::Mip},
        {"minimum", Mode::Minimum},
        {"average", Mode::Average},
        {"additive", Mode::Additive},
        {"additive-scale-invariant", Mode::AdditiveScaleInvariant},
        {"emission", Mode::Emission},
        {"absorption", Mode::Absorption},
        {"first-hit", Mode::FirstHit},
        {"depth", Mode::Depth}};
    std::string names;
    for (const auto& [each, mode] : modes) {
        if (name == each) return mode;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", each);
    }
    throw Error(Errc::BadInput, fmt::format("mode: there is no '{}'; take one of {}", name, names));
}

Silhouettes silhouettesOf(const std::string& name) {
    if (name == "none") return Silhouettes::None;
    if (name == "exact") return Silhouettes::Exact;
    if (name == "approximate") return Silhouettes::Approximate;
    throw Error(Errc::BadInput, fmt::format("silhouette: there is no '{}'; take none, exact or approximate", name));
}

nb::dict dictOf(const FrameResult& result) {
    nb::dict dict;
    dict["milliseconds"] = result.milliseconds;
    dict["cells_drawn"] = result.cellsDrawn;
    dict["cells_skipped"] = result.cellsSkipped;
    dict["pixels_repaired"] = result.pixelsRepaired;
    dict["pixels_wrong"] = result.pixelsWrong;
    dict["stages"] = result.stageMilliseconds;
    dict["drawn_size"] = nb::make_tuple(result.drawnWidth, result.drawnHeight);
    return dict;
}

ImageView viewOf(const Rgba& rgba) {
    ImageView view;
    view.rgba = rgba.data();
    view.height = static_cast<int>(rgba.shape(0));
    view.width = static_cast<int>(rgba.shape(1));
    return view;
}

/// Everything that one frame uses, until its thread is done with it.
struct Frame {
    Rgba rgba;
    std::optional<Depth> depth;
    nb::object progress;
    Camera camera;
    Control control;
    FrameResult result;
    std::string engine;
    std::exception_ptr raised;  ///< by `progress`

    /// `progress` with the interpreter's lock; what it raises stops the frame.
    void tell(double share, std::stop_source& stop) {
        const nb::gil_scoped_acquire locked;
        try {
            progress(share);
        } catch (...) {
            if (!raised) raised = std::current_exception();
            stop.request_stop();
        }
    }
};

bool along(const Vector& a, const Vector& b) {
    const auto length = [](const Vector& v) { return std::hypot(v[0], v[1], v[2]); };
    const Vector cross{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return length(cross) < 1e-3 * length(a) * length(b);
}

class BoundRenderer {
public:
    BoundRenderer(const BoundMesh& mesh, const std::string& engine, const std::string& context, int threads) {
        RendererOptions options;
        options.engine = engine;
        options.context = context;
        options.threads = threads;
        renderer_ = std::make_shared<std::optional<Renderer>>(Renderer(mesh.mesh, options));
    }
    ~BoundRenderer() { close(); }
    BoundRenderer(const BoundRenderer&) = delete;
    BoundRenderer& operator=(const BoundRenderer&) = delete;

    template <class Work>
    void with(Work work) {
        thread_.run([renderer = renderer_, work = std::move(work)] { work(renderer->value()); });
    }

    nb::dict render(const Rgba& rgba, const BoundCamera& camera, nb::object progress, double budget,
                    std::optional<Depth> depth) {
        if (depth && (depth->shape(0) != rgba.shape(0) || depth->shape(1) != rgba.shape(1)))
            throw Error(Errc::BadInput, fmt::format("depth limit: {}x{} numbers for {}x{} pixels; give one for each",
                                                    depth->shape(1), depth->shape(0), rgba.shape(1), rgba.shape(0)));
        std::stop_source stop;
        const std::shared_ptr<Frame> frame =
            frameOf({rgba, std::move(depth), std::move(progress), camera.camera(), {}, {}, {}, {}});
        frame->control.stop = stop.get_token();
        frame->control.budgetMilliseconds = budget;
        frame->control.depthLimit = frame->depth ? frame->depth->data() : nullptr;
        if (!frame->progress.is_none())
            frame->control.progress = [frame = frame.get(), stop](double share) mutable { frame->tell(share, stop); };
        {
            const std::lock_guard lock(stopMutex_);
            stop_ = stop;
        }
        thread_.run(
            [renderer = renderer_, frame] {
                frame->result = (*renderer)->render(frame->camera, viewOf(frame->rgba), frame->control);
                frame->engine = (*renderer)->engine();
            },
            stop);
        if (frame->raised) std::rethrow_exception(frame->raised);
        if (!frame->result.complete) throw Error(Errc::Cancelled, "render: stopped on request");
        nb::dict report = dictOf(frame->result);
        report["engine"] = frame->engine;
        return report;
    }

    nb::dict verify(const Rgba& rgba, const BoundCamera& camera, std::size_t pixels) {
        struct Check {
            Rgba rgba;
            Verification found;
        };
        const auto check = std::const_pointer_cast<Check>(ownerOf(Check{rgba, {}}));
        with([check, camera, pixels](Renderer& renderer) {
            check->found = renderer.verify(camera.camera(), viewOf(check->rgba), pixels);
        });
        nb::dict dict;
        dict["pixels"] = check->found.pixels;
        dict["rmse"] = check->found.rmse;
        dict["bound95"] = check->found.rmseBound;
        dict["max"] = check->found.max;
        dict["unseen_share"] = check->found.unseenShare;
        return dict;
    }

    nb::dict probe(const BoundCamera& camera, int x, int y) {
        const auto probe = std::make_shared<PixelProbe>();
        with([probe, camera, x, y](Renderer& renderer) { *probe = renderer.probe(camera.camera(), x, y); });
        nb::list segments;
        for (const PixelProbe::Segment& s : probe->segments)
            segments.append(nb::make_tuple(s.begin, s.end, s.scalarBegin, s.scalarEnd, s.alpha));
        nb::dict dict;
        dict["segments"] = segments;
        dict["hit"] = probe->hit;
        dict["distance"] = probe->distance;
        dict["position"] = probe->position;
        dict["scalar"] = probe->scalar;
        return dict;
    }

    /// (eye, target, up) of a view fitted to what shows, or without a name to the whole mesh, which an `up` along the
    /// usual direction turns.
    std::tuple<Vector, Vector, Vector> fittedCamera(const std::optional<std::string>& name,
                                                    const std::optional<Vector>& up, double fov, bool orthographic,
                                                    int width, int height) {
        FittedView view = name ? FittedView::named(*name) : FittedView();
        view.fovDegrees = fov;
        view.orthographic = orthographic;
        view.wholeMesh = !name;
        if (up) view.up = *up;
        if (!name && along(view.direction, view.up)) view.direction = {-1.5, -1.0, -0.7};
        const auto camera = std::make_shared<Camera>();
        with([camera, view, width, height](Renderer& renderer) {
            try {
                *camera = renderer.fittedCamera(view, width, height);
            } catch (const Error&) {
                if (view.wholeMesh) throw;
                FittedView whole = view;  // nothing shows: then where it would
                whole.wholeMesh = true;
                *camera = renderer.fittedCamera(whole, width, height);
            }
        });
        return {camera->eye, camera->target, camera->up};
    }

    void cancel() {
        const std::lock_guard lock(stopMutex_);
        stop_.request_stop();
    }

    void close() {
        cancel();
        try {  // where it was used: contexts of OpenGL are their thread's
            thread_.run([renderer = renderer_] { renderer->reset(); });
        } catch (
            ...) {  // closed already, or a signal's handler raised, or the process has forked: then it ends with that
        }
        thread_.close();
    }

    std::pair<std::string, std::string> names() {
        const auto names = std::make_shared<std::pair<std::string, std::string>>();
        with([names](Renderer& renderer) { *names = {renderer.engine(), renderer.renderer()}; });
        return *names;
    }

private:
    static std::shared_ptr<Frame> frameOf(Frame frame) {
        return std::const_pointer_cast<Frame>(ownerOf(std::move(frame)));
    }

    std::shared_ptr<std::optional<Renderer>> renderer_;
    std::mutex stopMutex_;
    std::stop_source stop_;
    FrameThread thread_;
};

BoundCamera cameraOf(const Vector& eye, const Vector& target, const Vector& up, double fov, double height,
                     const std::array<double, 2>& centre) {
    return {eye, target, up, fov, height, centre};
}

std::vector<Surface> surfacesOf(const std::vector<std::tuple<Points, Triangles, Vector, bool>>& given) {
    std::vector<Surface> surfaces;
    for (const auto& [points, triangles, color, flat] : given) {
        Surface surface;
        for (std::size_t i = 0; i < points.shape(0); ++i)
            surface.points.push_back({points(i, 0), points(i, 1), points(i, 2)});
        for (std::size_t i = 0; i < triangles.shape(0); ++i)
            surface.triangles.push_back({triangles(i, 0), triangles(i, 1), triangles(i, 2)});
        surface.color = color;
        surface.flat = flat;
        surfaces.push_back(std::move(surface));
    }
    return surfaces;
}

void bindSetters(nb::class_<BoundRenderer>& bound) {
    bound
        .def(
            "set_field",
            [](BoundRenderer& self, const Field& field) {
                self.with([field](Renderer& renderer) { renderer.setField(field); });
            },
            "field"_a)
        .def(
            "set_transfer_function",
            [](BoundRenderer& self, const std::optional<TransferFunction>& function) {
                self.with([function](Renderer& renderer) { renderer.setTransferFunction(function); });
            },
            "function"_a.none())
        .def(
            "set_mode",
            [](BoundRenderer& self, const std::string& name) {
                const Mode mode = modeOf(name);
                self.with([mode](Renderer& renderer) { renderer.setMode(mode); });
            },
            "name"_a)
        .def(
            "set_lighting",
            [](BoundRenderer& self, const std::string& document) {
                self.with([document](Renderer& renderer) { renderer.setLighting(document); });
            },
            "document"_a)
        .def(
            "set_silhouettes",
            [](BoundRenderer& self, const std::string& name) {
                const Silhouettes silhouettes = silhouettesOf(name);
                self.with([silhouettes](Renderer& renderer) { renderer.setSilhouettes(silhouettes); });
            },
            "name"_a)
        .def(
            "set_samples",
            [](BoundRenderer& self, int samples) {
                self.with([samples](Renderer& renderer) { renderer.setSamples(samples); });
            },
            "samples"_a)
        .def(
            "set_cuts",
            [](BoundRenderer& self, const std::vector<std::pair<Vector, Vector>>& planes) {
                std::vector<Cut> cuts;
                for (const auto& [point, normal] : planes) cuts.push_back({point, normal});
                self.with([cuts](Renderer& renderer) { renderer.setCuts(cuts); });
            },
            "planes"_a)
        .def(
            "set_surfaces",
            [](BoundRenderer& self, const std::vector<std::tuple<Points, Triangles, Vector, bool>>& given) {
                const std::vector<Surface> surfaces = surfacesOf(given);
                self.with([surfaces](Renderer& renderer) { renderer.setSurfaces(surfaces); });
            },
            "surfaces"_a);
}

}  // namespace

void bindRenderer(nb::module_& module) {
    nb::class_<TransferFunction>(module, "TransferFunction", "Colour and extinction over the scalar.")
        .def_static(
            "parse", [](const std::string& json) { return TransferFunction::parse(json); }, "json"_a)
        .def_static(
            "load", [](const std::string& path) { return TransferFunction::load(path); }, "path"_a)
        .def_static(
            "preset", [](const std::string& name) { return TransferFunction::preset(name); }, "name"_a)
        .def("stretched", &TransferFunction::stretched, "low"_a, "high"_a, "Over these scalars.");
    module.def("color_maps", [] { return TransferFunction::colorMaps(); });
    module.def("opacities", [] { return TransferFunction::opacities(); });
    nb::class_<BoundCamera>(module, "Camera", "Where from and how.")
        .def(nb::new_(&cameraOf), "eye"_a, "target"_a, "up"_a, "fov"_a, "height"_a, "centre"_a);
    nb::class_<BoundRenderer> renderer(module, "Renderer", "Draws one mesh, frame by frame, in a thread of its own.");
    renderer
        .def(nb::init<const BoundMesh&, const std::string&, const std::string&, int>(), "mesh"_a, "engine"_a,
             "context"_a, "threads"_a)
        .def("render", &BoundRenderer::render, "rgba"_a.noconvert(), "camera"_a, "progress"_a.none(), "budget"_a,
             "depth_limit"_a.noconvert().none())
        .def("verify", &BoundRenderer::verify, "rgba"_a.noconvert(), "camera"_a, "pixels"_a)
        .def("probe", &BoundRenderer::probe, "camera"_a, "x"_a, "y"_a)
        .def("fitted_camera", &BoundRenderer::fittedCamera, "name"_a.none(), "up"_a.none(), "fov"_a, "orthographic"_a,
             "width"_a, "height"_a)
        .def("cancel", &BoundRenderer::cancel)
        .def("close", &BoundRenderer::close)
        .def("names", &BoundRenderer::names, "(engine, what does the work).");
    bindSetters(renderer);
    module.def(
        "camera_holding",
        [](const BoundMesh& mesh, int width, int height, const BoundCamera& like) {
            const Camera camera = cameraHolding(mesh.mesh->bounds(), width, height, like.camera());
            return std::pair(camera.eye, camera.target);
        },
        "mesh"_a, "width"_a, "height"_a, "like"_a, "(eye, target) of a view that holds the mesh.");
    module.def("presets", [] { return TransferFunction::presets(); });
    module.def("engines", [] {
        std::vector<EngineInfo> found;
        {
            const nb::gil_scoped_release unlocked;
            found = engines();
        }
        nb::list list;
        for (const EngineInfo& info : found) list.append(nb::make_tuple(info.name, info.available, info.whyNot));
        return list;
    });
}

}  // namespace tetralux::python
