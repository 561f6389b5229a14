// SPDX-License-Identifier: Apache-2.0
/// \file
/// An array that several meshes share, or that somebody else owns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace tetralux::mesh {

/// Elements that are copied when they are changed, and only then: another field on the same mesh takes its points and
/// cells along at no cost, and the arrays of a host (numpy's, VTK's) are drawn where they lie. Reads like a vector.
/// Several threads may read one array, and may copy it; one that changes it must be its only user.
template <class T>
class SharedArray {
public:
    SharedArray() = default;
    SharedArray(std::vector<T> elements)  // NOLINT: implicit on purpose, a vector's elements are an array's
        : own_(std::make_shared<std::vector<T>>(std::move(elements))) {
        look();
    }
    SharedArray(std::initializer_list<T> elements) : SharedArray(std::vector<T>(elements)) {}

    /// Elements that live as long as `owner`, which must not change them meanwhile.
    static SharedArray borrowed(std::span<const T> elements, std::shared_ptr<const void> owner) {
        SharedArray array;
        array.owner_ = std::move(owner);
        array.data_ = elements.data();
        array.size_ = elements.size();
        return array;
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const T* data() const { return data_; }  ///< what spans are made of: never a reason to copy
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }
    const T& operator[](std::size_t i) const { return data_[i]; }
    const T& front() const { return data_[0]; }
    const T& back() const { return data_[size_ - 1]; }

    /// Of an array that could be changed too, without a copy. (A constant one is a range that spans take by
    /// themselves.)
    operator std::span<const T>() { return {data_, size_}; }  // NOLINT: implicit on purpose, as a vector's

    bool operator==(const SharedArray& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

    T* begin() { return own().data(); }
    T* end() { return own().data() + size_; }
    T& operator[](std::size_t i) { return own()[i]; }
    T& front() { return own().front(); }
    T& back() { return own().back(); }

    void push_back(T element) {
        own().push_back(std::move(element));
        look();
    }
    template <class... Arguments>
    void emplace_back(Arguments&&... arguments) {
        own().emplace_back(std::forward<Arguments>(arguments)...);
        look();
    }
    template <class Elements>
    void append(const Elements& elements) {
        own().insert(own().end(), std::begin(elements), std::end(elements));
        look();
    }
    void resize(std::size_t size) {
        own().resize(size);
        look();
    }
    void assign(std::size_t size, const T& element) { *this = std::vector<T>(size, element); }
    void clear() { *this = SharedArray(); }

private:
    /// The elements as this array's alone.
    std::vector<T>& own() {
        if (!own_ || own_.use_count() > 1) {
            own_ = std::make_shared<std::vector<T>>(data_, data_ + size_);
            owner_.reset();
            look();
        }
        return *own_;
    }
    void look() {
        data_ = own_->data();
        size_ = own_->size();
    }

    std::shared_ptr<std::vector<T>> own_;
    std::shared_ptr<const void> owner_;
    const T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace tetralux::mesh
