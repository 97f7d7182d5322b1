// SPDX-License-Identifier: GPL-3.0-or-later
// Functions whose wrong calls are answered with a sentence, where pybind11 would list C++ signatures.
#pragma once

#include "arrays.h"

#include <mrc/options.h>
#include <mrc/scales.h>

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mrc_python {

/// What an argument of a type may be, in words; any object where the function itself converts it.
template <class T>
struct Expected {
    static constexpr const char* words = "";
    static bool accepts(const py::handle&) { return true; }
};
template <>
struct Expected<mrc::Surface> {
    static constexpr const char* words = "a mrcontour.Surface";
    static bool accepts(const py::handle& value) { return py::isinstance<mrc::Surface>(value); }
};
template <>
struct Expected<mrc::Options> {
    static constexpr const char* words = "a mrcontour.Options";
    static bool accepts(const py::handle& value) { return py::isinstance<mrc::Options>(value); }
};
template <>
struct Expected<std::optional<mrc::Scales>> {
    static constexpr const char* words = "the mrcontour.Scales of an earlier result, or None";
    static bool accepts(const py::handle& value) { return value.is_none() || py::isinstance<mrc::Scales>(value); }
};
template <>
struct Expected<bool> {
    static constexpr const char* words = "True or False";
    static bool accepts(const py::handle& value) { return py::detail::make_caster<bool>().load(value, true); }
};
template <>
struct Expected<Iterable> {
    static constexpr const char* words = "a sequence";
    static bool accepts(const py::handle& value) { return py::isinstance<py::iterable>(value); }
};
template <>
struct Expected<std::string> {
    static constexpr const char* words = "a string";
    static bool accepts(const py::handle& value) { return py::isinstance<py::str>(value); }
};

struct Parameter {
    std::string name;
    bool required;
    const char* expected;
    bool (*accepts)(const py::handle&);
};

/// A function as its callers see it.
struct Signature {
    std::string name;  ///< as in a call
    std::vector<Parameter> parameters;
    std::string advice;  ///< where an argument is missing
};

/// Calls the function. Where it does not take the arguments, says which one is wrong.
/// @throws TypeError.
py::object call(const py::object& function, const Signature& signature, const py::args& positional, const py::kwargs& named,
                std::size_t bound = 0);

template <class T, class Argument>
Parameter parameter(const Argument& argument) {
    constexpr bool required = !std::is_base_of_v<py::arg_v, Argument>;
    return {argument.name, required, Expected<T>::words, &Expected<T>::accepts};
}

template <class Return, class... Parameters, class... Arguments>
Signature signature_of(std::string name, Return (*)(Parameters...), std::string advice, const Arguments&... arguments) {
    return {std::move(name), {parameter<std::remove_cvref_t<Parameters>>(arguments)...}, std::move(advice)};
}

/// `word` makes the documentation from pybind11's, which begins with the signature.
template <class Word, class Function, class... Arguments>
void define_worded(py::module_& module, const char* name, Function* function, Word&& word, const char* documentation,
                   const Arguments&... arguments) {
    const py::object typed = py::cpp_function(function, py::name(name), documentation, arguments...);
    const Signature signature = signature_of(name, function, {}, arguments...);
    const std::string text = word(py::cast<std::string>(typed.attr("__doc__")));
    py::options own_signatures;
    own_signatures.disable_function_signatures();
    module.def(
        name,
        [typed, signature](const py::args& positional, const py::kwargs& named) {
            return call(typed, signature, positional, named);
        },
        text.c_str());
}

template <class Function, class... Arguments>
void define(py::module_& module, const char* name, Function* function, const char* documentation, const Arguments&... arguments) {
    define_worded(
        module, name, function, [](std::string text) { return text; }, documentation, arguments...);
}

/// The same for a constructor; `advice` follows where an argument is missing.
template <class Class, class Function, class... Arguments>
void define_constructor_with_advice(Class& bound, Function* function, const char* advice, const char* documentation,
                                    const Arguments&... arguments) {
    bound.def(py::init(function), documentation, arguments...);
    const py::object typed = bound.attr("__init__");
    const Signature signature = signature_of(py::cast<std::string>(bound.attr("__name__")), function, advice, arguments...);
    py::options own_signatures;
    own_signatures.disable_function_signatures();
    const auto text = py::cast<std::string>(typed.attr("__doc__"));
    bound.attr("__init__") = py::cpp_function(
        [typed, signature](const py::args& positional, const py::kwargs& named) { call(typed, signature, positional, named, 1); },
        py::name("construct"), py::is_method(bound), text.c_str());  // pybind11 takes an __init__ for one that fills in self
}

template <class Class, class Function, class... Arguments>
void define_constructor(Class& bound, Function* function, const char* documentation, const Arguments&... arguments) {
    define_constructor_with_advice(bound, function, "", documentation, arguments...);
}

}  // namespace mrc_python
