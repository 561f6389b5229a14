// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tetralux::projection {

/// A shared library opened at run time. It is never closed: Mesa keeps thread-local state and threads of its own, which
/// would outlive their code.
class SharedLibrary {
public:
    /// \throws std::runtime_error when the library cannot be opened.
    explicit SharedLibrary(const char* fileName);

    /// The function of that name as `FunctionType`. \throws std::runtime_error when there is none.
    template <class FunctionType>
    FunctionType* function(const char* name) const {
        return reinterpret_cast<FunctionType*>(address(name));
    }

private:
    using AnyFunction = void();
    AnyFunction* address(const char* name) const;
    void* handle_;
    std::string fileName_;
};

}  // namespace tetralux::projection
