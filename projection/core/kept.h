// SPDX-License-Identifier: Apache-2.0
/// \file
/// What outlives an engine, so that the next one of the same mesh need not make it again: a transfer function, a light,
/// a cut or a field that changes asks for a new engine, not for a new order.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <typeindex>
#include <utility>

namespace tetralux::projection {

/// What follows from the points and cells of a mesh alone (adjacency, the certificate of an order), by name: made when
/// first asked for, then shared by all renderers of the mesh, in any thread.
class MeshMemo {
public:
    template <class T, class Make>
    std::shared_ptr<const T> get(const std::string& name, const Make& make) {
        const std::scoped_lock lock(mutex_);  // also while it is made: who asks next waits for it
        std::shared_ptr<const void>& kept = kept_[name];
        if (!kept) kept = std::make_shared<const T>(make());
        return std::static_pointer_cast<const T>(kept);
    }

private:
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const void>> kept_;
};

/// Memory and state of frames that one engine leaves to the next of the same renderer. One thread at a time.
class FrameMemory {
public:
    /// What was left of this type; a new one where there is none, or another engine has it.
    template <class T>
    std::shared_ptr<T> take() {
        const auto found = left_.find(typeid(T));
        if (found == left_.end()) return std::make_shared<T>();
        auto taken = std::static_pointer_cast<T>(std::move(found->second));
        left_.erase(found);
        return taken;
    }
    template <class T>
    void leave(std::shared_ptr<T> memory) {
        left_.insert_or_assign(typeid(T), std::move(memory));
    }

private:
    std::map<std::type_index, std::shared_ptr<void>> left_;
};

}  // namespace tetralux::projection
