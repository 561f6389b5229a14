// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_tiles.h>

#include <bit>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

namespace tetralux::projection {
namespace {

// The plan of gl_compute.glsl, of pairs instead of cells.
struct PairPlan {
    GLuint pairs, unused[3];
    GLuint sortGroups[3], rangeGroups[3];
};
struct Demand {
    GLuint mostPairs, roughPairs;
};
struct TileState {
    GLuint fragments, entries, entriesSaved, finished;
};
static_assert(sizeof(PairPlan) == 40 && sizeof(TileState) == 16);

GlDefines tileDefines(bool emit) {
    GlDefines defines;
    defines.set("TETRALUX_TILE_SIZE", glTileSize);
    defines.set("TETRALUX_EMIT", emit ? 1 : 0);
    return defines;
}

void clear(const GlFunctions& gl, const GlStorage& storage) {
    gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, storage.name());
    gl.ClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace

GlTiles::GlTiles(const GlFunctions& gl, GlCellLayout layout, std::size_t chunkCells, std::size_t capacity)
    : gl_(gl),
      layout_(layout),
      chunkCells_(chunkCells),
      groups_((chunkCells + glGroup - 1) / glGroup),
      count_(gl, tileDefines(false), {"projection/gl/gl_tile_outline.glsl", "projection/gl/gl_tile_bin.comp"}),
      emit_(gl, tileDefines(true), {"projection/gl/gl_tile_outline.glsl", "projection/gl/gl_tile_bin.comp"}),
      planning_(gl, {}, {"projection/gl/gl_tile_plan.comp"}),
      ranging_(gl, {}, {"projection/gl/gl_tile_ranges.comp"}),
      sort_(gl, 0),
      cellPairs_(gl, chunkCells * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      groupPairs_(gl, (groups_ + 1) * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY),
      demand_(gl, sizeof(Demand), nullptr, GL_DYNAMIC_READ),
      plan_(gl, sizeof(PairPlan), nullptr, GL_DYNAMIC_COPY) {
    makeRoom(capacity);
}

void GlTiles::makeRoom(std::size_t pairs) {
    pairs_.reset();
    scratch_.reset();
    sort_.reserve(pairs);
    pairs_.emplace(gl_, pairs * 2 * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY);
    scratch_.emplace(gl_, pairs * 2 * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY);
    capacity_ = pairs;
}

void GlTiles::begin(const CameraFrame& frame, GLuint texture) {
    if (!scratch_) makeRoom(capacity_);  // the last frame asked for more than there is
    if (frame.width != width_ || frame.height != height_) {
        width_ = frame.width;
        height_ = frame.height;
        columns_ = (width_ + glTileSize - 1) / glTileSize;
        rows_ = (height_ + glTileSize - 1) / glTileSize;
        const auto tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
        ranges_.emplace(gl_, tiles * 2 * sizeof(GLuint), nullptr, GL_DYNAMIC_COPY);
        states_.emplace(gl_, tiles * sizeof(TileState), nullptr, GL_DYNAMIC_READ);
    }
    texture_ = texture;
    clear(gl_, *states_);
    clear(gl_, demand_);
}

/// Counts or writes the chunk's pairs; `last`: the buffer at the last binding point.
void GlTiles::bin(const GlKernel& kernel, GLuint plan, GLuint vertices, std::size_t chunkBegin, GLuint last) const {
    kernel.use();
    gl_.Uniform2i(kernel.uniform("viewSize"), width_, height_);
    kernel.set("chunkBegin", chunkBegin);
    kernel.set("chunkCells", chunkCells_);
    kernel.set("cornerStride", layout_.slots());
    kernel.set("capacity", capacity_);
    bindStorage(gl_, {plan, vertices, states_->name(), cellPairs_.name(), groupPairs_.name(), last});
    kernel.run(chunkCells_);
}

void GlTiles::draw(GLuint plan, GLuint vertices, std::size_t chunkBegin, const std::function<void()>& useProgram) {
    bin(count_, plan, vertices, chunkBegin, demand_.name());
    sort_.scan(plan, groupPairs_.name(), groups_);
    planning_.use();
    planning_.set("groups", groups_);
    planning_.set("capacity", capacity_);
    bindStorage(gl_, {plan_.name(), groupPairs_.name(), demand_.name()});
    planning_.run(1);
    bin(emit_, plan, vertices, chunkBegin, pairs_->name());

    gl_.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, plan_.name());
    const auto tileBits = static_cast<unsigned>(std::bit_width(static_cast<unsigned>(columns_ * rows_ - 1)));
    sort_.sortBits(plan_.name(), offsetof(PairPlan, sortGroups), pairs_->name(), scratch_->name(), tileBits);
    clear(gl_, *ranges_);
    ranging_.use();
    bindStorage(gl_, {plan_.name(), pairs_->name(), ranges_->name()});
    ranging_.runIndirect(offsetof(PairPlan, rangeGroups));

    useProgram();
    gl_.BindImageTexture(0, texture_, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    bindStorage(gl_, {plan_.name(), pairs_->name(), ranges_->name(), vertices, states_->name()});
    gl_.DispatchCompute(static_cast<GLuint>(columns_), static_cast<GLuint>(rows_), 1);
    gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl_.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, plan);
}

bool GlTiles::overflowed() {
    Demand demand{};
    demand_.read(sizeof(demand), &demand);
    if (demand.mostPairs <= capacity_) return false;
    makeRoom(demand.mostPairs + demand.mostPairs / std::size_t{4});
    return true;
}

GlTileCounts GlTiles::counts() const {
    std::vector<TileState> states(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    states_->read(states.size() * sizeof(TileState), states.data());
    GlTileCounts counts;
    for (const TileState& state : states) {
        counts.fragments += state.fragments;
        counts.entries += state.entries;
        counts.entriesSaved += state.entriesSaved;
        counts.retired += state.finished;
    }
    return counts;
}

}  // namespace tetralux::projection
