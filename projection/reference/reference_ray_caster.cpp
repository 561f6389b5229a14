// SPDX-License-Identifier: Apache-2.0
#include <projection/reference/reference_ray_caster.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/cell_slope.h>
#include <projection/cells/cell_setup.h>
#include <projection/cells/cell_shading.h>
#include <projection/core/perturbed_isosurfaces.h>
#include <projection/light/light_frame.h>
#include <projection/reference/pixel_candidates.h>
#include <projection/reference/reference_cut.h>
#include <projection/reference/reference_light.h>
#include <projection/reference/reference_segment.h>
#include <projection/reference/wanted_pixels.h>

namespace tetralux::projection {

namespace {

/// Rays run this much beside the pixel's centre (pixels), so that none lies exactly within faces of a grid that is
/// aligned with the view. It moves the picture by some 1e-10.
constexpr double rayShiftX = 0x1p-32, rayShiftY = 0x1p-33;

/// A faint segment that is shorter than this share of a pixel is there only because the ray stands beside the centre:
/// at the centre it touches the cell's edge, which is no hit.
constexpr double touchedPixels = 0x1p-24;

}  // namespace

/// One rendering of one camera: the image is halved until one pixel is left, the cells with it.
struct ReferenceRayCaster::Pass {
    const ReferenceRayCaster& caster;
    const CameraFrame frame;
    const DepthRange depths;
    const PixelMaps* const maps;
    const FrameControl* const control;
    Image& image;
    WantedPixels wanted;
    std::vector<glm::dvec3> points;  // camera space: pixels·depth (or pixels when orthographic) twice, and depth
    std::vector<std::atomic<bool>> met;
    std::atomic<std::uint64_t> segmentCount{0}, overlapCount{0};

    Pass(const ReferenceRayCaster& c, const View& view, Image& target)
        : caster(c),
          frame(cameraFrame(view.camera)),
          depths(depthRange(c.scene_.mesh->bounds, view.camera)),
          maps(view.maps),
          control(view.control),
          image(target),
          met(c.scene_.mesh->cells.size()) {
        checkPixelMaps(view);
    }

    void seePoints() {
        const mesh::ScalarMesh& mesh = *caster.scene_.mesh;
        points.resize(mesh.positions.size());
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
            const glm::dvec3 p = mesh.positions[i] - frame.eye;
            points[i] = {glm::dot(p, frame.columnAxis) / frame.pixel, glm::dot(p, frame.rowAxis) / frame.pixel,
                         glm::dot(p, frame.forward)};
        });
    }

    /// Whether a cell reaches beyond the line `position` of the image (pixels from the axis) on the side `sign`. The
    /// line and the eye span a plane; this holds also for what lies behind the eye.
    bool reaches(mesh::CellIndex cell, int axis, double position, double sign) const {
        return anyCorner(cell, [&](const glm::dvec3& p) {
            return sign * (p[axis] - position * (frame.orthographic ? 1.0 : p.z)) >= 0;
        });
    }

    template <class Predicate>
    bool anyCorner(mesh::CellIndex cell, Predicate predicate) const {
        const mesh::Tetrahedron& corners = caster.scene_.mesh->cells[cell];
        return std::any_of(corners.begin(), corners.end(), [&](mesh::PointIndex p) { return predicate(points[p]); });
    }

    std::vector<mesh::CellIndex> beyond(const std::vector<mesh::CellIndex>& cells, int axis, double position,
                                        double sign) const {
        std::vector<mesh::CellIndex> result;
        std::copy_if(cells.begin(), cells.end(), std::back_inserter(result),
                     [&](mesh::CellIndex cell) { return reaches(cell, axis, position, sign); });
        return result;
    }

    /// Whether the cell may meet a ray that is asked for: by the corners' bounds where all are in front of the eye.
    bool mayMeet(mesh::CellIndex cell) const {
        constexpr double halfPixel = 0.5;
        if (!reaches(cell, 0, -halfPixel - frame.centre.x, 1) ||
            !reaches(cell, 0, frame.width - halfPixel - frame.centre.x, -1) ||
            !reaches(cell, 1, -halfPixel - frame.centre.y, 1) ||
            !reaches(cell, 1, frame.height - halfPixel - frame.centre.y, -1))
            return false;
        if (!anyCorner(cell, [](const glm::dvec3& p) { return p.z > 0; })) return false;
        if (wanted.all() || anyCorner(cell, [&](const glm::dvec3& p) { return !frame.orthographic && p.z <= 0; }))
            return true;
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
        anyCorner(cell, [&](const glm::dvec3& p) {
            const glm::dvec2 at = glm::dvec2(p) / (frame.orthographic ? 1.0 : p.z) + frame.centre;
            low = glm::min(low, at);
            high = glm::max(high, at);
            return false;
        });
        auto pixel = [](double x, int limit) {
            return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(limit)));
        };
        constexpr double rounding = 0.01;
        return wanted.any(pixel(std::ceil(low.x - rounding), frame.width),
                          pixel(std::ceil(low.y - rounding), frame.height),
                          pixel(std::floor(high.x + rounding) + 1, frame.width),
                          pixel(std::floor(high.y + rounding) + 1, frame.height));
    }

    void renderAll() {
        seePoints();
        constexpr std::size_t chunk = 8192;
        std::vector<std::vector<mesh::CellIndex>> parts(met.size() / chunk + 1);
        tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
            for (std::size_t cell = i * chunk; cell < std::min(met.size(), (i + 1) * chunk); ++cell)
                if (mayMeet(static_cast<mesh::CellIndex>(cell))) parts[i].push_back(static_cast<mesh::CellIndex>(cell));
        });
        std::vector<mesh::CellIndex> cells;
        for (const auto& part : parts) cells.insert(cells.end(), part.begin(), part.end());
        renderBlock(0, 0, frame.width, frame.height, std::move(cells));
    }

    /// Pixels [x0, x1) × [y0, y1), which only `cells` can meet.
    void renderBlock(int x0, int y0, int x1, int y1, std::vector<mesh::CellIndex> cells) {
        if (cells.empty() || !wanted.any(x0, y0, x1, y1)) return;
        if (x1 - x0 == 1 && y1 - y0 == 1) {
            renderPixel(x0, y0, cells);
            return;
        }
        const int axis = x1 - x0 >= y1 - y0 ? 0 : 1;
        const int middle = axis == 0 ? (x0 + x1) / 2 : (y0 + y1) / 2;
        const double line = middle - 0.5 - frame.centre[axis];
        auto low = [&] {
            renderBlock(x0, y0, axis == 0 ? middle : x1, axis == 1 ? middle : y1, beyond(cells, axis, line, -1));
        };
        auto high = [&] {
            renderBlock(axis == 0 ? middle : x0, axis == 1 ? middle : y0, x1, y1, beyond(cells, axis, line, 1));
        };
        if ((x1 - x0) * (y1 - y0) > 256) {
            tbb::parallel_invoke(low, high);
        } else {
            low();
            high();
        }
    }

    /// Only the pixels that are named, each by the cells over it. For a few: the lists grow with them.
    void renderFew(const std::vector<std::uint32_t>& pixels) {
        const PixelCandidates candidates(*caster.scene_.mesh, frame, pixels);
        const auto width = static_cast<std::uint32_t>(frame.width);
        tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
            renderPixel(static_cast<int>(pixels[i] % width), static_cast<int>(pixels[i] / width), candidates.of(i));
        });
    }

    void renderPixel(int x, int y, std::span<const mesh::CellIndex> cells) {
        checkStop(control);
        const Ray ray = pixelRay(frame, x + rayShiftX, y + rayShiftY);
        const RayFrame rayFrame(ray);
        std::vector<RaySegment> segments;
        for (mesh::CellIndex cell : cells)
            if (auto segment = cut(rayFrame, *caster.scene_.mesh, cell)) {
                segments.push_back(*segment);
                met[cell].store(true, std::memory_order_relaxed);
            }
        PixelLimits limits = limitsAt(
            maps, static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x));
        limits.depths = depths;
        (frame.orthographic ? limits.pixelAtEye : limits.pixelPerDistance) = frame.pixel;
        image.at(x, y) = glm::vec4(caster.colorOf(ray, limits, segments));
        segmentCount += segments.size();
        for (std::size_t i = 1; i < segments.size(); ++i)
            if (segments[i].tIn < segments[i - 1].tOut - 1e-9 * (segments[i - 1].tOut - segments[i - 1].tIn) -
                                      1e-12 * segments[i - 1].tOut)
                ++overlapCount;
    }
};

ReferenceRayCaster::ReferenceRayCaster(const Scene& scene)
    : scene_(withPerturbedIsosurfaces(withVertexLight(scene), doublePerturbation)), exact_(scene_.transferFunction) {}

Image ReferenceRayCaster::render(const View& view, RayCastCounts& counts) const {
    Image image(view.camera.width, view.camera.height);
    Pass pass(*this, view, image);
    pass.renderAll();
    counts.segments = pass.segmentCount;
    counts.overlaps = pass.overlapCount;
    counts.cellsDrawn = static_cast<std::uint64_t>(
        std::count_if(pass.met.begin(), pass.met.end(), [](const std::atomic<bool>& m) { return m.load(); }));
    return image;
}

void ReferenceRayCaster::renderPixels(const View& view, const std::vector<std::uint32_t>& pixels, Image& image) const {
    if (pixels.empty()) return;
    Pass pass(*this, view, image);
    for (std::uint32_t pixel : pixels) image.pixels[pixel] = glm::vec4(0);
    constexpr std::size_t few = 8192;
    if (pixels.size() <= few && PixelCandidates::possible(scene_.mesh->bounds, pass.frame)) {
        pass.renderFew(pixels);
        return;
    }
    pass.wanted = WantedPixels(pixels, image.width, image.height);
    pass.renderAll();
}

std::vector<RaySegment> ReferenceRayCaster::segmentsAt(const Camera& camera, double x, double y) const {
    const RayFrame ray(pixelRay(cameraFrame(camera), x + rayShiftX, y + rayShiftY));
    std::vector<RaySegment> segments;
    for (std::size_t cell = 0; cell < scene_.mesh->cells.size(); ++cell)
        if (auto segment = cut(ray, *scene_.mesh, static_cast<mesh::CellIndex>(cell))) segments.push_back(*segment);
    std::sort(segments.begin(), segments.end(), [](const auto& a, const auto& b) { return a.tIn < b.tIn; });
    return segments;
}

namespace {

/// Premultiplied colour and transmittance gathered front to back.
struct Gathered {
    glm::dvec3 color{0};
    double transmittance = 1.0;

    void add(const glm::dvec3& premultiplied, double opacity) {
        color += transmittance * premultiplied;
        transmittance *= 1.0 - opacity;
    }
    glm::dvec4 pixel() const { return {color, 1.0 - transmittance}; }
};

/// Colour (premultiplied by opacity; in modes that hide nothing by depth), opacity and depth of one segment after
/// silhouette and light.
struct Shaded {
    glm::dvec3 color;
    double opacity, depth;
};

/// Depth-based colouring, at the middle of a segment.
glm::dvec3 colorAtDepth(const shading::ShadingSettings& shading, const DepthRange& depths, double distance,
                        const glm::dvec3& color) {
    if (!shading.depthColor) return color;
    return glm::mix(color, shading.depthColor->color, shading.depthColor->strength * depths.shareAt(distance));
}

/// The sign of s_f − s_b, also where less than rounding of the scalars is left of it: that of −g·d. `cosine` = n·d.
double signOfFall(const RaySegment& segment, double cosine) {
    constexpr double rounding = 0x1p-48;
    const double fall = segment.scalarIn - segment.scalarOut;
    const double size = std::max(std::abs(segment.scalarIn), std::abs(segment.scalarOut));
    const double sign = std::abs(fall) > rounding * size ? fall : -cosine;
    return sign > 0 ? 1.0 : sign < 0 ? -1.0 : 0.0;
}

/// Whether the colour of segments in light is seen, so that what light falls on divides them.
bool showsLight(const RenderSettings& settings) {
    switch (settings.mode) {
        case Mode::Standard:
        case Mode::ScaleInvariant:
        case Mode::FirstHit:
        case Mode::Additive:
        case Mode::DataAdditive:
        case Mode::Emission:
            return settings.shading.lit();
        default:
            return false;
    }
}

/// Size of the gradient that a silhouette follows, of the cell or smoothed, and the cosine between it and `direction`;
/// 1 where it is 0.
struct SilhouetteSlope {
    double steepness, cosine;
};
SilhouetteSlope silhouetteSlope(const Scene& scene, mesh::CellIndex cell, const mesh::CellSlope& slope,
                                const glm::dvec3& middle, const glm::dvec3& direction) {
    if (!scene.settings.shading.smoothSilhouettes()) return {slope.magnitude, glm::dot(slope.normal, direction)};
    const glm::dvec3 gradient = smoothGradient(scene, cell, middle);
    const double size = glm::length(gradient);
    const mesh::ScalarMesh& mesh = *scene.mesh;
    return {size * (mesh.scalarMax - mesh.scalarMin) / mesh.bounds.diagonal(),
            size > 0 ? glm::dot(gradient, direction) / size : 1.0};
}

Shaded shade(const preint::ExactIntegral& exact, const Scene& scene, const Ray& ray, const RaySegment& segment,
             const glm::dvec3& cutNormal, const DepthRange& depths, double scale) {
    const auto& shading = scene.settings.shading;
    const preint::Integral integral = integralOf(scene.settings.mode);
    const double length = segment.tOut - segment.tIn;
    const glm::dvec3 middle = ray.origin + (0.5 * segment.tIn + 0.5 * segment.tOut) * ray.direction;
    const auto [unlitColor, plainDepth, smooth] = unshadedSegment(exact, scene, segment, middle, scale);
    const bool hides = !addsUp(scene.settings.mode);
    double factor = 1.0;
    glm::dvec3 meanColor = unlitColor;
    double depth = plainDepth, plain = plainDepth;

    const mesh::CellSlope slope =
        shading.needsGradient() ? mesh::cellSlope(*scene.mesh, segment.cell) : mesh::CellSlope{glm::dvec3(0), 0};
    const auto& [normal, magnitude] = slope;
    const double variation = std::abs(segment.scalarOut - segment.scalarIn);
    const bool enhanced = shading.silhouette && (shading.smoothSilhouettes() || slope.any());
    if (enhanced) {
        const auto [steepness, cosine] = silhouetteSlope(scene, segment.cell, slope, middle, ray.direction);
        double smoothTimesK = 0.0, other = depth;
        if (integral == preint::Integral::ScaleInvariant && !scene.settings.contributions.perCell) {
            const double meanExtinction =
                variation > 0 ? smooth / variation : exact.function().extinctionAt(segment.scalarIn);
            smoothTimesK = meanExtinction * steepness * length;
            other = std::isinf(depth) ? depth : std::max(0.0, depth - smooth);
            if (variation == 0) meanColor = exact.function().colorAt(segment.scalarIn);
        }
        depth = glsl::silhouetteDepth(smoothTimesK, other, cosine);
    }
    if (shading.gradientOpacity > 0) {  // Levoy's (Kraus 2005, Equation 18), with |g| in ranges per diagonal
        const SceneUnits units = sceneUnits(*scene.mesh);
        factor = shading.gradientOpacity * magnitude * units.length / units.scalarScale;
    }
    if (scene.settings.classification == Classification::PostLinear) {  // Equation 11: the depth whose α is min(1, τ·P)
        const double linear = factor * plain;
        factor = linear > 1e-12 ? -std::log1p(-std::min(linear, 1.0)) / plain : factor;
    }
    depth = depth > 0 && factor > 0 ? depth * factor : 0.0;
    plain = plain > 0 && factor > 0 ? plain * factor : 0.0;
    double opacity = -std::expm1(-depth);
    if (shading.approximateSilhouette && enhanced)
        opacity = glsl::approximateSilhouetteOpacity(-std::expm1(-plain), std::min(plain, 1e30), std::min(depth, 1e60));
    const double weight = hides ? opacity : depth;
    const double fromEye = 0.5 * segment.tIn + 0.5 * segment.tOut;
    if (!shading.lit()) return {colorAtDepth(shading, depths, fromEye, meanColor) * weight, opacity, depth};

    const bool cut = segment.inCutLayer;
    SegmentToLight lit;
    lit.cell = segment.cell;
    lit.middle = middle;
    lit.direction = ray.direction;
    lit.fromEye = fromEye;
    lit.normal = cut ? cutNormal : normal;
    lit.fieldNormal = normal;
    lit.front = segment.scalarIn;
    lit.back = segment.scalarOut;
    lit.cut = cut;
    lit.side = cut ? 1.0 : signOfFall(segment, glm::dot(normal, ray.direction));
    lit.color = meanColor;
    lit.opacity = opacity;
    return {colorAtDepth(shading, depths, fromEye, litColor(scene, lit)) * weight, opacity, depth};
}

}  // namespace

ReferenceRayCaster::PixelLimits ReferenceRayCaster::limitsAt(const PixelMaps* maps, std::size_t pixel) {
    PixelLimits limits;
    if (maps == nullptr) return limits;
    if (!maps->nearest.empty()) limits.nearest = maps->nearest[pixel];
    if (!maps->farthest.empty()) limits.farthest = maps->farthest[pixel];
    if (!maps->cutLayerEnd.empty()) {
        limits.cutLayerEnd = maps->cutLayerEnd[pixel];
        limits.cutNormal = maps->cutNormal[pixel];
    }
    if (!maps->extinctionScale.empty()) limits.extinctionScale = static_cast<double>(maps->extinctionScale[pixel]);
    const auto [first, last] =
        std::equal_range(maps->translucent.begin(), maps->translucent.end(),
                         TranslucentFragment{static_cast<std::uint32_t>(pixel), 0.0, {}},
                         [](const TranslucentFragment& a, const TranslucentFragment& b) { return a.pixel < b.pixel; });
    limits.translucent = {first, last};
    return limits;
}

glm::dvec4 ReferenceRayCaster::colorOf(const Ray& ray, const PixelLimits& limits,
                                       std::vector<RaySegment>& segments) const {
    if (limits.nearest > 0 || limits.farthest < HUGE_VAL)
        std::erase_if(segments, [&](RaySegment& s) { return !limit(s, limits.nearest, limits.farthest); });
    if (limits.cutLayerEnd > 0 && showsLight(scene_.settings)) splitAtLayerEnd(segments, limits.cutLayerEnd);
    const auto drawn = [&](const preint::ExactIntegral& exact) {
        return limits.translucent.empty() ? composite(ray, exact, limits, segments)
                                          : betweenTranslucent(ray, exact, limits, segments);
    };
    if (limits.extinctionScale == 1.0) return drawn(exact_);
    return drawn(preint::ExactIntegral(scaledExtinction(scene_.transferFunction, limits.extinctionScale)));
}

/// The volume up to each translucent fragment, the translucent fragment, what lies behind the last.
glm::dvec4 ReferenceRayCaster::betweenTranslucent(const Ray& ray, const preint::ExactIntegral& exact,
                                                  const PixelLimits& limits,
                                                  const std::vector<RaySegment>& segments) const {
    PixelLimits part = limits;
    glm::dvec4 sum(0);
    double begin = 0;
    for (std::size_t i = 0; i <= limits.translucent.size(); ++i) {
        const double end = i < limits.translucent.size() ? limits.translucent[i].distance : HUGE_VAL;
        std::vector<RaySegment> within = segments;
        std::erase_if(within, [&](RaySegment& s) { return !limit(s, begin, end); });
        sum += (1.0 - sum.w) * composite(ray, exact, part, within);
        if (i < limits.translucent.size()) sum += (1.0 - sum.w) * glm::dvec4(limits.translucent[i].color);
        begin = end;
    }
    return sum;
}

glm::dvec4 ReferenceRayCaster::composite(const Ray& ray, const preint::ExactIntegral& exact, const PixelLimits& limits,
                                         std::vector<RaySegment>& segments) const {
    if (segments.empty()) return glm::dvec4(0);
    std::sort(segments.begin(), segments.end(), [](const RaySegment& a, const RaySegment& b) {
        return a.tIn != b.tIn ? a.tIn < b.tIn : a.tOut < b.tOut;
    });
    const preint::TransferFunction& function = exact.function();
    const auto shaded = [&](const RaySegment& segment) {
        return shade(exact, scene_, ray, segment, limits.cutNormal, limits.depths, limits.extinctionScale);
    };
    switch (scene_.settings.mode) {
        case Mode::Standard:
        case Mode::ScaleInvariant: {
            Gathered gathered;
            for (const RaySegment& segment : segments) {
                const Shaded part = shaded(segment);
                gathered.add(part.color, part.opacity);
            }
            return gathered.pixel();
        }
        case Mode::Mip: {
            double largest = -std::numeric_limits<double>::infinity();
            for (const RaySegment& segment : segments)
                largest = std::max({largest, segment.scalarIn, segment.scalarOut});
            return {function.colorAt(largest), 1.0};
        }
        case Mode::Minimum: {
            double smallest = std::numeric_limits<double>::infinity();
            for (const RaySegment& segment : segments)
                smallest = std::min({smallest, segment.scalarIn, segment.scalarOut});
            return {function.colorAt(smallest), 1.0};
        }
        case Mode::Additive:
        case Mode::DataAdditive:
        case Mode::Emission: {
            glm::dvec3 color(0);
            double sum = 0;
            for (const RaySegment& segment : segments) {
                const Shaded part = shaded(segment);
                color += part.color;
                sum += part.depth;
            }
            if (!scene_.settings.contributions.sums) sum = std::min(sum, 1.0);
            return {color, scene_.settings.mode == Mode::Emission ? 0.0 : sum};
        }
        case Mode::Absorption: {
            double depth = 0;
            for (const RaySegment& segment : segments) depth += shaded(segment).depth;
            return {0, 0, 0, -std::expm1(-depth)};
        }
        case Mode::Contributions:
            break;  // drawn as the sums that it shows
        case Mode::Depth:
            for (const RaySegment& segment : segments)
                if (const auto distance = firstShownAt(exact, segment))
                    return {glm::dvec3(limits.depths.greyAt(*distance)), 1.0};
            return glm::dvec4(0);
        case Mode::Average: {
            double mean = 0, length = 0;  // from differences: of equal numbers it is that number
            for (const RaySegment& segment : segments) {
                const double l = segment.tOut - segment.tIn;
                length += l;
                mean += (0.5 * segment.scalarIn + 0.5 * segment.scalarOut - mean) * (l / length);
            }
            return {function.colorAt(mean), 1.0};
        }
        case Mode::FirstHit:
            for (const RaySegment& segment : segments) {
                const Shaded first = shaded(segment);
                const double pixel = limits.pixelAtEye + limits.pixelPerDistance * segment.tOut;
                const bool touched = segment.tOut - segment.tIn < touchedPixels * pixel && first.opacity < 1e-6;
                if (first.opacity > 0 && !touched) return {first.color / first.opacity, 1.0};
            }
            return glm::dvec4(0);
    }
    return glm::dvec4(0);
}

}  // namespace tetralux::projection
