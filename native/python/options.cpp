// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "bindings.h"
#include "values.h"

#include <mrc/errors.h>
#include <mrc/options.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mrc_python {
namespace {

using mrc::Denominator;
using mrc::Ends;
using mrc::Feature;
using mrc::FlowKind;
using mrc::LengthMeasure;
using mrc::Options;
using mrc::RegionSide;

template <class Enum, std::size_t N>
using Names = std::array<std::pair<const char*, Enum>, N>;

constexpr Names<FlowKind, 3> flow_names{
    {{"gates", FlowKind::gates}, {"arc_length", FlowKind::arc_length}, {"harmonic", FlowKind::harmonic}}};
constexpr Names<Ends, 4> ends_names{
    {{"edges", Ends::edges}, {"vertices", Ends::vertices}, {"border", Ends::border}, {"edges_or_border", Ends::edges_or_border}}};
constexpr Names<RegionSide, 2> region_side_names{{{"left", RegionSide::left}, {"right", RegionSide::right}}};
constexpr Names<LengthMeasure, 2> length_measure_names{{{"arc", LengthMeasure::arc}, {"edges", LengthMeasure::edges}}};
constexpr Names<Denominator, 2> denominator_names{{{"length", Denominator::length}, {"arcs", Denominator::arcs}}};
constexpr Names<Feature, 2> feature_names{{{"valley", Feature::valley}, {"ridge", Feature::ridge}}};

template <class Enum, std::size_t N>
Enum parse(const Names<Enum, N>& names, const char* option, const std::string& name) {
    std::string known;
    for (const auto& [text, value] : names) {
        if (name == text) return value;
        known += (known.empty() ? "'" : ", '") + std::string(text) + "'";
    }
    throw mrc::InvalidInput(mrc::ErrorCode::invalid_option,
                            "option " + std::string(option) + " is '" + name + "': it must be one of " + known);
}

template <class Enum, std::size_t N>
std::string name_of(const Names<Enum, N>& names, Enum value) {
    for (const auto& [text, candidate] : names) {
        if (candidate == value) return text;
    }
    return {};
}

/// One option: its type in Python's words, how it is set from Python and read back, and what it means.
struct Row {
    const char* name;
    std::string type;
    std::function<void(Options&, const py::object&)> set;
    std::function<py::object(const Options&)> get;
    const char* meaning;
};

template <class T>
T converted(const char* option, const py::object& value) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw py::type_error("option " + std::string(option) + " cannot be " + std::string(py::repr(value)));
    }
}

template <class T>
std::string type_name() {
    if constexpr (std::is_same_v<T, int>) return "int";
    if constexpr (std::is_same_v<T, double>) return "float";
    if constexpr (requires { typename T::value_type; }) return type_name<typename T::value_type>() + " | None";
}

template <class Enum, std::size_t N>
std::string literal(const Names<Enum, N>& names) {
    std::string texts;
    for (const auto& [text, value] : names) texts += (texts.empty() ? "'" : ", '") + std::string(text) + "'";
    return "typing.Literal[" + texts + "]";
}

template <class T>
Row field(const char* name, T Options::*member, const char* meaning) {
    return {name, type_name<T>(), [=](Options& o, const py::object& value) { o.*member = converted<T>(name, value); },
            [=](const Options& o) { return py::cast(o.*member); }, meaning};
}

template <class Enum, std::size_t N>
Row choice(const char* name, const Names<Enum, N>& names, Enum Options::*member, const char* meaning) {
    return {
        name, literal(names),
        [=, &names](Options& o, const py::object& value) { o.*member = parse(names, name, converted<std::string>(name, value)); },
        [=, &names](const Options& o) { return py::cast(name_of(names, o.*member)); }, meaning};
}

const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        field("width", &Options::width,
              "rings of faces on each side, at least 1; None: until topology stops the band (4.2.1);\n"
              "iterations with refinement then search a band of the default width around the regular result"),
        field("band_distance", &Options::band_distance,
              "a further limit from the third ring on: only faces within this distance of the\n"
              "contour, in average radii of the connected component; None: no limit"),
        field("refinement", &Options::refinement, "k Steiner points on each edge, 0 or more; 0: contours keep to mesh edges (3.2)"),
        field("regular_iterations", &Options::regular_iterations,
              "iterations along mesh edges first, 0 or more; each searches a band\n"
              "around the last one's result and ends early where nothing moves (5.3, 5.6)"),
        field("iterations", &Options::iterations, "iterations with refinement, after the regular_iterations, 0 or more"),
        field("length_bias", &Options::length_bias, "weight of length / L0 beside ratio / K, 0 or more (6.1.1)"),
        field("length_floor", &Options::length_floor, "below this fraction of L0 nothing is gained by shrinking, 0 or more"),
        choice("length_measure", length_measure_names, &Options::length_measure, "'arc', or 'edges' (appendix A)"),
        choice("denominator", denominator_names, &Options::denominator,
               "'length', or 'arcs' (appendix A); with a length_bias 'arc'\n"
               "goes with 'length' and 'edges' with 'arcs'"),
        field("anchor", &Options::anchor, "how strongly the contour is held near the given one, 0 or more"),
        field("feature_clamp", &Options::feature_clamp,
              "quantile in (0, 1) of the concave curvatures near the contour where their\n"
              "size is cut off; None: none"),
        field("crease", &Options::crease, "how strongly sharp concave edges pull contours onto themselves, 0 or more"),
        field("min_salience", &Options::min_salience,
              "where the best found is less salient than this, the given contour stays;\n"
              "None: it always moves"),
        field("curvature_radius", &Options::curvature_radius,
              "of the disk that curvature is averaged over, in h, the local scale of\n"
              "the surface, about 0.84 edges; above 0 (3.4)"),
        field("curvature_smoothing", &Options::curvature_smoothing,
              "widens the disk and softens its rim as a Gaussian of this sigma would,\n"
              "in h, 0 or more; 0: the plain disk of eq. 3.4"),
        field("kappa0_factor", &Options::kappa0_factor, "kappa_0 of eq. 3.2 over the mean curvature K, above 0"),
        field("feature_exponent", &Options::feature_exponent, "a: K |kappa / K|^a instead of |kappa|, above 0, at most 16"),
        field("direction_exponent", &Options::direction_exponent,
              "b: sign(c) |c|^b instead of eq. 3.2's cosines c, above 0, at most 16"),
        choice("feature", feature_names, &Options::feature, "'valley', or 'ridge' for contours along crests (3.4, footnote)"),
        choice("flow", flow_names, &Options::flow, "'gates', 'arc_length' or 'harmonic' (4.2.3)"),
        choice("ends", ends_names, &Options::ends,
               "of open curves: 'edges' holds the first and last edge, 'vertices' their ends,\n"
               "'border' and 'edges_or_border' let ends on the mesh border slide along it,\n"
               "and hold the vertices or the edges of others (4.6)"),
        field("max_turn", &Options::max_turn,
              "radians in the tangent plane, above 0 and at most pi; sharper turns are pruned (3.2)"),
        field("region_weight", &Options::region_weight, "weight of the change of the density enclosed, in K / L0 (6.1.2)"),
        choice("region_side", region_side_names, &Options::region_side,
               "'left' or 'right' of the given direction: what is enclosed"),
        field("threads", &Options::threads, "threads of optimize_all; 0: as many as the machine has. No result depends on it"),
    };
    return table;
}

const Row* find_row(const std::string& name) {
    const auto row = std::ranges::find_if(rows(), [&](const Row& r) { return name == r.name; });
    return row == rows().end() ? nullptr : &*row;
}

Options changed(Options options, const py::args& positional, const py::dict& given) {
    if (!positional.empty()) throw py::type_error("options are given by name, as in Options(width=4)");
    for (const auto& [key, value] : given) {
        const auto name = key.cast<std::string>();
        const Row* row = find_row(name);
        if (!row) throw py::type_error("there is no option named '" + name + "'");
        row->set(options, py::reinterpret_borrow<py::object>(value));
    }
    options.check();
    return options;
}

Options make_options(const py::args& positional, const py::kwargs& given) { return changed({}, positional, given); }

Options make_recommended(const py::args& positional, const py::kwargs& given) {
    return changed(Options::recommended(), positional, given);
}

py::dict values_of(const Options& options) {
    py::dict values;
    for (const Row& row : rows()) values[row.name] = row.get(options);
    return values;
}

std::string documentation() {
    const Options defaults;
    std::string text =
        "The settings of the method, all given by keyword. Unknown names and wrong types raise TypeError, values out of range\n"
        "InvalidInput. Sections and equations are those of Clements 2006. With their defaults:\n\n";
    for (const Row& row : rows()) {
        text += std::string(row.name) + " = " + std::string(py::repr(row.get(defaults))) + ": " + row.meaning + ".\n";
    }
    return text;
}

std::string text_of(const Options& options) {
    std::string text;
    for (const Row& row : rows()) {
        text += (text.empty() ? "" : ", ") + std::string(row.name) + "=" + std::string(py::repr(row.get(options)));
    }
    return "Options(" + text + ")";
}

/// The constructors take any keywords and look them up themselves: what they show is written out here, also for type checkers.
std::string keywords(const Options& defaults) {
    std::string text = "*";
    for (const Row& row : rows()) {
        text += ", " + std::string(row.name) + ": " + row.type + " = " + std::string(py::repr(row.get(defaults)));
    }
    return text;
}

}  // namespace

bool is_option(const std::string& name) { return find_row(name) != nullptr; }

void bind_options(py::module_& module) {
    py::class_<Options> options(module, "Options", py::module_local(), documentation().c_str());
    options.def("__repr__", &text_of);
    options.def("__hash__", [](const Options& o) { return py::hash(py::tuple(values_of(o).attr("values")())); });
    define_equality(options);
    define_copies(options);
    options.def(py::pickle(&values_of, [](const py::dict& values) { return changed({}, py::tuple(), values); }));
    py::options own_signatures;
    own_signatures.disable_function_signatures();
    const Options defaults;
    options.def(py::init(&make_options), ("__init__(self: mrcontour.Options, " + keywords(defaults) + ") -> None").c_str());
    const std::string recommended =
        "recommended(" + keywords(Options::recommended()) +
        ") -> mrcontour.Options\n\nThe settings whose contours lie closest to where people draw part "
        "boundaries: the add-on's defaults.\nOptions() has those of the thesis. Changes are given by name.";
    options.def_static("recommended", &make_recommended, recommended.c_str());
    for (const Row& row : rows()) {
        const std::string value = py::repr(row.get(defaults));
        const std::string text = "(self: mrcontour.Options) -> " + row.type + "\n\n" + row.meaning + ". Default: " + value + ".";
        options.def_property_readonly(row.name, py::cpp_function(row.get, text.c_str()));
    }
}

}  // namespace mrc_python
