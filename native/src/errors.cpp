// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/errors.h>

#include <utility>

namespace mrc {

std::string_view code_name(ErrorCode code) {
    switch (code) {
        case ErrorCode::invalid_option:
            return "invalid_option";
        case ErrorCode::wrong_size:
            return "wrong_size";
        case ErrorCode::out_of_range:
            return "out_of_range";
        case ErrorCode::not_finite:
            return "not_finite";
        case ErrorCode::invalid_face:
            return "invalid_face";
        case ErrorCode::invalid_triangles:
            return "invalid_triangles";
        case ErrorCode::too_short:
            return "too_short";
        case ErrorCode::invalid_parameter:
            return "invalid_parameter";
        case ErrorCode::no_edge:
            return "no_edge";
        case ErrorCode::off_surface:
            return "off_surface";
        case ErrorCode::not_simple:
            return "not_simple";
        case ErrorCode::on_border:
            return "on_border";
        case ErrorCode::non_manifold:
            return "non_manifold";
        case ErrorCode::hidden_face:
            return "hidden_face";
        case ErrorCode::crosses_barrier:
            return "crosses_barrier";
        case ErrorCode::no_length:
            return "no_length";
        case ErrorCode::incomputable_scales:
            return "incomputable_scales";
        case ErrorCode::no_neighbor:
            return "no_neighbor";
        case ErrorCode::invalid_attractor:
            return "invalid_attractor";
        case ErrorCode::open_region:
            return "open_region";
        case ErrorCode::other_surface:
            return "other_surface";
        case ErrorCode::outside_band:
            return "outside_band";
        case ErrorCode::touches_other_contour:
            return "touches_other_contour";
        case ErrorCode::not_open:
            return "not_open";
        case ErrorCode::not_on_vertices:
            return "not_on_vertices";
        case ErrorCode::no_path_around:
            return "no_path_around";
        case ErrorCode::too_large:
            return "too_large";
        case ErrorCode::infeasible:
            return "infeasible";
    }
    return {};
}

InvalidInput::InvalidInput(ErrorCode code, const std::string& sentence, std::vector<Element> elements)
    : InvalidInput(sentence, Details{code, sentence, std::move(elements), std::nullopt}) {}

InvalidInput::InvalidInput(const std::string& what, Details details)
    : std::invalid_argument(what), details_(std::make_shared<const Details>(std::move(details))) {}

InvalidInput InvalidInput::of_contour(std::optional<int> place, const std::string& prefix) const {
    return {prefix + sentence(), Details{code(), sentence(), elements(), place}};
}

void InvalidInput::raise() const {
    switch (code()) {
        case ErrorCode::too_large:
            throw TooLarge(*this);
        case ErrorCode::infeasible:
            throw Infeasible(*this);
        default:
            throw InvalidInput(*this);
    }
}

}  // namespace mrc
