// SPDX-License-Identifier: Apache-2.0
//
// EGL without a window system: on a device (EGL_EXT_platform_device) or surfaceless (EGL_MESA_platform_surfaceless).
// The default display is not tried: without X or Wayland it fails unless the environment says otherwise.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include <projection/gl/gl_context_kinds.h>
#include <projection/gl/shared_library.h>

namespace tetralux::projection {
namespace {

struct EglFunctions {
    SharedLibrary library{"libEGL.so.1"};
// NOLINTNEXTLINE(bugprone-macro-parentheses): a name that is declared stands without
#define TETRALUX_EGL_FUNCTION(name) decltype(::egl##name)* name = library.function<decltype(::egl##name)>("egl" #name)
    TETRALUX_EGL_FUNCTION(GetProcAddress);
    TETRALUX_EGL_FUNCTION(QueryString);
    TETRALUX_EGL_FUNCTION(Initialize);
    TETRALUX_EGL_FUNCTION(BindAPI);
    TETRALUX_EGL_FUNCTION(CreateContext);
    TETRALUX_EGL_FUNCTION(DestroyContext);
    TETRALUX_EGL_FUNCTION(MakeCurrent);
#undef TETRALUX_EGL_FUNCTION
    // Extensions: null where the library lacks them.
    PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay =
        extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    PFNEGLQUERYDEVICESEXTPROC queryDevices = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString =
        extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");

private:
    template <class FunctionPointer>
    FunctionPointer extension(const char* name) const {
        return reinterpret_cast<FunctionPointer>(GetProcAddress(name));
    }
};

const EglFunctions& egl() {
    static const EglFunctions functions;  // a throwing constructor is tried again at the next call
    return functions;
}

// Whether `word` is in a blank-separated list, which may be null.
bool listHas(const char* list, std::string_view word) {
    const std::string_view text = list != nullptr ? list : "";
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find(' ', start), text.size());
        if (text.substr(start, end - start) == word) return true;
        start = end + 1;
    }
    return false;
}

struct DisplayCandidate {
    EGLenum platform;
    void* native;
    std::string name;
};

// Hardware devices, surfaceless, software devices. Surfaceless does not imply software: it may find a GPU whose device
// is not listed.
std::vector<DisplayCandidate> displayCandidates() {
    const char* clientExtensions = egl().QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (egl().getPlatformDisplay == nullptr || !listHas(clientExtensions, "EGL_EXT_platform_base")) return {};
    std::vector<DisplayCandidate> hardware, software;
    if (egl().queryDevices != nullptr && listHas(clientExtensions, "EGL_EXT_platform_device")) {
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (egl().queryDevices(16, devices, &count) != EGL_TRUE) count = 0;
        for (int i = 0; i < count; ++i) {
            const char* extensions =
                egl().queryDeviceString != nullptr ? egl().queryDeviceString(devices[i], EGL_EXTENSIONS) : nullptr;
            (listHas(extensions, "EGL_MESA_device_software") ? software : hardware)
                .push_back({EGL_PLATFORM_DEVICE_EXT, devices[i], fmt::format("device {}", i)});
        }
    }
    std::vector<DisplayCandidate> candidates = hardware;
    if (listHas(clientExtensions, "EGL_MESA_platform_surfaceless")) {
        candidates.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless"});
    }
    candidates.insert(candidates.end(), software.begin(), software.end());
    return candidates;
}

// An initialized display. EGL hands out one per platform and device to the whole process and does not count who
// initialized it, so it is never terminated: that would end the contexts of others, and Mesa loses a little memory each
// time its driver is unloaded.
class Display {
public:
    explicit Display(const DisplayCandidate& candidate)
        : handle_(egl().getPlatformDisplay(candidate.platform, candidate.native, nullptr)) {
        if (handle_ == EGL_NO_DISPLAY || egl().Initialize(handle_, nullptr, nullptr) != EGL_TRUE) {
            throw std::runtime_error("cannot be initialized");
        }
    }

    EGLDisplay handle() const { return handle_; }
    bool has(std::string_view extension) const {
        return listHas(egl().QueryString(handle_, EGL_EXTENSIONS), extension);
    }

private:
    EGLDisplay handle_;
};

class EglContext final : public GlContext {
public:
    explicit EglContext(const DisplayCandidate& candidate) : display_(candidate), name_(candidate.name) {
        if (!display_.has("EGL_KHR_no_config_context") || !display_.has("EGL_KHR_surfaceless_context")) {
            throw std::runtime_error("lacks contexts without configuration or surface");
        }
        egl().BindAPI(EGL_OPENGL_API);
        for (const GlVersion version : glVersions) {
            const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                         version.major,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         version.minor,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
            context_ = egl().CreateContext(display_.handle(), EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
            if (context_ != EGL_NO_CONTEXT) return;
        }
        throw std::runtime_error("refuses a core context of version 4.3");
    }
    ~EglContext() override { egl().DestroyContext(display_.handle(), context_); }

    void makeCurrent() override {
        egl().BindAPI(EGL_OPENGL_API);  // per thread
        if (egl().MakeCurrent(display_.handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
            throw std::runtime_error(
                fmt::format("EGL ({}) cannot make its context current; is it current in another thread?", name_));
        }
    }
    void release() noexcept override {
        egl().MakeCurrent(display_.handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    Function functionAddress(const char* functionName) const override { return egl().GetProcAddress(functionName); }
    std::string description() const override { return fmt::format("egl ({})", name_); }

private:
    Display display_;
    std::string name_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> makeEglContext() {
    std::string reasons;
    for (const DisplayCandidate& candidate : displayCandidates()) {
        try {
            return std::make_unique<EglContext>(candidate);
        } catch (const std::runtime_error& error) {
            reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", candidate.name, error.what());
        }
    }
    throw std::runtime_error(reasons.empty() ? "EGL offers neither devices nor a surfaceless platform"
                                             : "EGL: " + reasons);
}

}  // namespace tetralux::projection
