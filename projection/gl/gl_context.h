// SPDX-License-Identifier: Apache-2.0
/// \file
/// OpenGL contexts without a window. No GL library is linked: a context opens the library it needs at run time and
/// names its functions, so one program runs on EGL (a GPU or software) and on OSMesa.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace tetralux::projection {

/// An OpenGL core context (4.6, 4.5 or 4.3, the highest there is) with neither window nor default framebuffer. It is
/// current in no thread until `makeCurrent`; one thread at a time may use it.
class GlContext {
public:
    using Function = void (*)();

    virtual ~GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// \throws std::runtime_error when the library refuses.
    virtual void makeCurrent() = 0;

    /// Leaves this thread without a context. EGL's and OSMesa's both current in one thread draw into each other's
    /// targets, so whoever makes one current releases it when done: use CurrentGlContext.
    virtual void release() noexcept = 0;

    /// Address of an OpenGL function, nullptr when there is none of that name.
    virtual Function functionAddress(const char* functionName) const = 0;

    /// What was opened: "egl (device 0)", "egl (surfaceless)", "osmesa".
    virtual std::string description() const = 0;

protected:
    GlContext() = default;
};

/// Makes a context current for the life of a scope.
class CurrentGlContext {
public:
    explicit CurrentGlContext(GlContext& context) : context_(context) { context_.makeCurrent(); }
    ~CurrentGlContext() { context_.release(); }
    CurrentGlContext(const CurrentGlContext&) = delete;
    CurrentGlContext& operator=(const CurrentGlContext&) = delete;

private:
    GlContext& context_;
};

/// "auto" and the names of the kinds of context.
std::vector<std::string> glContextNames();

/// A new context of the kind named. "auto" takes the first that can be had of: EGL devices that are no software, EGL
/// without a surface, EGL software devices, OSMesa. \throws std::runtime_error listing the names when `kind` is none of
/// them; naming the Debian packages to install when no context of that kind can be had here.
std::unique_ptr<GlContext> makeGlContext(const std::string& kind);

}  // namespace tetralux::projection
