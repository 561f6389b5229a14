// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/shared_library.h>

#include <dlfcn.h>

#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

SharedLibrary::SharedLibrary(const char* fileName)
    : handle_(dlopen(fileName, RTLD_NOW | RTLD_LOCAL)), fileName_(fileName) {
    if (handle_ == nullptr) throw std::runtime_error(fmt::format("{} cannot be opened", fileName));
}

SharedLibrary::AnyFunction* SharedLibrary::address(const char* name) const {
    void* symbol = dlsym(handle_, name);
    if (symbol == nullptr) throw std::runtime_error(fmt::format("{} has no function {}", fileName_, name));
    return reinterpret_cast<AnyFunction*>(symbol);
}

}  // namespace tetralux::projection
