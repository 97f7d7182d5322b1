// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace mrc_python {

void bind_errors(pybind11::module_& module);
void bind_surface(pybind11::module_& module);
bool is_option(const std::string& name);
void bind_options(pybind11::module_& module);
void bind_contour(pybind11::module_& module);
void bind_results(pybind11::module_& module);
void bind_functions(pybind11::module_& module);

}  // namespace mrc_python
