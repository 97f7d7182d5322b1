// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>
#include <mrc/types.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <string>
#include <vector>

namespace mrc_python {

namespace py = pybind11;
constexpr int readable = +py::array::c_style | +py::detail::npy_api::NPY_ARRAY_ALIGNED_;  // as C++ reads arrays
using Integers = py::array_t<int32_t, readable>;
using Doubles = py::array_t<double, readable>;
using Iterable = py::typing::Iterable<py::object>;
using Dict = py::typing::Dict<py::str, py::object>;

/// An array of whole numbers as int32, without a copy where it fits already.
/// @throws TypeError for other kinds of numbers, InvalidInput for numbers that do not fit.
Integers integers(const py::object& values, const char* name);

/// An array of real numbers as float64, without a copy where it fits already.
Doubles doubles(const py::object& values, const char* name);

/// @throws InvalidInput where the array's shape is not (rows, columns); columns 0: one-dimensional.
void require_shape(const py::array& array, py::ssize_t columns, const char* name);

template <class T>
std::span<const T> view(const py::array_t<T, readable>& array) {
    return {array.data(), static_cast<std::size_t>(array.size())};
}

/// Copies whole numbers into a new int32 array; `columns` 0: one-dimensional.
Integers to_array(std::span<const int> values, py::ssize_t columns = 0);
Doubles to_array(std::span<const double> values);

/// Rows of three numbers.
template <class Points, class Get>
Doubles rows_of_three(const Points& points, Get&& get) {
    Doubles array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
    double* out = array.mutable_data();
    for (const auto& point : points) {
        const mrc::Vec3 row = get(point);
        for (int i = 0; i < 3; ++i) *out++ = row[i];
    }
    return array;
}

}  // namespace mrc_python
