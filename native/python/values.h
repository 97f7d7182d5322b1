// SPDX-License-Identifier: GPL-3.0-or-later
// What classes of values that never change have in common.
#pragma once

#include "arrays.h"

namespace mrc_python {

/// `==`, which needs a `__hash__` that was bound before.
template <class Class>
void define_equality(Class& bound) {
    using Value = typename Class::type;
    bound.def(
        "__eq__", [](const Value& a, const Value& b) { return a == b; }, py::is_operator());
}

/// A copy of what never changes is that itself, as with tuples.
template <class Class>
void define_copies(Class& bound) {
    bound.def("__copy__", [](const py::object& self) { return self; });
    bound.def(
        "__deepcopy__", [](const py::object& self, const py::dict&) { return self; }, py::arg("memo"));
}

}  // namespace mrc_python
