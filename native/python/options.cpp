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
constexpr Names<Ends, 3> ends_names{{{"edges", Ends::edges}, {"vertices", Ends::vertices}, {"border", Ends::border}}};
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
                     double max_turn, int iterations, std::optional<double> band_distance, double anchor,
                     std::optional<double> feature_clamp, double crease, double length_bias, double length_floor,
                     const std::string& length_measure, const std::string& denominator, std::optional<double> min_salience,
                     int refinement, int regular_iterations, const std::string& ends, double region_weight,
                     const std::string& region_side, int threads) {
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
    options.band_distance = band_distance;
    options.anchor = anchor;
    options.feature_clamp = feature_clamp;
    options.crease = crease;
    options.length_bias = length_bias;
    options.length_floor = length_floor;
    options.length_measure = parse(length_measure_names, "length_measure", length_measure);
    options.denominator = parse(denominator_names, "denominator", denominator);
    options.min_salience = min_salience;
    options.ends = parse(ends_names, "ends", ends);
    options.region_weight = region_weight;
    options.region_side = parse(region_side_names, "region_side", region_side);
    options.refinement = refinement;
    options.regular_iterations = regular_iterations;
    options.threads = threads;
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
             py::arg("iterations") = defaults.iterations, py::arg("band_distance") = defaults.band_distance,
             py::arg("anchor") = defaults.anchor, py::arg("feature_clamp") = defaults.feature_clamp,
             py::arg("crease") = defaults.crease, py::arg("length_bias") = defaults.length_bias,
             py::arg("length_floor") = defaults.length_floor,
             py::arg("length_measure") = name_of(length_measure_names, defaults.length_measure),
             py::arg("denominator") = name_of(denominator_names, defaults.denominator),
             py::arg("min_salience") = defaults.min_salience, py::arg("refinement") = defaults.refinement,
             py::arg("regular_iterations") = defaults.regular_iterations, py::arg("ends") = name_of(ends_names, defaults.ends),
             py::arg("region_weight") = defaults.region_weight,
             py::arg("region_side") = name_of(region_side_names, defaults.region_side), py::arg("threads") = defaults.threads,
             "width: rings of faces to each side, at least 1; None: until topology stops the band (4.2.1).\n"
             "band_distance: besides, from the third ring on, only faces within this distance of the contour, in average radii of\n"
             "the connected component; None: no bound.\n"
             "refinement: k Steiner points on each edge, 0 or more; 0: contours keep to mesh edges (3.2).\n"
             "regular_iterations, iterations: along mesh edges first, then with refinement; each searches a band around the last\n"
             "one's result and ends early where nothing moves (5.3, 5.6).\n"
             "curvature_radius: of the disk that curvature is averaged over, in mean edge lengths, above 0 (3.4).\n"
             "curvature_smoothing: sigma of the tensor's Gaussian, in mean edge lengths; 0: none (3.4).\n"
             "kappa0_factor: kappa_0 of eq. 3.2 over the mean curvature K, above 0.\n"
             "feature_exponent, direction_exponent: on the curvature and on the cosines of eq. 3.2, above 0.\n"
             "feature: 'valley', or 'ridge' for contours along crests (3.4, footnote).\n"
             "feature_clamp: quantile in (0, 1) of the concave curvatures near the contour where their size is cut off; None: "
             "none.\n"
             "crease: pull of crisp concave edges onto themselves, 0 or more.\n"
             "anchor: how strongly the contour is held near the given one, 0 or more.\n"
             "length_bias: weight of length / L0 beside ratio / K, 0 or more (6.1.1); length_floor: below this share of L0 nothing "
             "is\n"
             "gained by shrinking.\n"
             "length_measure, denominator: 'arc' and 'length', or 'edges' and 'arcs' (appendix A).\n"
             "region_weight, region_side: of the density enclosed on the 'left' or 'right' (6.1.2).\n"
             "min_salience: where the best found is less salient than this, the given contour stays; None: it always moves.\n"
             "ends: of open curves: 'edges' holds the first and last edge, 'vertices' their ends, 'border' lets ends on the mesh\n"
             "border slide along it (4.6).\n"
             "threads: on which optimize_all works; 0: as many as the machine has. No result depends on it.\n"
             "flow: 'gates', 'arc_length' or 'harmonic' (4.2.3).\n"
             "max_turn: radians in the tangent plane, above 0 and at most pi; sharper turns are pruned (3.2).")
        .def_readonly("width", &Options::width)
        .def_readonly("curvature_radius", &Options::curvature_radius)
        .def_readonly("curvature_smoothing", &Options::curvature_smoothing)
        .def_property_readonly("flow", [](const Options& o) { return name_of(flow_names, o.flow); })
        .def_readonly("kappa0_factor", &Options::kappa0_factor)
        .def_readonly("feature_exponent", &Options::feature_exponent)
        .def_readonly("direction_exponent", &Options::direction_exponent)
        .def_property_readonly("feature", [](const Options& o) { return name_of(feature_names, o.feature); })
        .def_readonly("max_turn", &Options::max_turn)
        .def_readonly("iterations", &Options::iterations)
        .def_readonly("regular_iterations", &Options::regular_iterations)
        .def_readonly("refinement", &Options::refinement)
        .def_readonly("band_distance", &Options::band_distance)
        .def_readonly("anchor", &Options::anchor)
        .def_readonly("feature_clamp", &Options::feature_clamp)
        .def_readonly("crease", &Options::crease)
        .def_readonly("min_salience", &Options::min_salience)
        .def_readonly("length_bias", &Options::length_bias)
        .def_readonly("length_floor", &Options::length_floor)
        .def_property_readonly("length_measure", [](const Options& o) { return name_of(length_measure_names, o.length_measure); })
        .def_property_readonly("denominator", [](const Options& o) { return name_of(denominator_names, o.denominator); })
        .def_property_readonly("ends", [](const Options& o) { return name_of(ends_names, o.ends); })
        .def_readonly("threads", &Options::threads)
        .def_readonly("region_weight", &Options::region_weight)
        .def_property_readonly("region_side", [](const Options& o) { return name_of(region_side_names, o.region_side); });
}

}  // namespace mrc_python
