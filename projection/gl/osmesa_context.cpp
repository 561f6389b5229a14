// SPDX-License-Identifier: Apache-2.0
//
// OSMesa: Mesa's software renderer as a plain library, for machines without EGL. Mesa 25.1 removed it together with its
// header, so the six functions and the constants that are used are declared here instead of being included.
#include <array>
#include <stdexcept>

#include <projection/gl/gl_context_kinds.h>
#include <projection/gl/shared_library.h>

namespace tetralux::projection {
namespace {

struct OsMesaHandleType;
using OsMesaHandle = OsMesaHandleType*;

constexpr int osMesaFormat = 0x22, osMesaRgba = 0x1908, osMesaDepthBits = 0x30, osMesaStencilBits = 0x31;
constexpr int osMesaProfile = 0x33, osMesaCoreProfile = 0x34, osMesaMajor = 0x36, osMesaMinor = 0x37;
constexpr unsigned int osMesaUnsignedByte = 0x1401;

struct OsMesaFunctions {
    SharedLibrary library{"libOSMesa.so.8"};
    OsMesaHandle (*createContextAttribs)(const int*, OsMesaHandle) =
        library.function<OsMesaHandle(const int*, OsMesaHandle)>("OSMesaCreateContextAttribs");
    void (*destroyContext)(OsMesaHandle) = library.function<void(OsMesaHandle)>("OSMesaDestroyContext");
    unsigned char (*makeCurrent)(OsMesaHandle, void*, unsigned int, int, int) =
        library.function<unsigned char(OsMesaHandle, void*, unsigned int, int, int)>("OSMesaMakeCurrent");
    GlContext::Function (*getProcAddress)(const char*) =
        library.function<GlContext::Function(const char*)>("OSMesaGetProcAddress");
};

const OsMesaFunctions& osMesa() {
    static const OsMesaFunctions functions;  // a throwing constructor is tried again at the next call
    return functions;
}

class OsMesaContext final : public GlContext {
public:
    OsMesaContext() {
        for (const GlVersion version : glVersions) {
            const int attributes[] = {
                osMesaFormat,      osMesaRgba,  osMesaDepthBits, 0,           osMesaStencilBits, 0, osMesaProfile,
                osMesaCoreProfile, osMesaMajor, version.major,   osMesaMinor, version.minor,     0, 0};
            context_ = osMesa().createContextAttribs(attributes, nullptr);
            if (context_ != nullptr) return;
        }
        throw std::runtime_error("OSMesa refuses a core context of version 4.3");
    }
    ~OsMesaContext() override { osMesa().destroyContext(context_); }

    void makeCurrent() override {
        if (osMesa().makeCurrent(context_, buffer_.data(), osMesaUnsignedByte, 1, 1) == 0) {
            throw std::runtime_error(
                "OSMesa cannot make its context current; is another context current in this thread?");
        }
    }
    void release() noexcept override { osMesa().makeCurrent(nullptr, nullptr, osMesaUnsignedByte, 0, 0); }
    Function functionAddress(const char* functionName) const override { return osMesa().getProcAddress(functionName); }
    std::string description() const override { return "osmesa"; }

private:
    OsMesaHandle context_ = nullptr;
    std::array<unsigned char, 4> buffer_{};  // OSMesa insists on a window: one pixel that nothing draws to
};

}  // namespace

std::unique_ptr<GlContext> makeOsMesaContext() {
    return std::make_unique<OsMesaContext>();
}

}  // namespace tetralux::projection
