// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_resident_cells.h>

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tetralux::projection {
namespace {

// The plan of gl_compute.glsl.
struct ChunkCommands {
    GLuint setUp[3], draw[5];
};
struct PlanHead {
    GlFrameCounts counts;
    GLuint sortGroups[3], settleGroups[3];
};
static_assert(sizeof(GlFrameCounts) == 16 && sizeof(PlanHead) == 40 && sizeof(ChunkCommands) == 32);

std::size_t chunkBytes(std::size_t chunk) {
    return sizeof(PlanHead) + chunk * sizeof(ChunkCommands);
}

std::vector<CellGradient> gradientsOf(const mesh::ScalarMesh& mesh, const SceneUnits& units, bool wanted) {
    std::vector<CellGradient> gradients(wanted ? mesh.cells.size() : 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, gradients.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            gradients[i] = unitGradient(mesh, units, static_cast<mesh::CellIndex>(i));
    });
    return gradients;
}

GlDefines keyDefines(bool keys) {
    GlDefines defines;
    defines.set("TETRALUX_KEYS", keys ? 1 : 0);
    return defines;
}

GlDefines cellDefines(const GlCellLayout& layout, bool keys, bool cellData, bool orthographic) {
    GlDefines defines = keyDefines(keys);
    defines.set("TETRALUX_ORTHOGRAPHIC", orthographic ? 1 : 0);
    defines.set("TETRALUX_GRADIENT", layout.gradient ? 1 : 0);
    defines.set("TETRALUX_ATTRIBUTES", layout.attributes ? 1 : 0);
    defines.set("TETRALUX_CELL_DATA", cellData ? 1 : 0);
    defines.set("TETRALUX_CELL_FLOATS", fmt::format("{}u", layout.floats()));
    return defines;
}

std::vector<std::string_view> cellFiles(std::string_view last) {
    return {"projection/gl/gl_cell_doubles.glsl",   "projection/cells/projected_cell.glsl",
            "projection/cells/covered_pixels.glsl", "projection/cells/cell_outline.glsl",
            "projection/gl/gl_cell_corners.glsl",   last};
}

}  // namespace

GlResidentCells::Kernels::Kernels(const GlFunctions& gl, const GlDefines& defines)
    : cull(gl, defines, cellFiles("projection/gl/gl_cull.comp")),
      setUp(gl, defines, cellFiles("projection/gl/gl_cell_setup.comp")),
      check(gl, defines, cellFiles("projection/gl/gl_order_check.comp")) {}

GlResidentCells::GlResidentCells(const GlFunctions& gl, const mesh::ScalarMesh& mesh, const SceneUnits& units,
                                 const std::vector<mesh::CellIndex>& visible, const OrderKeys* keys,
                                 const mesh::Adjacency* adjacency, const std::vector<mesh::Tetrahedron>& attributeRows,
                                 GlCellLayout layout, std::size_t mostChunkCells)
    : gl_(gl),
      units_(units),
      keys_(keys),
      layout_(layout),
      cellData_(mesh.association == mesh::Association::Cell),
      checks_(keys != nullptr && adjacency != nullptr),
      ownRows_(!attributeRows.empty()),
      pointCount_(mesh.positions.size()),
      visibleCount_(visible.size()),
      groups_((visible.size() + glGroup - 1) / glGroup),
      chunkCells_(std::clamp<std::size_t>(visible.size(), 1, mostChunkCells)),
      chunkCount_((visible.size() + chunkCells_ - 1) / chunkCells_),
      positions_(GlStorage::of(gl, mesh.positions)),
      scalars_(GlStorage::of(gl, mesh.scalars)),
      cells_(GlStorage::of(gl, mesh.cells)),
      attributeRows_(GlStorage::of(gl, attributeRows)),
      visible_(GlStorage::of(gl, visible)),
      gradients_(GlStorage::of(gl, gradientsOf(mesh, units, layout.gradient))),
      keyPlanes_(GlStorage::of(gl, keys != nullptr ? keys->planes() : std::vector<glm::dvec4>())),
      neighbours_(GlStorage::of(gl, checks_ ? adjacency->neighbours : decltype(adjacency->neighbours)())),
      cameraPoints_(gl, 3 * sizeof(double) * mesh.positions.size(), nullptr, GL_DYNAMIC_COPY),
      flags_(gl, visible.size() * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      groupCounts_(gl, (groups_ + 1) * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      groupRanges_(gl, (groups_ + 1) * sizeof(glm::dvec2), nullptr, GL_DYNAMIC_COPY),
      keyed_(gl, visible.size() * 2 * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      scratch_(gl, (keys != nullptr ? visible.size() : 0) * 2 * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      places_(gl, (checks_ ? mesh.cells.size() : 0) * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      plan_(gl, chunkBytes(chunkCount_), nullptr, GL_DYNAMIC_READ),
      points_(gl, {}, {"projection/gl/gl_points.comp"}),
      planning_(gl, keyDefines(keys != nullptr), {"projection/gl/gl_plan.comp"}),
      compact_(gl, keyDefines(keys != nullptr),
               {"projection/gl/gl_cell_doubles.glsl", "projection/order/order_position.glsl",
                "projection/gl/gl_compact.comp"}),
      placing_(gl, {}, {"projection/gl/gl_order_places.comp"}),
      sort_(gl, visible.size()),
      indices_(gl, layout, chunkCells_) {
    static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && sizeof(glm::dvec4) == 4 * sizeof(double));
    for (auto& buffer : buffers_)
        buffer = std::make_unique<GlCellBuffer>(gl, layout, chunkCells_, indices_, GL_DYNAMIC_COPY);
}

const GlResidentCells::Kernels& GlResidentCells::kernels(bool orthographic) {
    auto& made = kernels_[orthographic ? 1 : 0];
    if (!made) made = std::make_unique<Kernels>(gl_, cellDefines(layout_, keys_ != nullptr, cellData_, orthographic));
    return *made;
}

void GlResidentCells::setView(const GlKernel& kernel, const CameraFrame& frame) const {
    const glm::dvec2 centre = sampleCentre(frame);
    gl_.Uniform2d(kernel.uniform("viewCentre"), centre.x, centre.y);
    gl_.Uniform2i(kernel.uniform("viewSize"), frame.width, frame.height);
}

void GlResidentCells::project(const CameraFrame& frame) {
    const CameraAxes axes = cameraAxes(frame, units_);
    points_.use();
    points_.set("count", pointCount_);
    points_.set("eye", frame.eye);
    points_.set("right", axes.right);
    points_.set("down", axes.down);
    points_.set("forward", axes.forward);
    bindStorage(gl_, {plan_.name(), positions_.name(), cameraPoints_.name()});
    points_.run(pointCount_);
}

/// The candidates that cover pixels, to keyed_, and the plan of the rest of the frame.
void GlResidentCells::select(const Kernels& kernel, const CameraFrame& frame, GLuint candidates, std::size_t count) {
    const glm::dvec4 eye = keys_ != nullptr ? keys_->eye(frame) : glm::dvec4(0);
    const std::size_t groups = (count + glGroup - 1) / glGroup;
    kernel.cull.use();
    setView(kernel.cull, frame);
    kernel.cull.set("count", count);
    kernel.cull.set("keyEye", eye);
    bindStorage(gl_, {plan_.name(), cameraPoints_.name(), cells_.name(), candidates, flags_.name(), groupCounts_.name(),
                      groupRanges_.name(), keyPlanes_.name()});
    kernel.cull.run(count);
    sort_.scan(plan_.name(), groupCounts_.name(), groups);

    planning_.use();
    planning_.set("groups", groups);
    planning_.set("chunkCount", chunkCount_);
    planning_.set("chunkCells", chunkCells_);
    planning_.set("indicesPerCell", GlCellIndices::perCell);
    bindStorage(gl_, {plan_.name(), groupCounts_.name(), groupRanges_.name()});
    planning_.run(1);

    compact_.use();
    compact_.set("count", count);
    compact_.set("groups", groups);
    compact_.set("keyEye", eye);
    bindStorage(gl_, {plan_.name(), candidates, flags_.name(), groupCounts_.name(), keyed_.name(), groupRanges_.name(),
                      keyPlanes_.name()});
    compact_.run(count);
}

/// keepsFaceRelations of visibility_relations.h.
void GlResidentCells::check(const Kernels& kernel) const {
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, places_.name());
    gl_.ClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
    placing_.use();
    bindStorage(gl_, {plan_.name(), keyed_.name(), places_.name()});
    placing_.runIndirect(offsetof(PlanHead, settleGroups));
    kernel.check.use();
    bindStorage(gl_,
                {plan_.name(), cameraPoints_.name(), cells_.name(), keyed_.name(), places_.name(), neighbours_.name()});
    kernel.check.runIndirect(offsetof(PlanHead, settleGroups));
}

void GlResidentCells::beginSetUp(const CameraFrame& frame, double margin, bool reversed) {
    const GlKernel& setUp = kernels(frame.orthographic).setUp;
    setUp.use();
    setView(setUp, frame);
    setUp.set("chunkCells", chunkCells_);
    setUp.set("margin", margin);
    setUp.set("scalarOffset", units_.scalarOffset);
    setUp.set("scalarScale", units_.scalarScale);
    setUp.set("reversed", std::size_t{reversed ? 1u : 0u});
}

const GlCellBuffer& GlResidentCells::setUpChunk(const Kernels& kernel, std::size_t chunk) const {
    const GlCellBuffer& buffer = *buffers_[chunk % 2];
    kernel.setUp.use();
    kernel.setUp.set("chunkBegin", chunk * chunkCells_);
    bindStorage(gl_, {plan_.name(), cameraPoints_.name(), cells_.name(), scalars_.name(), keyed_.name(),
                      buffer.vertices(), gradients_.name(), ownRows_ ? attributeRows_.name() : cells_.name()});
    kernel.setUp.runIndirect(chunkBytes(chunk) + offsetof(ChunkCommands, setUp));
    return buffer;
}

/// All that comes before cells are set up: afterwards those that cover pixels stand in order in keyed_, by keys the
/// nearest first, else as they came. Their number is at most what is returned.
std::size_t GlResidentCells::prepare(const CameraFrame& frame, const std::vector<mesh::CellIndex>* order) {
    const Kernels& kernel = kernels(frame.orthographic);
    const PlanHead nothing{};
    plan_.write(sizeof(nothing), &nothing);
    uploadedLast_ = sizeof(nothing);
    const std::size_t count = order != nullptr ? order->size() : visibleCount_;
    if (count == 0) return 0;
    if (order != nullptr) {
        if (!order_) order_.emplace(gl_, visibleCount_ * sizeof(mesh::CellIndex), nullptr, GL_STREAM_DRAW);
        order_->write(count * sizeof(mesh::CellIndex), order->data());
        uploadedLast_ += count * sizeof(mesh::CellIndex);
    }
    gl_.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, plan_.name());
    gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, plan_.name());
    project(frame);
    select(kernel, frame, order == nullptr ? visible_.name() : order_->name(), count);
    if (keys_ != nullptr)
        sort_.sort(plan_.name(), offsetof(PlanHead, sortGroups), offsetof(PlanHead, settleGroups), keyed_.name(),
                   scratch_.name(), keyPlanes_.name(), keys_->eye(frame));
    if (checks_) check(kernel);
    return count;
}

void GlResidentCells::draw(const CameraFrame& frame, const std::vector<mesh::CellIndex>* order, double margin,
                           const std::function<void()>& useCellProgram) {
    const std::size_t count = prepare(frame, order);
    if (count == 0) return;
    beginSetUp(frame, margin, keys_ != nullptr);
    gl_.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    for (std::size_t chunk = 0; chunk * chunkCells_ < count; ++chunk) {
        const GlCellBuffer& buffer = setUpChunk(kernels(frame.orthographic), chunk);
        useCellProgram();
        gl_.BindVertexArray(buffer.vertexArray());
        gl_.DrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                 bufferOffset(chunkBytes(chunk) + offsetof(ChunkCommands, draw)));
    }
    gl_.BindVertexArray(0);
    checkGl(gl_, "resident cells");
}

void GlResidentCells::drawTiles(const CameraFrame& frame, const std::vector<mesh::CellIndex>* order, double margin,
                                GlTiles& tiles, GLuint texture, const std::function<void()>& useTileProgram) {
    const std::size_t count = prepare(frame, order);
    tiles.begin(frame, texture);
    if (count == 0) return;
    beginSetUp(frame, margin, keys_ == nullptr);
    for (std::size_t chunk = 0; chunk * chunkCells_ < count; ++chunk) {
        const GlCellBuffer& buffer = setUpChunk(kernels(frame.orthographic), chunk);
        tiles.draw(plan_.name(), buffer.vertices(), chunk * chunkCells_, useTileProgram);
    }
    checkGl(gl_, "compute tiles");
}

GlFrameCounts GlResidentCells::counts() const {
    GlFrameCounts counts;
    plan_.read(sizeof(counts), &counts);
    return counts;
}

}  // namespace tetralux::projection
