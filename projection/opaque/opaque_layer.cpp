// SPDX-License-Identifier: Apache-2.0
#include <projection/opaque/opaque_layer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/plane_cut.h>
#include <projection/cells/point_pixel.h>
#include <projection/cells/ray_triangle.h>
#include <projection/image/ink.h>
#include <projection/light/arriving_light.h>
#include <projection/light/corner_normals.h>

namespace tetralux::projection {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double usualFeatureAngle = 40.0;  // degrees
constexpr int tileSize = 32;                // pixels
constexpr std::size_t tilePixels = std::size_t{tileSize} * tileSize;

/// A slice may lie in a clipping plane: rounding must not decide whether it shows.
constexpr double rangeTolerance = 1e-9;

struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // [x0, x1) × [y0, y1)
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

int clampedPixel(double position, int size) {
    return static_cast<int>(std::clamp(position, 0.0, static_cast<double>(size)));
}

void checkOpacity(const char* what, double opacity, Mode mode) {
    if (!(opacity >= 0.0) || !(opacity <= 1.0))
        throw std::runtime_error(
            fmt::format("{} opacity {}: not from 0 to 1; give a share of what is hidden", what, opacity));
    if (opacity < 1.0 && !composesParts(mode))
        throw std::runtime_error(fmt::format(
            "{0} opacity: this mode shows nothing behind a {0}; take standard, scale-invariant, first-hit or "
            "absorption, or {0}s of opacity 1",
            what));
}

std::vector<glm::dvec3> inksOf(const Isolines& lines, const preint::TransferFunction& function) {
    std::vector<glm::dvec3> inks;
    for (const double value : lines.values) inks.push_back(lines.color.value_or(inkUpon(function.colorAt(value))));
    return inks;
}

}  // namespace

OpaqueLayer::OpaqueLayer(const Scene& scene, const OpaqueObjects& objects)
    : bounds_(scene.mesh->bounds),
      transferFunction_(scene.transferFunction),
      shading_(scene.settings.shading),
      isolineWidth_(objects.isolines.width),
      isolineInks_(inksOf(objects.isolines, scene.transferFunction)),
      surfaces_(objects.surfaces) {
    if (shading_.needsShadows()) shadowAt_ = shadowsOf(scene);
    for (const Slice& slice : objects.slices) {
        checkOpacity("slice", slice.opacity, scene.settings.mode);
        const mesh::SurfaceMesh cut = mesh::cutByPlane(*scene.mesh, slice.point, slice.normal);
        if (cut.triangles.empty()) {
            const mesh::BoundingBox& box = scene.mesh->bounds;
            throw std::runtime_error(fmt::format(
                "slice through {},{},{}: misses the mesh; give a point within {},{},{} and {},{},{}", slice.point.x,
                slice.point.y, slice.point.z, box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z));
        }
        append(cut, {slice.opacity, true}, {});
        isolines_.push_back(mesh::isolines(cut, objects.isolines.values));
    }
    for (const OpaqueSurface& surface : surfaces_) {
        checkOpacity("surface", surface.opacity, scene.settings.mode);
        if (surface.byField && surface.mesh->scalars.empty())
            throw std::runtime_error("surface: it has no scalars to be coloured by; give it some, or one colour");
        std::optional<double> featureAngle = surface.featureAngle;
        if (!featureAngle && shading_.normals == shading::Normals::Smooth) featureAngle = usualFeatureAngle;
        append(*surface.mesh, {surface.opacity, surface.clipped}, featureAngle);
    }
}

void OpaqueLayer::append(const mesh::SurfaceMesh& part, const Object& look, std::optional<double> featureAngle) {
    const auto base = static_cast<mesh::PointIndex>(positions_.size());
    const auto object = static_cast<std::uint32_t>(objects_.size());
    objects_.push_back(look);
    const bool ofCells = part.association == mesh::Association::Cell && !part.scalars.empty();
    objects_.back().ofCells = ofCells;
    positions_.insert(positions_.end(), part.positions.begin(), part.positions.end());
    if (!ofCells) scalars_.insert(scalars_.end(), part.scalars.begin(), part.scalars.end());
    scalars_.resize(positions_.size());
    const auto normals = featureAngle ? cornerNormals(part, *featureAngle) : std::vector<std::array<glm::dvec3, 3>>();
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        const auto& [a, b, c] = part.triangles[i];
        triangles_.push_back({{base + a, base + b, base + c}, ofCells ? part.scalars[i] : 0.0, object, {}});
        if (featureAngle) triangles_.back().normals = normals[i];
    }
}

double OpaqueLayer::scalarAt(const Triangle& triangle, const TriangleCrossing& where) const {
    if (objects_[triangle.object].ofCells) return triangle.scalar;
    const auto& [a, b, c] = triangle.corners;
    return where.blend(scalars_[a], scalars_[b], scalars_[c]);
}

/// Unit, to the eye's side of the triangle; zero where it has no area.
glm::dvec3 OpaqueLayer::normalAt(const Triangle& triangle, const TriangleCrossing& where,
                                 const glm::dvec3& direction) const {
    const auto& [a, b, c] = triangle.corners;
    const glm::dvec3 across = glm::cross(positions_[b] - positions_[a], positions_[c] - positions_[a]);
    glm::dvec3 normal = across;
    const auto& [na, nb, nc] = triangle.normals;
    const glm::dvec3 smooth(where.blend(na.x, nb.x, nc.x), where.blend(na.y, nb.y, nc.y),
                            where.blend(na.z, nb.z, nc.z));
    if (glm::dot(smooth, smooth) > 0) normal = smooth;
    const double size = glm::length(normal);
    return size > 0 ? normal / (glm::dot(across, direction) > 0 ? -size : size) : glm::dvec3(0);
}

glm::dvec3 OpaqueLayer::surfaceColor(const OpaqueSurface& surface, const Triangle& triangle,
                                     const TriangleCrossing& where, const RayFrame& ray, double distance,
                                     double edgeCover) const {
    glm::dvec3 own = surface.byField ? transferFunction_.colorAt(scalarAt(triangle, where)) : surface.color;
    if (edgeCover > 0.0) own = glm::mix(own, surface.edges->color, edgeCover);
    if (surface.flat) return own;
    const glm::dvec3 normal = normalAt(triangle, where, ray.direction);
    if (normal == glm::dvec3(0)) return own;
    glm::dvec3 light = shading_.ambient * shading_.ambientColor;
    if (!shading_.lit()) light += (1.0 - glm::min(light, 1.0)) * std::max(0.0, -glm::dot(normal, ray.direction));
    const glm::dvec3 place = ray.origin + distance * ray.direction;
    for (const shading::Light& source : shading_.lights) {
        const ArrivingLight arriving = arrivingLight(source, place, ray.direction, distance);
        const double facing = glm::dot(normal, arriving.towards);
        if (facing > 0) light += (shadowAt_ ? shadowAt_(source, place) : 1.0) * facing * arriving.color;
    }
    return own * glm::min(light, 1.0);
}

glm::dvec3 OpaqueLayer::atDepth(const glm::dvec3& color, const DepthRange& depths, double distance) const {
    const auto& by = shading_.depthColor;
    return by ? glm::mix(color, by->color, by->strength * depths.shareAt(distance)) : color;
}

/// The transfer function's colour, as it is so that it can be read off; in shadow of the volume or of surfaces times
/// a + (1 − a)·(mean transmittance to the lights), a the ambient light. Lines are drawn upon it before.
glm::dvec3 OpaqueLayer::sliceColor(const Triangle& triangle, const TriangleCrossing& where, const glm::dvec3& place,
                                   const LineCover& line) const {
    glm::dvec3 color = transferFunction_.colorAt(scalarAt(triangle, where));
    if (line.share > 0) color = glm::mix(color, isolineInks_[line.value], double{line.share});
    if (!shadowAt_) return color;
    double arrives = 0;
    for (const shading::Light& source : shading_.lights) arrives += shadowAt_(source, place);
    arrives /= static_cast<double>(shading_.lights.size());
    const glm::dvec3 ambient = glm::min(shading_.ambient * shading_.ambientColor, 1.0);
    return color * (ambient + (1.0 - ambient) * arrives);
}

/// One camera's view of all triangles.
class OpaqueLayer::Frame {
public:
    Frame(const OpaqueLayer& layer, const Camera& camera, PixelMaps& maps)
        : layer_(layer),
          camera_(camera),
          frame_(cameraFrame(camera)),
          depths_(depthRange(layer.bounds_, camera)),
          maps_(maps),
          tilesAcross_(static_cast<std::size_t>((camera.width + tileSize - 1) / tileSize)),
          tileCount_(tilesAcross_ * static_cast<std::size_t>((camera.height + tileSize - 1) / tileSize)) {
        for (const auto& segments : layer.isolines_)
            isolines_.emplace_back(frame_, segments, layer.isolineWidth_, tileSize);
    }

    void render() {
        bin();
        hits_.assign(static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(frame_.height), {});
        translucent_.resize(tileCount_);
        tbb::parallel_for(std::size_t{0}, tileCount_, [&](std::size_t tile) { renderTile(tile); });
        for (std::size_t pixel = 0; pixel < hits_.size(); ++pixel)
            if (hits_[pixel].distance < infinite)
                putOpaque(camera_, maps_, pixel, hits_[pixel].distance, hits_[pixel].color);
        putTranslucent();
    }

private:
    /// Those that nothing opaque hides, in their order.
    void putTranslucent() {
        for (const auto& part : translucent_)
            for (const TranslucentFragment& fragment : part)
                if (fragment.distance < hits_[fragment.pixel].distance) maps_.translucent.push_back(fragment);
        std::sort(maps_.translucent.begin(), maps_.translucent.end());
    }

    struct Hit {
        double distance = infinite;  // along the pixel's unit ray
        glm::vec3 color{0};
    };

    /// Pixels whose rays can meet the triangle: those around its projection, or all when it reaches behind the eye.
    PixelBox boxOf(const Triangle& triangle) const {
        const PointPixel pixelOf(frame_);
        PixelBox all{0, 0, frame_.width, frame_.height};
        glm::dvec2 low(infinite), high(-infinite);
        double nearest = infinite, farthest = -infinite;
        for (const mesh::PointIndex corner : triangle.corners) {
            const glm::dvec3 p = layer_.positions_[corner] - frame_.eye;
            const double depth = pixelOf.depth(p);
            const glm::dvec2 at = pixelOf(p, depth);
            low = glm::min(low, at);
            high = glm::max(high, at);
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
        if (!(farthest > 0)) return {};
        if (!frame_.orthographic && !(nearest > 1e-9 * farthest)) return all;
        constexpr double margin = 1e-3;  // pixels, far above rounding
        return {clampedPixel(std::ceil(low.x - margin), all.x1), clampedPixel(std::ceil(low.y - margin), all.y1),
                clampedPixel(std::floor(high.x + margin) + 1, all.x1),
                clampedPixel(std::floor(high.y + margin) + 1, all.y1)};
    }

    template <class Use>
    void forEachTile(const PixelBox& box, Use use) const {
        if (box.empty()) return;
        for (int y = box.y0 / tileSize; y <= (box.y1 - 1) / tileSize; ++y)
            for (int x = box.x0 / tileSize; x <= (box.x1 - 1) / tileSize; ++x)
                use(static_cast<std::size_t>(y) * tilesAcross_ + static_cast<std::size_t>(x));
    }

    /// Triangles of each tile, ascending, so that the picture does not depend on the threads.
    void bin() {
        boxes_.resize(layer_.triangles_.size());
        tbb::parallel_for(std::size_t{0}, boxes_.size(),
                          [&](std::size_t i) { boxes_[i] = boxOf(layer_.triangles_[i]); });
        tiles_.resize(tileCount_);
        for (std::size_t i = 0; i < boxes_.size(); ++i)
            forEachTile(boxes_[i], [&](std::size_t tile) { tiles_[tile].push_back(static_cast<std::uint32_t>(i)); });
    }

    /// The tile's rays and what each has met so far.
    struct Tile {
        PixelBox box;
        std::array<RayFrame, tilePixels> rays;
        struct Met {
            double distance = infinite;
            const Triangle* triangle = nullptr;
            TriangleCrossing where{};
        };
        std::array<Met, tilePixels> met;
        std::vector<std::vector<LineCover>> lines;  // by slice, by slot; empty: none

        LineCover lineAt(std::uint32_t object, std::size_t slot) const {
            return object >= lines.size() || lines[object].empty() ? LineCover{} : lines[object][slot];
        }
        static std::size_t slot(const PixelBox& box, int x, int y) {
            return static_cast<std::size_t>(y - box.y0) * tileSize + static_cast<std::size_t>(x - box.x0);
        }
    };

    void renderTile(std::size_t number) {
        const std::vector<std::uint32_t>& members = tiles_[number];
        if (members.empty()) return;
        const auto tile = std::make_unique<Tile>();
        const int x0 = static_cast<int>(number % tilesAcross_) * tileSize,
                  y0 = static_cast<int>(number / tilesAcross_) * tileSize;
        tile->box = {x0, y0, std::min(x0 + tileSize, frame_.width), std::min(y0 + tileSize, frame_.height)};
        forEachPixel(tile->box,
                     [&](int x, int y) { tile->rays[Tile::slot(tile->box, x, y)] = RayFrame(pixelRay(frame_, x, y)); });
        for (const IsolinePixels& lines : isolines_) tile->lines.push_back(lines.inTile(number));
        for (const std::uint32_t index : members) meet(*tile, index, translucent_[number]);
        forEachPixel(tile->box, [&](int x, int y) {
            const std::size_t slot = Tile::slot(tile->box, x, y);
            const auto& [distance, triangle, where] = tile->met[slot];
            if (triangle != nullptr)
                hits_[pixelNumber(x, y)] = {distance, glm::vec3(colorOf(*triangle, where, tile->rays[slot], distance,
                                                                        tile->lineAt(triangle->object, slot)))};
        });
    }

    template <class Use>
    static void forEachPixel(const PixelBox& box, Use use) {
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x) use(x, y);
    }

    std::size_t pixelNumber(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) + static_cast<std::size_t>(x);
    }

    /// Which of the tile's rays the triangle is the nearest to so far; of a slice with opacity, all that it meets.
    void meet(Tile& tile, std::uint32_t index, std::vector<TranslucentFragment>& translucent) const {
        const Triangle& triangle = layer_.triangles_[index];
        const auto& [a, b, c] = triangle.corners;
        const std::array<glm::dvec3, 3> corners{layer_.positions_[a], layer_.positions_[b], layer_.positions_[c]};
        const PixelBox& box = boxes_[index];
        const PixelBox part{std::max(box.x0, tile.box.x0), std::max(box.y0, tile.box.y0), std::min(box.x1, tile.box.x1),
                            std::min(box.y1, tile.box.y1)};
        forEachPixel(part, [&](int x, int y) {
            const std::size_t slot = Tile::slot(tile.box, x, y);
            const RayFrame& ray = tile.rays[slot];
            const std::array<RayPoint, 3> seen{ray.see(corners[0]), ray.see(corners[1]), ray.see(corners[2])};
            const auto crossing = crossTriangle({seen[0].across, seen[1].across, seen[2].across}, triangle.corners);
            if (!crossing) return;
            const double t = crossing->blend(seen[0].t, seen[1].t, seen[2].t);
            if (!(t > 0) || (layer_.objects_[triangle.object].clipped && !inRange(pixelNumber(x, y), t))) return;
            if (const double bare = layer_.objects_[triangle.object].opacity; bare < 1.0) {
                LineCover line = tile.lineAt(triangle.object, slot);
                const double opacity = std::lerp(bare, 1.0, double{line.share});
                if (line.share > 0) line.share /= static_cast<float>(opacity);  // of what shows: lines are opaque
                const glm::dvec3 color = opacity * colorOf(triangle, *crossing, ray, t, line);
                translucent.push_back({static_cast<std::uint32_t>(pixelNumber(x, y)), t, glm::vec4(color, opacity)});
                return;
            }
            if (!(t < tile.met[slot].distance)) return;
            tile.met[slot] = {t, &triangle, *crossing};
        });
    }

    bool isSlice(const Triangle& triangle) const { return triangle.object < layer_.isolines_.size(); }

    /// How much of the pixel lines along the triangle's edges cover, as IsolinePixels tells it.
    double edgeCover(const SurfaceEdges& edges, const Triangle& triangle, const glm::dvec3& place) const {
        const PointPixel pixelOf(frame_);
        const auto pixel = [&](const glm::dvec3& at) {
            const glm::dvec3 p = at - frame_.eye;
            return pixelOf(p, pixelOf.depth(p));
        };
        for (const mesh::PointIndex corner : triangle.corners)
            if (!frame_.orthographic && !(pixelOf.depth(layer_.positions_[corner] - frame_.eye) > 0)) return 0.0;
        const glm::dvec2 here = pixel(place);
        double nearest = infinite;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 from = pixel(layer_.positions_[triangle.corners[k]]),
                             way = pixel(layer_.positions_[triangle.corners[(k + 1) % 3]]) - from;
            const double square = glm::dot(way, way);
            const double share = square > 0 ? std::clamp(glm::dot(here - from, way) / square, 0.0, 1.0) : 0.0;
            nearest = std::min(nearest, glm::length(here - from - share * way));
        }
        const double half = 0.5 * edges.width;
        return std::clamp(std::min(nearest + half, 0.5) - std::max(nearest - half, -0.5), 0.0, 1.0);
    }

    bool inRange(std::size_t pixel, double t) const {
        const double tolerance = rangeTolerance * t;
        return (maps_.nearest.empty() || t >= maps_.nearest[pixel] - tolerance) &&
               (maps_.farthest.empty() || t <= maps_.farthest[pixel] + tolerance);
    }

    glm::dvec3 colorOf(const Triangle& triangle, const TriangleCrossing& where, const RayFrame& ray, double distance,
                       const LineCover& line) const {
        if (!isSlice(triangle)) {
            const OpaqueSurface& surface = layer_.surfaces_[triangle.object - layer_.isolines_.size()];
            const double cover =
                surface.edges ? edgeCover(*surface.edges, triangle, ray.origin + distance * ray.direction) : 0.0;
            return layer_.atDepth(layer_.surfaceColor(surface, triangle, where, ray, distance, cover), depths_,
                                  distance);
        }
        return layer_.sliceColor(triangle, where, ray.origin + distance * ray.direction, line);
    }

    const OpaqueLayer& layer_;
    const Camera& camera_;
    const CameraFrame frame_;
    const DepthRange depths_;
    PixelMaps& maps_;
    std::size_t tilesAcross_, tileCount_;
    std::vector<IsolinePixels> isolines_;                        // of each slice
    std::vector<Hit> hits_;                                      // by pixel
    std::vector<std::vector<TranslucentFragment>> translucent_;  // by tile
    std::vector<PixelBox> boxes_;                                // by triangle
    std::vector<std::vector<std::uint32_t>> tiles_;              // triangles by tile
};

void OpaqueLayer::apply(const Camera& camera, PixelMaps& maps) const {
    if (!triangles_.empty()) Frame(*this, camera, maps).render();
}

}  // namespace tetralux::projection
