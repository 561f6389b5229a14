// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: cells that stay on the GPU. Positions, scalars, cells, gradients and the keys of the order are uploaded
/// once; a frame sends the camera, and an order of cells where there are no keys. Compute shaders project, cull, sort
/// and set up; what they write is drawn by indirect commands, so nothing comes back but the picture and some counts.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <mesh/tet/adjacency.h>
#include <projection/cells/camera_points.h>
#include <projection/gl/gl_cell_buffer.h>
#include <projection/gl/gl_tiles.h>
#include <projection/order/order_keys.h>

namespace tetralux::projection {

/// What the GPU found out about a frame, in this order in the plan (gl_compute.glsl).
struct GlFrameCounts {
    GLuint drawn = 0, outsideView = 0, noPixelCentre = 0;
    GLuint unsettled = 0;  ///< not 0: ties, or a relation that is broken: the order is uncertain, the picture of no use
};

class GlResidentCells {
public:
    /// `visible`: the cells that are ever drawn, ascending. `keys`: of the order, or nullptr; must outlive this.
    /// `adjacency`: whose relations the order by keys is checked against, or nullptr.
    /// \throws std::runtime_error when the driver refuses a shader or the mesh does not fit its buffers.
    GlResidentCells(const GlFunctions& gl, const mesh::ScalarMesh& mesh, const SceneUnits& units,
                    const std::vector<mesh::CellIndex>& visible, const OrderKeys* keys,
                    const mesh::Adjacency* adjacency, const std::vector<mesh::Tetrahedron>& attributeRows,
                    GlCellLayout layout, std::size_t mostChunkCells = softwareChunk);

    /// Cells that are set up and drawn at a time. Many keep a GPU busy: 2¹⁹ of them have 92 MB of vertices at most, and
    /// shaders see 128 MiB of a buffer at least. Software renderers begin earlier with fewer.
    static constexpr std::size_t softwareChunk = std::size_t{1} << 17, gpuChunk = std::size_t{1} << 19;
    std::size_t chunkCells() const { return chunkCells_; }

    /// Draws, with blending as it is set. `order`: some of the visible cells, the farthest first; nullptr: all of them,
    /// by keys or, without keys, as they come. `useCellProgram` makes the program
    /// current that draws cells. `margin`: of outlines, pixels.
    void draw(const CameraFrame& frame, const std::vector<mesh::CellIndex>* order, double margin,
              const std::function<void()>& useCellProgram);

    /// The same by compute tiles, for chunks of chunkCells(), into `texture`; `useTileProgram` makes theirs current.
    void drawTiles(const CameraFrame& frame, const std::vector<mesh::CellIndex>* order, double margin, GlTiles& tiles,
                   GLuint texture, const std::function<void()>& useTileProgram);

    /// Of the last frame drawn; waits for it.
    GlFrameCounts counts() const;

    std::uint64_t uploadedLast() const { return uploadedLast_; }  ///< bytes of the last frame

private:
    struct Kernels {
        GlKernel cull, setUp, check;
        Kernels(const GlFunctions& gl, const GlDefines& defines);
    };
    const Kernels& kernels(bool orthographic);
    void project(const CameraFrame& frame);
    void select(const Kernels& kernel, const CameraFrame& frame, GLuint candidates, std::size_t count);
    void check(const Kernels& kernel) const;
    void setView(const GlKernel& kernel, const CameraFrame& frame) const;
    std::size_t prepare(const CameraFrame& frame, const std::vector<mesh::CellIndex>* order);
    void beginSetUp(const CameraFrame& frame, double margin, bool reversed);
    const GlCellBuffer& setUpChunk(const Kernels& kernel, std::size_t chunk) const;

    const GlFunctions& gl_;
    SceneUnits units_;
    const OrderKeys* keys_;
    GlCellLayout layout_;
    bool cellData_, checks_, ownRows_;  // ownRows_: attributeRows_ are in the place of the cells' points
    std::size_t pointCount_, visibleCount_, groups_, chunkCells_, chunkCount_;
    std::uint64_t uploadedLast_ = 0;
    GlStorage positions_, scalars_, cells_, attributeRows_, visible_, gradients_, keyPlanes_, neighbours_;
    GlStorage cameraPoints_, flags_, groupCounts_, groupRanges_, keyed_, scratch_, places_, plan_;
    std::optional<GlStorage> order_;  // of cells, where a frame brings one
    GlKernel points_, planning_, compact_, placing_;
    std::unique_ptr<Kernels> kernels_[2];
    GlRadixSort sort_;
    GlCellIndices indices_;
    std::unique_ptr<GlCellBuffer> buffers_[2];
};

}  // namespace tetralux::projection
