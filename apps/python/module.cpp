// SPDX-License-Identifier: Apache-2.0
#include <exception>

#include <nanobind/nanobind.h>

#include <apps/python/bindings.h>
#include <tetralux/error.h>

namespace nb = nanobind;

namespace {

const char* nameOf(tetralux::Errc code) {
    switch (code) {
        case tetralux::Errc::BadInput:
            return "bad input";
        case tetralux::Errc::Unsupported:
            return "unsupported";
        case tetralux::Errc::OutOfMemory:
            return "out of memory";
        case tetralux::Errc::DeviceLost:
            return "device lost";
        case tetralux::Errc::Cancelled:
            return "cancelled";
    }
    return "error";
}

/// tetralux.Error, or the one of its kinds that fits.
void translate(const std::exception_ptr& thrown, void*) {
    try {
        std::rethrow_exception(thrown);
    } catch (const tetralux::Error& error) {
        const nb::object made =
            nb::module_::import_("tetralux._errors").attr("error_of")(nameOf(error.code()), error.what());
        PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());  // NOLINT: Python's own layout
    }
}

}  // namespace

NB_MODULE(_core, module) {
    module.doc() = "The compiled part of tetralux. Use the functions of the package instead: this may change.";
    nb::set_leak_warnings(false);  // the library prints nothing, and what the interpreter leaves behind is its affair
    nb::register_exception_translator(translate);
    tetralux::python::bindMesh(module);
    tetralux::python::bindRenderer(module);
    tetralux::python::bindImage(module);
}
