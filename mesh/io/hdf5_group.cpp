// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/hdf5_group.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <vtk_hdf5.h>

namespace tetralux::mesh {
namespace {

/// An identifier of HDF5's that is given back.
class Handle {
public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) {
            close_(id_);
        }
    }
    hid_t get() const { return id_; }
    bool good() const { return id_ >= 0; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

bool holdsNumbers(hid_t type) {
    const H5T_class_t kind = H5Tget_class(type);
    return kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
}

std::vector<std::uint64_t> shapeOf(hid_t space) {
    const int axes = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> sizes(static_cast<std::size_t>(std::max(axes, 0)));
    if (axes > 0) {
        H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    }
    return {sizes.begin(), sizes.end()};
}

[[noreturn]] void refuseDataset(const std::string& dataset, const std::string& why) {
    throw std::runtime_error(fmt::format("its dataset {} {}; write the file again", dataset, why));
}

template <class T>
std::vector<T> readRows(hid_t group, const std::string& name, std::uint64_t first, std::uint64_t count, hid_t memory) {
    const Handle set(H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0 ? H5Dopen2(group, name.c_str(), H5P_DEFAULT) : -1,
                     H5Dclose);
    if (!set.good()) {
        refuseDataset(name, "is not there");
    }
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    std::vector<std::uint64_t> shape = shapeOf(space.get());
    if (shape.empty() || first > shape[0] || count > shape[0] - first) {
        refuseDataset(name, fmt::format("has {} rows where rows {} to {} are needed", shape.empty() ? 1 : shape[0],
                                        first, first + count));
    }
    std::vector<hsize_t> begin(shape.size(), 0);
    std::vector<hsize_t> size(shape.begin(), shape.end());
    begin[0] = first;
    size[0] = count;
    hsize_t values = 1;
    for (const hsize_t along : size) {
        values *= along;
    }
    std::vector<T> result(values);
    if (values == 0) {
        return result;
    }
    const Handle room(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
    if (H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr) < 0 ||
        H5Dread(set.get(), memory, room.get(), space.get(), H5P_DEFAULT, result.data()) < 0) {
        refuseDataset(name, "cannot be read");
    }
    return result;
}

}  // namespace

Hdf5Group::Hdf5Group(const std::string& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    id_ = file.good() ? H5Gopen2(file.get(), "/", H5P_DEFAULT) : -1;
    if (id_ < 0) {
        throw std::runtime_error(
            "HDF5 cannot open it; it is probably truncated or damaged, or still being written: write it again");
    }
}

Hdf5Group::Hdf5Group(Hdf5Group&& other) noexcept : id_(std::exchange(other.id_, -1)) {}

Hdf5Group::~Hdf5Group() {
    if (id_ >= 0) {
        H5Gclose(id_);
    }
}

std::optional<Hdf5Group> Hdf5Group::group(const std::string& name) const {
    if (H5Lexists(id_, name.c_str(), H5P_DEFAULT) <= 0) {
        return std::nullopt;
    }
    const hid_t child = H5Gopen2(id_, name.c_str(), H5P_DEFAULT);
    return child < 0 ? std::nullopt : std::optional(Hdf5Group(std::int64_t{child}));
}

std::vector<std::string> Hdf5Group::children(int kind) const {
    struct Search {
        int kind;
        std::vector<std::string> names;
    } search{kind, {}};
    const auto visit = [](hid_t group, const char* name, const H5L_info_t*, void* into) -> herr_t {
        auto* const found = static_cast<Search*>(into);
        H5O_info_t about;
        if (H5Oget_info_by_name(group, name, &about, H5P_DEFAULT) >= 0 && about.type == found->kind) {
            found->names.emplace_back(name);
        }
        return 0;
    };
    hsize_t at = 0;
    if (H5Literate(id_, H5_INDEX_CRT_ORDER, H5_ITER_INC, &at, visit, &search) < 0) {
        search.names.clear();
        at = 0;
        H5Literate(id_, H5_INDEX_NAME, H5_ITER_INC, &at, visit, &search);
    }
    return std::move(search.names);
}

std::vector<std::string> Hdf5Group::groups() const {
    return children(H5O_TYPE_GROUP);
}

std::vector<std::string> Hdf5Group::datasets() const {
    return children(H5O_TYPE_DATASET);
}

std::vector<std::uint64_t> Hdf5Group::shape(const std::string& dataset) const {
    const Handle set(
        H5Lexists(id_, dataset.c_str(), H5P_DEFAULT) > 0 ? H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT) : -1, H5Dclose);
    if (!set.good()) {
        return {};
    }
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    return holdsNumbers(type.get()) ? shapeOf(space.get()) : std::vector<std::uint64_t>();
}

std::vector<double> Hdf5Group::reals(const std::string& dataset, std::uint64_t first, std::uint64_t count) const {
    return readRows<double>(id_, dataset, first, count, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> Hdf5Group::integers(const std::string& dataset, std::uint64_t first,
                                              std::uint64_t count) const {
    return readRows<std::int64_t>(id_, dataset, first, count, H5T_NATIVE_INT64);
}

std::vector<double> Hdf5Group::attribute(const std::string& name) const {
    constexpr hssize_t mostValues = 1024;
    const Handle found(H5Aexists(id_, name.c_str()) > 0 ? H5Aopen(id_, name.c_str(), H5P_DEFAULT) : -1, H5Aclose);
    if (!found.good()) {
        return {};
    }
    const Handle type(H5Aget_type(found.get()), H5Tclose);
    const Handle space(H5Aget_space(found.get()), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    if (!holdsNumbers(type.get()) || count < 1 || count > mostValues) {
        return {};
    }
    std::vector<double> values(static_cast<std::size_t>(count));
    return H5Aread(found.get(), H5T_NATIVE_DOUBLE, values.data()) < 0 ? std::vector<double>() : values;
}

std::string Hdf5Group::text(const std::string& attribute) const {
    const Handle found(H5Aexists(id_, attribute.c_str()) > 0 ? H5Aopen(id_, attribute.c_str(), H5P_DEFAULT) : -1,
                       H5Aclose);
    if (!found.good()) {
        return {};
    }
    const Handle type(H5Aget_type(found.get()), H5Tclose);
    const Handle space(H5Aget_space(found.get()), H5Sclose);
    if (H5Tget_class(type.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) {
        return {};
    }
    if (H5Tis_variable_str(type.get()) > 0) {
        char* words = nullptr;
        const Handle memory(H5Tcopy(type.get()), H5Tclose);
        if (H5Aread(found.get(), memory.get(), static_cast<void*>(&words)) < 0 || words == nullptr) {
            return {};
        }
        std::string result(words);
        H5free_memory(words);
        return result;
    }
    std::string words(std::min<std::size_t>(H5Tget_size(type.get()), 4096), '\0');
    const Handle memory(H5Tcopy(type.get()), H5Tclose);
    if (words.size() != H5Tget_size(type.get()) || H5Aread(found.get(), memory.get(), words.data()) < 0) {
        return {};
    }
    return words.substr(0, words.find('\0'));
}

}  // namespace tetralux::mesh
