// SPDX-License-Identifier: GPL-3.0-or-later
// What classes of values that never change have in common.
#pragma once

#include "arrays.h"

#include <string>

namespace mrc_python {

template <class Class>
std::string qualified_name(const Class& bound) {
    return "mrcontour." + py::cast<std::string>(bound.attr("__name__"));
}

/// `==`, which needs a `__hash__` that was bound before.
template <class Class>
void define_equality(Class& bound) {
    using Value = typename Class::type;
    py::options own_signatures;
    own_signatures.disable_function_signatures();
    const std::string text = "__eq__(self: " + qualified_name(bound) + ", other: object) -> bool";
    bound.def(
        "__eq__",
        [](const Value& a, const py::object& b) -> py::object {
            if (!py::isinstance<Value>(b)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            return py::bool_(a == b.template cast<const Value&>());
        },
        text.c_str());
}

/// A copy of what never changes is that itself, as with tuples.
template <class Class>
void define_copies(Class& bound) {
    py::options own_signatures;
    own_signatures.disable_function_signatures();
    const std::string name = qualified_name(bound);
    const std::string copy = "__copy__(self: " + name + ") -> " + name;
    const std::string deep = "__deepcopy__(self: " + name + ", memo: object) -> " + name;
    bound.def(
        "__copy__", [](const py::object& self) { return self; }, copy.c_str());
    bound.def(
        "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"), deep.c_str());
}

}  // namespace mrc_python
