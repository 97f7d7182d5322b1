// SPDX-License-Identifier: GPL-3.0-or-later
#include "define.h"

#include "bindings.h"

#include <algorithm>

namespace mrc_python {
namespace {

std::string type_of(const py::handle& value) {
    return value.is_none() ? "None" : py::cast<std::string>(py::type::handle_of(value).attr("__name__"));
}

/// Whether pybind11 found no way to convert the arguments. A refusal from within a caller's own function has a traceback.
bool is_refusal(const py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError) || error.trace()) return false;
    const auto message = py::cast<std::string>(py::str(error.value()));
    return message.find("(): incompatible function arguments") != std::string::npos ||
           message.find("(): incompatible constructor arguments") != std::string::npos;
}

std::string names_of(const Signature& signature) {
    std::string names;
    for (const Parameter& p : signature.parameters) names += (names.empty() ? "" : ", ") + p.name;
    return names;
}

std::string unknown_argument(const Signature& signature, const std::string& name) {
    const std::string begins = signature.name + " takes no argument '" + name + "'";
    const auto& parameters = signature.parameters;
    const bool has_options = std::ranges::any_of(parameters, [](const Parameter& p) { return p.name == "options"; });
    if (has_options && is_option(name)) return begins + "; it is an option: options=Options(" + name + "=...)";
    return begins + ": it takes " + names_of(signature);
}

/// What is wrong with a call; `positional` are the arguments after those that are bound, as self.
std::string complaint(const Signature& signature, const std::vector<py::object>& positional, const py::kwargs& named) {
    const auto& parameters = signature.parameters;
    if (positional.size() > parameters.size()) {
        return signature.name + " takes at most " + std::to_string(parameters.size()) + " arguments, not " +
               std::to_string(positional.size()) + ": " + names_of(signature);
    }
    for (const auto& [key, value] : named) {
        const auto name = key.cast<std::string>();
        const auto place = std::ranges::find(parameters, name, &Parameter::name);
        if (place == parameters.end()) return unknown_argument(signature, name);
        if (place - parameters.begin() < static_cast<std::ptrdiff_t>(positional.size())) {
            return signature.name + " is given " + name + " twice";
        }
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const Parameter& p = parameters[i];
        const bool given = i < positional.size() || named.contains(p.name);
        if (!given && p.required) {
            return signature.name + " needs the argument " + p.name + (signature.advice.empty() ? "" : ": " + signature.advice);
        }
        if (!given) continue;
        const py::object value = i < positional.size() ? positional[i] : py::object(named[p.name.c_str()]);
        if (!p.accepts(value)) return p.name + " must be " + p.expected + ", not " + type_of(value);
    }
    return "the arguments do not fit: see help(mrcontour." + signature.name + ")";
}

}  // namespace

py::object call(const py::object& function, const Signature& signature, const py::args& positional, const py::kwargs& named,
                std::size_t bound) {
    try {
        return function(*positional, **named);
    } catch (const py::error_already_set& error) {
        if (!is_refusal(error)) throw;
    }
    std::vector<py::object> given;
    for (std::size_t i = bound; i < positional.size(); ++i) given.push_back(positional[i]);
    throw py::type_error(complaint(signature, given, named));
}

}  // namespace mrc_python
