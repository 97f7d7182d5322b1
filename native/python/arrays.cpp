// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"

#include <mrc/errors.h>

#include <algorithm>
#include <limits>

namespace mrc_python {
namespace {

py::array as_array(const py::object& values, const char* name) {
    py::array array = py::array::ensure(values);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(std::string(name) + " is no array of numbers");
    }
    return array;
}

std::string kind_of(const py::array& array) { return py::cast<std::string>(py::str(array.dtype())); }

}  // namespace

Integers integers(const py::object& values, const char* name) {
    const py::array array = as_array(values, name);
    if (array.size() == 0) return Integers(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()));
    const char kind = array.dtype().kind();
    if (kind != 'i' && kind != 'u') throw py::type_error(std::string(name) + " must be whole numbers, not " + kind_of(array));
    if (array.dtype().is(py::dtype::of<int32_t>())) return Integers::ensure(array);
    const auto limit = std::numeric_limits<int32_t>::max();
    const auto most = py::cast<py::int_>(array.attr("max")()), least = py::cast<py::int_>(array.attr("min")());
    if (py::cast<bool>(py::bool_(most > py::int_(limit))) || py::cast<bool>(py::bool_(least < py::int_(-limit)))) {
        throw mrc::InvalidInput(mrc::ErrorCode::out_of_range, std::string(name) + " holds numbers from " +
                                                                  py::cast<std::string>(py::str(least)) + " to " +
                                                                  py::cast<std::string>(py::str(most)) + ", which are no indices");
    }
    return Integers::ensure(array.attr("astype")("int32"));
}

Doubles doubles(const py::object& values, const char* name) {
    const py::array array = as_array(values, name);
    const char kind = array.dtype().kind();
    if (array.size() > 0 && kind != 'f' && kind != 'i' && kind != 'u') {
        throw py::type_error(std::string(name) + " must be real numbers, not " + kind_of(array));
    }
    return Doubles::ensure(array.attr("astype")("float64", py::arg("copy") = false));
}

void require_shape(const py::array& array, py::ssize_t columns, const char* name) {
    const bool fits = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
    if (fits) return;
    const std::string wanted = columns == 0 ? "(n,)" : "(n, " + std::to_string(columns) + ")";
    throw mrc::InvalidInput(mrc::ErrorCode::wrong_size, std::string(name) + " must have the shape " + wanted + ", not " +
                                                            py::cast<std::string>(py::str(array.attr("shape"))));
}

Integers to_array(std::span<const int> values, py::ssize_t columns) {
    const auto size = static_cast<py::ssize_t>(values.size());
    Integers array =
        columns == 0 ? Integers(std::vector<py::ssize_t>{size}) : Integers(std::vector<py::ssize_t>{size / columns, columns});
    std::ranges::copy(values, array.mutable_data());
    return array;
}

Doubles to_array(std::span<const double> values) {
    Doubles array(static_cast<py::ssize_t>(values.size()));
    std::ranges::copy(values, array.mutable_data());
    return array;
}

}  // namespace mrc_python
