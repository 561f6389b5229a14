// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <string>

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <apps/python/bindings.h>
#include <projection/image/image.h>
#include <projection/image/image_codecs.h>
#include <projection/renderer/errors.h>

namespace tetralux::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

using Rgba = nb::ndarray<const float, nb::shape<-1, -1, 4>, nb::c_contig, nb::device::cpu>;

projection::Image imageOf(const Rgba& rgba) {
    projection::Image image(static_cast<int>(rgba.shape(1)), static_cast<int>(rgba.shape(0)));
    std::memcpy(static_cast<void*>(image.pixels.data()), rgba.data(), rgba.size() * sizeof(float));
    return image;
}

}  // namespace

void bindImage(nb::module_& module) {
    module.def(
        "encode_png",
        [](const Rgba& rgba) {
            const std::string png = renderer::translated([&] {
                const nb::gil_scoped_release unlocked;
                return projection::encodePng(imageOf(rgba), "image", {});
            });
            return nb::bytes(png.data(), png.size());
        },
        "rgba"_a.noconvert(), "8-bit PNG over black.");
    module.def(
        "write_image",
        [](const Rgba& rgba, const std::string& path) {
            renderer::translated([&] {
                const nb::gil_scoped_release unlocked;
                projection::writeImage(imageOf(rgba), path);
            });
        },
        "rgba"_a.noconvert(), "path"_a, "A .png or .exr, whole or not at all.");
}

}  // namespace tetralux::python
