// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/errors.h>

#include <pybind11/pybind11.h>

namespace mrc_python {

/// An InvalidInput of Python.
class PyInvalidInput : public pybind11::object {
    PYBIND11_OBJECT_DEFAULT(PyInvalidInput, object, PyExceptionInstance_Check)
};

/// The error as a Python exception that is not raised.
PyInvalidInput to_python(const mrc::InvalidInput& error);

}  // namespace mrc_python

template <>
struct pybind11::detail::handle_type_name<mrc_python::PyInvalidInput> {
    static constexpr auto name = const_name("mrcontour.InvalidInput");
};
