// SPDX-License-Identifier: Apache-2.0
/// \file
/// What readers need of HDF5. Every function trusts only what the file really holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tetralux::mesh {

/// A group of an open file, or the file itself.
class Hdf5Group {
public:
    /// \throws std::runtime_error (without the file's name) if it cannot be opened.
    explicit Hdf5Group(const std::string& path);
    Hdf5Group(Hdf5Group&& other) noexcept;
    Hdf5Group(const Hdf5Group&) = delete;
    Hdf5Group& operator=(const Hdf5Group&) = delete;
    Hdf5Group& operator=(Hdf5Group&&) = delete;
    ~Hdf5Group();

    /// Nothing if there is no group called `name`.
    std::optional<Hdf5Group> group(const std::string& name) const;
    std::vector<std::string> groups() const;    ///< names, in the order in which they were made if the file keeps that
    std::vector<std::string> datasets() const;  ///< likewise

    /// Number of values along each axis; empty if there is no such dataset of numbers.
    std::vector<std::uint64_t> shape(const std::string& dataset) const;
    /// `count` rows along the first axis from row `first` on, all of their values.
    /// \throws std::runtime_error naming the dataset if it is not there, is shorter or cannot be read.
    std::vector<double> reals(const std::string& dataset, std::uint64_t first, std::uint64_t count) const;
    std::vector<std::int64_t> integers(const std::string& dataset, std::uint64_t first, std::uint64_t count) const;

    std::vector<double> attribute(const std::string& name) const;  ///< empty if there is none of numbers
    std::string text(const std::string& attribute) const;          ///< empty if there is none of text

private:
    explicit Hdf5Group(std::int64_t id) : id_(id) {}
    std::vector<std::string> children(int kind) const;

    std::int64_t id_ = -1;  ///< HDF5's hid_t
};

}  // namespace tetralux::mesh
