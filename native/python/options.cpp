// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.h"

#include <mrc/options.h>
#include <mrc/types.h>

#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>

namespace mrc_python {
namespace {

namespace py = pybind11;
using mrc::Feature;
using mrc::FlowKind;
using mrc::Options;

template <class Enum, std::size_t N>
using Names = std::array<std::pair<const char*, Enum>, N>;

constexpr Names<FlowKind, 3> flow_names{
    {{"gates", FlowKind::gates}, {"arc_length", FlowKind::arc_length}, {"harmonic", FlowKind::harmonic}}};
constexpr Names<Feature, 2> feature_names{{{"valley", Feature::valley}, {"ridge", Feature::ridge}}};

template <class Enum, std::size_t N>
Enum parse(const Names<Enum, N>& names, const char* option, const std::string& name) {
    std::string known;
    for (const auto& [text, value] : names) {
        if (name == text) return value;
        known += (known.empty() ? "'" : ", '") + std::string(text) + "'";
    }
    throw mrc::InvalidInput("option " + std::string(option) + " is '" + name + "': it must be one of " + known);
}

template <class Enum, std::size_t N>
std::string name_of(const Names<Enum, N>& names, Enum value) {
    for (const auto& [text, candidate] : names) {
        if (candidate == value) return text;
    }
    return {};
}

Options make_options(std::optional<int> width, double curvature_radius, double curvature_smoothing, const std::string& flow,
                     double kappa0_factor, double feature_exponent, double direction_exponent, const std::string& feature,
                     double max_turn, int iterations) {
    Options options;
    options.width = width;
    options.curvature_radius = curvature_radius;
    options.curvature_smoothing = curvature_smoothing;
    options.flow = parse(flow_names, "flow", flow);
    options.kappa0_factor = kappa0_factor;
    options.feature_exponent = feature_exponent;
    options.direction_exponent = direction_exponent;
    options.feature = parse(feature_names, "feature", feature);
    options.max_turn = max_turn;
    options.iterations = iterations;
    options.check();
    return options;
}

}  // namespace

void bind_options(py::module_& module) {
    const Options defaults;
    py::class_<Options>(module, "Options", "The settings of the method. All are given by keyword; unknown ones are a TypeError.")
        .def(py::init(&make_options), py::kw_only(), py::arg("width") = defaults.width,
             py::arg("curvature_radius") = defaults.curvature_radius, py::arg("curvature_smoothing") = defaults.curvature_smoothing,
             py::arg("flow") = name_of(flow_names, defaults.flow), py::arg("kappa0_factor") = defaults.kappa0_factor,
             py::arg("feature_exponent") = defaults.feature_exponent, py::arg("direction_exponent") = defaults.direction_exponent,
             py::arg("feature") = name_of(feature_names, defaults.feature), py::arg("max_turn") = defaults.max_turn,
             py::arg("iterations") = defaults.iterations,
             "width: rings of faces to each side, at least 1; None: until topology stops the band (4.2.1).\n"
             "curvature_radius: of the disk that curvature is averaged over, in mean edge lengths, above 0 (3.4).\n"
             "curvature_smoothing: sigma of the tensor's Gaussian, in mean edge lengths; 0: none (3.4).\n"
             "flow: 'gates', 'arc_length' or 'harmonic' (4.2.3).\n"
             "kappa0_factor: kappa_0 of eq. 3.2 over the mean curvature K, above 0.\n"
             "feature_exponent, direction_exponent: on the curvature and on the cosines of eq. 3.2, above 0.\n"
             "feature: 'valley', or 'ridge' for contours along crests (3.4, footnote).\n"
             "max_turn: radians in the tangent plane, above 0 and at most pi; sharper turns are pruned (3.2).\n"
             "iterations: each searches a band around the last one's result, 0 or more (5.3).")
        .def_readonly("width", &Options::width)
        .def_readonly("curvature_radius", &Options::curvature_radius)
        .def_readonly("curvature_smoothing", &Options::curvature_smoothing)
        .def_property_readonly("flow", [](const Options& o) { return name_of(flow_names, o.flow); })
        .def_readonly("kappa0_factor", &Options::kappa0_factor)
        .def_readonly("feature_exponent", &Options::feature_exponent)
        .def_readonly("direction_exponent", &Options::direction_exponent)
        .def_property_readonly("feature", [](const Options& o) { return name_of(feature_names, o.feature); })
        .def_readonly("max_turn", &Options::max_turn)
        .def_readonly("iterations", &Options::iterations);
}

}  // namespace mrc_python
