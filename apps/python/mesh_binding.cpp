// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <apps/python/bindings.h>
#include <apps/python/owner.h>
#include <tetralux/io.h>
#include <tetralux/mesh.h>

namespace tetralux::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

template <class Number, class... Shape>
using Array = nb::ndarray<const Number, Shape..., nb::c_contig, nb::device::cpu>;
template <class Number>
using List = Array<Number, nb::ndim<1>>;
using Points = Array<double, nb::shape<-1, 3>>;

template <class Given>
auto spanOf(const Given& array) {
    return std::span(array.data(), array.size());
}

/// Made while the interpreter's lock is released.
template <class Make>
BoundMesh bound(const Make& make) {
    const nb::gil_scoped_release unlocked;
    BoundMesh result;
    result.mesh = make(result.report);
    return result;
}

BoundMesh tetrahedra(const Points& points, const Array<std::uint32_t, nb::shape<-1, 4>>& cells) {
    const auto owner = ownerOf(std::pair(points, cells));
    return bound([&](MeshReport& report) { return Mesh::borrow(spanOf(points), spanOf(cells), owner, &report); });
}

BoundMesh anyCells(const Points& points, const List<std::uint8_t>& types, const List<std::int64_t>& offsets,
                   const List<std::int64_t>& connectivity, const std::optional<List<std::int64_t>>& faceOffsets,
                   const std::optional<List<std::int64_t>>& faceStream) {
    using Numbers = std::span<const std::int64_t>;
    return bound([&](MeshReport& report) {
        return Mesh::fromCells(spanOf(points), spanOf(types), spanOf(offsets), spanOf(connectivity), &report,
                               faceOffsets ? spanOf(*faceOffsets) : Numbers(),
                               faceStream ? spanOf(*faceStream) : Numbers());
    });
}

Field fieldOf(const List<double>& values, bool onPoints) {
    const auto owner = ownerOf(values);
    return onPoints ? Field::borrowOnPoints(spanOf(values), owner) : Field::borrowOnCells(spanOf(values), owner);
}

nb::dict dictOf(const MeshReport& report) {
    nb::dict result;
    result["cells"] = report.cellsRead;
    result["cell_types"] = report.cellTypes;
    result["defects"] = report.defects;
    result["skipped"] = report.skipped;
    return result;
}

/// A view of `count` numbers in rows of `columns`, which keeps `owner` alive.
template <class Number>
nb::object view(std::span<const Number> numbers, std::size_t columns, nb::handle owner) {
    if (columns == 1)
        return nb::cast(nb::ndarray<nb::numpy, const Number, nb::ndim<1>>(numbers.data(), {numbers.size()}, owner));
    return nb::cast(
        nb::ndarray<nb::numpy, const Number, nb::ndim<2>>(numbers.data(), {numbers.size() / columns, columns}, owner));
}

nb::dict dictOf(const MeshField& field) {
    nb::dict result;
    auto kept = std::make_unique<MeshField>(field);
    const MeshField& of = *kept;
    const nb::capsule owner(kept.release(), [](void* data) noexcept { delete static_cast<MeshField*>(data); });
    result["name"] = of.name();
    result["on_points"] = of.isOnPoints();
    result["component_names"] = of.componentNames();
    result["bookkeeping"] = of.isBookkeeping();
    result["values"] = view(of.values(), static_cast<std::size_t>(of.components()), owner);
    return result;
}

nb::tuple readFile(const std::string& source, std::optional<double> time, int subdivision,
                   std::optional<double> mergeTolerance, bool smoothCells) {
    ReadOptions options;
    options.time = time;
    options.subdivision = subdivision;
    options.mergeTolerance = mergeTolerance;
    options.smoothCells = smoothCells;
    MeshFile file;
    {
        const nb::gil_scoped_release unlocked;
        file = readOwn(source, options);
    }
    nb::list fields;
    for (const MeshField& field : file.fields) fields.append(dictOf(field));
    return nb::make_tuple(BoundMesh{file.mesh, file.report}, fields, file.times);
}

}  // namespace

void bindMesh(nb::module_& module) {
    nb::class_<BoundMesh>(module, "Mesh", "Checked tetrahedra.")
        .def_static("tetrahedra", &tetrahedra, "points"_a.noconvert(), "cells"_a.noconvert(),
                    "Of float64 (n, 3) points and uint32 (m, 4) cells, borrowed.")
        .def_static("cells", &anyCells, "points"_a.noconvert(), "types"_a.noconvert(), "offsets"_a.noconvert(),
                    "connectivity"_a.noconvert(), "face_offsets"_a.noconvert() = nb::none(),
                    "face_stream"_a.noconvert() = nb::none(), "Of cells of any type, in VTK's numbering.")
        .def_prop_ro("n_tetrahedra", [](const BoundMesh& self) { return self.mesh->tetrahedra(); })
        .def_prop_ro("n_points", [](const BoundMesh& self) { return self.mesh->points(); })
        .def_prop_ro("n_cells", [](const BoundMesh& self) { return self.mesh->cells(); })
        .def_prop_ro("bounds",
                     [](const BoundMesh& self) {
                         const BoundingBox box = self.mesh->bounds();
                         return std::pair(box.low, box.high);
                     })
        .def_prop_ro("report", [](const BoundMesh& self) { return dictOf(self.report); })
        .def_prop_ro("positions",
                     [](nb::handle self) { return view(nb::cast<const BoundMesh&>(self).mesh->positions(), 3, self); })
        .def_prop_ro("corners",
                     [](nb::handle self) { return view(nb::cast<const BoundMesh&>(self).mesh->corners(), 4, self); });
    nb::class_<Field>(module, "Field", "Values on points or cells.")
        .def_static("of", &fieldOf, "values"_a.noconvert(), "on_points"_a, "Of float64 values, borrowed.");
    module.def("read", &readFile, "source"_a, "time"_a = nb::none(), "subdivision"_a = 0, "merge"_a = nb::none(),
               "smooth_cells"_a = false, "(mesh, fields, times) of a file that needs no VTK, or of a generated field.");
}

}  // namespace tetralux::python
