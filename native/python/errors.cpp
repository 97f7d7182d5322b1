// SPDX-License-Identifier: GPL-3.0-or-later
#include "errors.h"

#include "bindings.h"

#include <pybind11/gil_safe_call_once.h>
#include <pybind11/typing.h>

#include <optional>
#include <string>
#include <utility>

namespace mrc_python {
namespace {

namespace py = pybind11;

#ifdef PYBIND11_TYPING_H_HAS_STRING_LITERAL
using Kind = py::typing::Literal<"'vertex'", "'edge'", "'face'">;
#else  // clang before 18 takes no text as a template's argument
using Kind = py::str;
#endif
using Id = py::typing::Union<int, py::typing::Tuple<int, int>>;
using Elements = py::typing::Tuple<py::typing::Tuple<Kind, Id>, py::ellipsis>;
using Place = py::typing::Optional<int>;

struct Classes {
    py::object invalid_input, too_large, infeasible;

    const py::object& of(mrc::ErrorCode code) const {
        if (code == mrc::ErrorCode::too_large) return too_large;
        return code == mrc::ErrorCode::infeasible ? infeasible : invalid_input;
    }
};

PYBIND11_CONSTINIT py::gil_safe_call_once_and_store<Classes> classes;

py::tuple to_tuple(const mrc::Element& element) {
    const auto [a, b] = element.ids;
    switch (element.kind) {
        case mrc::Element::Kind::vertex:
            return py::make_tuple("vertex", a);
        case mrc::Element::Kind::edge:
            return py::make_tuple("edge", py::make_tuple(a, b));
        case mrc::Element::Kind::face:
            return py::make_tuple("face", a);
    }
    return py::tuple();
}

py::tuple to_tuple(const std::vector<mrc::Element>& elements) {
    py::tuple tuple(elements.size());
    for (std::size_t i = 0; i < elements.size(); ++i) tuple[i] = to_tuple(elements[i]);
    return tuple;
}

/// A property of an exception whose value lies in its __dict__, so that it is pickled with it.
template <class Value>
py::object property(const char* name, const py::object& absent, const char* words) {
    const std::string hidden = std::string("_") + name;
    const py::cpp_function get(
        [hidden, absent](const PyInvalidInput& self) { return Value(py::getattr(self, hidden.c_str(), absent)); }, py::name(name));
    return py::module_::import("builtins").attr("property")(get, py::none(), py::none(), words);
}

py::object make_class(py::module_& module, const char* name, const py::handle& base, const py::dict& members, const char* words) {
    const std::string full = py::cast<std::string>(module.attr("__name__")) + "." + name;
    PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), words, base.ptr(), members.ptr());
    if (!made) throw py::error_already_set();
    module.attr(name) = py::reinterpret_steal<py::object>(made);
    return module.attr(name);
}

Classes make_classes(py::module_& module) {
    py::dict members;
    members["code"] =
        property<py::str>("code", py::str(), "str: what is wrong, such as 'not_simple'; codes are stable, messages are not.");
    members["elements"] = property<Elements>(
        "elements", py::tuple(),
        "tuple of (kind, id): what the message names; kind is 'vertex', 'edge' or 'face', the id of an edge a pair of vertices.");
    members["contour"] = property<Place>("contour", py::none(), "int or None: the contour's place in the list of optimize_all.");
    const py::object invalid_input = make_class(
        module, "InvalidInput", PyExc_ValueError, members,
        "Input that cannot be used. The message names the elements and says what to do; it begins with the contour's place\n"
        "where optimize_all raises it for one of several contours. It can be pickled.");
    return {invalid_input,
            make_class(module, "TooLarge", invalid_input, py::dict(),
                       "The search would take more memory than there is. The message says what to lower."),
            make_class(module, "Infeasible", invalid_input, py::dict(),
                       "No contour of the band has all required elements (4.4). The message says where the search stops.")};
}

}  // namespace

PyInvalidInput to_python(const mrc::InvalidInput& error) {
    const py::object made = classes.get_stored().of(error.code())(error.what());
    made.attr("_code") = std::string(mrc::code_name(error.code()));
    made.attr("_elements") = to_tuple(error.elements());
    const std::optional<int> place = error.contour();
    made.attr("_contour") = place ? py::object(py::int_(*place)) : py::none();
    return py::reinterpret_borrow<PyInvalidInput>(made);
}

void bind_errors(py::module_& module) {
    classes.call_once_and_store_result([&] { return make_classes(module); });
    py::register_local_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(std::move(thrown));
        } catch (const mrc::InvalidInput& error) {
            const PyInvalidInput raised = to_python(error);
            PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(raised.ptr())), raised.ptr());
        }
    });
}

}  // namespace mrc_python
