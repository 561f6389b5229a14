// SPDX-License-Identifier: Apache-2.0
/// \file
/// VTKHDF (VTK's documentation, "VTKHDF File Format", versions 1.0 to 2.4). VTK 9.1's own reader knows no time steps.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/io/bookkeeping_names.h>
#include <mesh/io/file_checks.h>
#include <mesh/io/ghost_fields.h>
#include <mesh/io/hdf5_group.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/nearest_time.h>
#include <mesh/soup/append_soup.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/grid_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsVtkHdf(const std::string& source) {
    return hasExtension(source, {".vtkhdf"});
}

std::uint64_t size(std::int64_t number, const char* what) {
    if (number < 0) {
        throw std::runtime_error(fmt::format("its {} is {}; write the file again", what, number));
    }
    return static_cast<std::uint64_t>(number);
}

/// One data set, as it is at one time step.
class VtkHdfGrid {
public:
    VtkHdfGrid(const Hdf5Group& group, std::optional<double> time) : group_(group), steps_(group.group("Steps")) {
        if (!steps_) {
            return;
        }
        const std::vector<std::uint64_t> values = steps_->shape("Values");
        times_ = values.empty() ? std::vector<double>() : steps_->reals("Values", 0, values[0]);
        if (times_.empty() || !std::all_of(times_.begin(), times_.end(), [](double t) { return std::isfinite(t); })) {
            throw std::runtime_error("its Steps have no Values, the times; write the file again");
        }
        const double chosen = nearestTime(times_, time);
        step_ = static_cast<std::uint64_t>(std::find(times_.begin(), times_.end(), chosen) - times_.begin());
    }

    CellSoup readUnstructured() {
        CellSoup soup;
        const std::vector<std::uint64_t> allParts = group_.shape("NumberOfPoints");
        const std::uint64_t firstPart = offset("PartOffsets").value_or(0);
        const std::uint64_t count = offset("NumberOfParts").value_or(allParts.empty() ? 0 : allParts[0]);
        const std::vector<std::int64_t> points = group_.integers("NumberOfPoints", firstPart, count);
        const std::vector<std::int64_t> cells = group_.integers("NumberOfCells", firstPart, count);
        const std::vector<std::int64_t> ids = group_.integers("NumberOfConnectivityIds", firstPart, count);
        Place place{offset("PointOffsets").value_or(0),
                    offset("CellOffsets").value_or(0),
                    offset("ConnectivityIdOffsets").value_or(0),
                    firstPart,
                    0,
                    0};
        for (std::size_t part = 0; part < points.size(); ++part) {
            const Sizes sizes{size(points[part], "number of points"), size(cells[part], "number of cells"),
                              size(ids[part], "number of connectivity ids")};
            appendSoup(soup, readPart(place, sizes));
            place.point += sizes.points;
            place.cell += sizes.cells;
            place.id += sizes.ids;
            place.pointOfStep += sizes.points;
            place.cellOfStep += sizes.cells;
            ++place.part;
        }
        soup.times = times_;
        return soup;
    }

    CellSoup readImage() {
        const std::vector<double> extent = group_.attribute("WholeExtent"), origin = group_.attribute("Origin"),
                                  spacing = group_.attribute("Spacing"), direction = group_.attribute("Direction");
        if (extent.size() != 6 || origin.size() != 3 || spacing.size() != 3) {
            throw std::runtime_error("its image has no WholeExtent, Origin or Spacing; write the file again");
        }
        std::array<std::size_t, 3> size{};
        GridFrame frame;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double points = extent[2 * axis + 1] - extent[2 * axis] + 1.0;
            if (!(points >= 1.0 && points < 1e9)) {
                throw std::runtime_error("its image has no points; write the file again");
            }
            size[axis] = static_cast<std::size_t>(points);
            for (std::size_t row = 0; row < 3; ++row) {
                const double along = direction.size() == 9 ? direction[3 * row + axis] : row == axis ? 1.0 : 0.0;
                frame.steps[axis][static_cast<int>(row)] = along * spacing[axis];
            }
            frame.origin[static_cast<int>(axis)] = origin[axis];
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            frame.origin += extent[2 * axis] * frame.steps[axis];
        }
        CellSoup soup;
        addGridCells(soup, size, cell_type::voxel);
        placeGrid(soup, size, frame);
        takeImageFields(soup, "PointData", Association::Point, soup.points.size(), size[2]);
        takeImageFields(soup, "CellData", Association::Cell, soup.types.size(), size[2] - 1);
        hideGhosts(soup);
        soup.times = times_;
        return soup;
    }

private:
    struct Sizes {
        std::uint64_t points, cells, ids;
    };
    /// Where a part begins: in the datasets of the mesh, and among the points and cells of its step.
    struct Place {
        std::uint64_t point, cell, id, part, pointOfStep, cellOfStep;
    };

    /// What Steps say of `name` for this step; nothing if they say nothing.
    std::optional<std::uint64_t> offset(const std::string& name) const {
        if (!steps_ || steps_->shape(name).empty()) {
            return std::nullopt;
        }
        const std::vector<std::int64_t> row = steps_->integers(name, step_, 1);
        return row.empty() ? std::nullopt : std::optional(size(row[0], "offset of a step"));
    }

    CellSoup readPart(const Place& place, const Sizes& sizes) const {
        CellSoup soup;
        if (sizes.points == 0 && sizes.cells == 0) {
            return soup;
        }
        const std::vector<double> x = group_.reals("Points", place.point, sizes.points);
        if (x.size() != 3 * sizes.points) {
            throw std::runtime_error("its Points have not three coordinates each; write the file again");
        }
        soup.points.resize(sizes.points);
        for (std::size_t i = 0; i < soup.points.size(); ++i) {
            soup.points[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
        }
        if (sizes.cells > 0) {
            takeCells(place, sizes, soup);
        }
        takeFields("PointData", Association::Point, place.point, place.pointOfStep, sizes.points, soup);
        takeFields("CellData", Association::Cell, place.cell, place.cellOfStep, sizes.cells, soup);
        hideGhosts(soup);
        return soup;
    }

    void takeCells(const Place& place, const Sizes& sizes, CellSoup& soup) const {
        for (const std::int64_t type : group_.integers("Types", place.cell, sizes.cells)) {
            if (type == cell_type::polyhedron) {
                throw std::runtime_error("has polyhedra, which are not read from VTKHDF; save it as .vtu in ParaView");
            }
            soup.types.push_back(type >= 0 && type < cell_type::gmshPyramid ? static_cast<std::uint8_t>(type)
                                                                            : std::uint8_t{255});
        }
        // Each part has one offset more than cells.
        for (const std::int64_t at : group_.integers("Offsets", place.cell + place.part, sizes.cells + 1)) {
            soup.offsets.push_back(static_cast<std::uint64_t>(at));
        }
        for (const std::int64_t id : group_.integers("Connectivity", place.id, sizes.ids)) {
            soup.connectivity.push_back(id >= 0 && id < static_cast<std::int64_t>(CellSoup::invalidPoint)
                                            ? static_cast<std::uint32_t>(id)
                                            : CellSoup::invalidPoint);
        }
        if (soup.offsets.front() != 0 || soup.offsets.back() != soup.connectivity.size() ||
            !std::is_sorted(soup.offsets.begin(), soup.offsets.end())) {
            throw std::runtime_error("the point lists of its cells do not fit together; write the file again");
        }
    }

    /// `first` values in if Steps say nothing of the field, else `ofStep` behind where they say that its step begins.
    void takeFields(const std::string& where, Association association, std::uint64_t first, std::uint64_t ofStep,
                    std::uint64_t count, CellSoup& soup) const {
        const std::optional<Hdf5Group> fields = group_.group(where);
        for (const std::string& name : fields ? fields->datasets() : std::vector<std::string>()) {
            const std::vector<std::uint64_t> shape = fields->shape(name);
            if (shape.empty()) {
                continue;  // text
            }
            const std::optional<std::uint64_t> step = offset(where + "Offsets/" + name);
            Field field = namedField(name, association);
            field.values = fields->reals(name, step ? *step + ofStep : first, count);
            field.components = static_cast<int>(
                std::accumulate(shape.begin() + 1, shape.end(), std::uint64_t{1}, std::multiplies<>()));
            soup.fields.push_back(std::move(field));
        }
    }

    static Field namedField(const std::string& name, Association association) {
        Field field;
        field.name = name;
        field.association = association;
        field.bookkeeping = isBookkeepingName(name);
        return field;
    }

    /// Values of images are arrays [step,] z, y, x [, component].
    void takeImageFields(CellSoup& soup, const std::string& where, Association association, std::uint64_t places,
                         std::uint64_t layers) const {
        const std::optional<Hdf5Group> fields = group_.group(where);
        for (const std::string& name : fields ? fields->datasets() : std::vector<std::string>()) {
            const std::vector<std::uint64_t> shape = fields->shape(name);
            if (shape.empty() || places == 0) {
                continue;
            }
            Field field = namedField(name, association);
            if (steps_) {
                field.values = fields->reals(name, offset(where + "Offsets/" + name).value_or(step_), 1);
            } else {
                field.values = fields->reals(name, 0, layers);
            }
            if (field.values.empty() || field.values.size() % places != 0) {
                throw std::runtime_error(fmt::format("its field '{}' has {} values for {} places; write the file again",
                                                     name, field.values.size(), places));
            }
            field.components = static_cast<int>(field.values.size() / places);
            soup.fields.push_back(std::move(field));
        }
    }

    const Hdf5Group& group_;
    std::optional<Hdf5Group> steps_;
    std::vector<double> times_;
    std::uint64_t step_ = 0;
};

CellSoup readGroup(const Hdf5Group& group, std::optional<double> time);

/// Blocks stand beside their assembly, which only arranges them.
CellSoup readBlocks(const Hdf5Group& group, std::optional<double> time) {
    CellSoup soup;
    std::vector<double> times;
    for (const std::string& name : group.groups()) {
        if (name == "Assembly") {
            continue;
        }
        const Hdf5Group block = *group.group(name);
        if (block.text("Type") == "PolyData") {
            soup.notes.push_back(fmt::format("block '{}' is a surface and is left out", name));
            continue;
        }
        CellSoup part = readGroup(block, time);
        times = part.times.size() > times.size() ? part.times : times;
        appendSoup(soup, std::move(part));
    }
    soup.times = std::move(times);
    return soup;
}

CellSoup readGroup(const Hdf5Group& group, std::optional<double> time) {
    const std::string type = group.text("Type");
    if (type == "UnstructuredGrid") {
        return VtkHdfGrid(group, time).readUnstructured();
    }
    if (type == "ImageData") {
        return VtkHdfGrid(group, time).readImage();
    }
    if (type == "PartitionedDataSetCollection" || type == "MultiBlockDataSet") {
        return readBlocks(group, time);
    }
    if (type == "PolyData") {
        throw std::runtime_error(
            "is a surface (PolyData); save it as .vtp in ParaView and make tetrahedra of that with `tetralux mesh`");
    }
    if (type.empty()) {
        throw std::runtime_error("says not what it holds (no Type in its VTKHDF group); write the file again");
    }
    throw std::runtime_error(
        fmt::format("holds a {}, which is not read; make an unstructured grid of it in ParaView (Append Datasets) and "
                    "save that",
                    type.substr(0, 40)));
}

CellSoup readVtkHdf(const std::string& source, const ReadOptions& options) {
    checkBeginning(source, {"\x89HDF"}, "a VTKHDF file (HDF5)");
    return readThirdParty(source, options.isolated, [&] {
        const Hdf5Group file(source);
        const std::optional<Hdf5Group> root = file.group("VTKHDF");
        if (!root) {
            throw std::runtime_error(
                "is HDF5 but not of VTK's kind (no group VTKHDF); save it as .vtu in the program that wrote it");
        }
        return readGroup(*root, options.time);
    });
}

}  // namespace

const MeshFormat vtkHdfFormat{"VTKHDF", ".vtkhdf", acceptsVtkHdf, readVtkHdf};

}  // namespace tetralux::mesh
