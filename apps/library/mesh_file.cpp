// SPDX-License-Identifier: Apache-2.0
#include <tetralux/io.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <apps/library/mesh_file.h>
#include <mesh/io/read_mesh.h>
#include <projection/renderer/errors.h>
#include <projection/renderer/mesh_data.h>

namespace tetralux {

struct MeshField::Data {
    mesh::Field field;
};

namespace {

std::vector<double> magnitudes(const mesh::Field& field) {
    const std::size_t components = static_cast<std::size_t>(field.components);
    std::vector<double> values(field.values.size() / components);
    for (std::size_t i = 0; i < values.size(); ++i) {
        double largest = 0.0, sum = 0.0;  // scaled, so that no square overflows
        const std::span<const double> vector(field.values.data() + i * components, components);
        for (const double x : vector) largest = std::max(largest, std::abs(x));
        const double scale = largest > 0.0 ? largest : 1.0;
        for (const double x : vector) sum += (x / scale) * (x / scale);
        values[i] = scale * std::sqrt(sum);
    }
    return values;
}

}  // namespace

MeshField::MeshField(std::shared_ptr<const Data> data)
    : data_(std::move(data)),
      name_(data_->field.name),
      onPoints_(data_->field.association == mesh::Association::Point),
      components_(data_->field.components) {
    minimum_ = std::numeric_limits<double>::infinity();
    maximum_ = -minimum_;
    const bool vector = components_ > 1;
    const std::vector<double> own = vector ? magnitudes(data_->field) : std::vector<double>();
    for (const double value : vector ? own : data_->field.values) {
        if (std::isfinite(value)) {
            minimum_ = std::min(minimum_, value);
            maximum_ = std::max(maximum_, value);
        }
    }
    if (minimum_ > maximum_) minimum_ = maximum_ = 0.0;
}

const std::vector<std::string>& MeshField::componentNames() const {
    return data_->field.componentNames;
}
bool MeshField::isBookkeeping() const {
    return data_->field.bookkeeping;
}
std::span<const double> MeshField::values() const {
    return data_->field.values;
}

Field MeshField::made(std::vector<double> values) const {
    const auto kept = std::make_shared<const std::vector<double>>(std::move(values));
    return onPoints_ ? Field::borrowOnPoints(*kept, kept) : Field::borrowOnCells(*kept, kept);
}

Field MeshField::field() const {
    if (components_ > 1) return made(magnitudes(data_->field));
    const std::span<const double> values = data_->field.values;
    return onPoints_ ? Field::borrowOnPoints(values, data_) : Field::borrowOnCells(values, data_);
}

Field MeshField::component(int index) const {
    if (index < 0 || index >= components_)
        throw Error(Errc::BadInput, fmt::format("field '{}' has no component {}; give one from 0 to {}", name_, index,
                                                components_ - 1));
    const std::size_t components = static_cast<std::size_t>(components_);
    std::vector<double> values(data_->field.values.size() / components);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = data_->field.values[i * components + static_cast<std::size_t>(index)];
    return made(std::move(values));
}

const MeshField& MeshFile::field(std::string_view name) const {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const MeshField& f) { return f.name() == name; });
    if (found != fields.end()) return *found;
    std::string names;
    for (const MeshField& each : fields) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", each.name());
    throw Error(Errc::BadInput, fields.empty()
                                    ? fmt::format("there is no field '{}', nor any other; save the mesh with one", name)
                                    : fmt::format("there is no field '{}'; take one of {}", name, names));
}

namespace library {

mesh::ReadOptions checkedOptions(const ReadOptions& options) {
    if (options.subdivision < 0 || options.subdivision > 64)
        throw Error(Errc::BadInput,
                    fmt::format("subdivision is {}; give 1 to 64, or 0 for a cell's order", options.subdivision));
    if (options.mergeTolerance && !(*options.mergeTolerance >= 0.0 && std::isfinite(*options.mergeTolerance)))
        throw Error(Errc::BadInput,
                    fmt::format("mergeTolerance is {}; give a length in mesh units, from 0", *options.mergeTolerance));
    mesh::ReadOptions result;
    result.time = options.time;
    result.subdivision = options.subdivision;
    result.mergeTolerance = options.mergeTolerance;
    result.smoothCells = options.smoothCells;
    result.isolated = options.isolated;
    return result;
}

MeshFile meshFile(mesh::ReadResult result) {
    MeshFile file;
    file.mesh = renderer::checkedMesh(std::move(result.mesh.positions), std::move(result.mesh.cells));
    for (mesh::Field& field : result.mesh.fields)
        file.fields.emplace_back(std::make_shared<const MeshField::Data>(std::move(field)));
    file.times = std::move(result.times);
    file.report = renderer::publicReport(result.report);
    return file;
}

}  // namespace library

MeshFile readOwn(const std::string& source, const ReadOptions& options) {
    return renderer::translated([&] {
        std::optional<mesh::ReadResult> result = mesh::readOwnMesh(source, library::checkedOptions(options));
        if (!result)
            throw Error(Errc::Unsupported,
                        fmt::format("{}: needs one of VTK's readers, which are not here; save it as .vtu", source));
        return library::meshFile(std::move(*result));
    });
}

}  // namespace tetralux
