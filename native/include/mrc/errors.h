// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/types.h>

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mrc {

/// What is wrong with an input. The enumerators and their names are stable; messages may be reworded.
enum class ErrorCode {
    // options, surfaces, and what comes in arrays
    invalid_option,
    wrong_size,         ///< an array's
    out_of_range,       ///< an id
    not_finite,         ///< a number that is not finite or beyond 1e50
    invalid_face,       ///< fewer than three vertices, or repeated ones
    invalid_triangles,  ///< no triangulation of their face
    // contours
    too_short,
    invalid_parameter,  ///< a point's t is not from 0 to 1
    no_edge,            ///< two vertices that no edge of the mesh joins
    off_surface,        ///< consecutive points that no triangle holds
    not_simple,         ///< it touches or crosses itself
    on_border,
    non_manifold,
    hidden_face,
    crosses_barrier,
    no_length,            ///< all points lie at one place
    incomputable_scales,  ///< lengths or curvatures too large or too small to compute with
    no_neighbor,          ///< no simple contour along mesh edges lies beside it
    // constraints
    invalid_attractor,
    open_region,            ///< a region density with an open contour
    other_surface,          ///< scales of another surface
    outside_band,           ///< a required element that no contour reaches
    touches_other_contour,  ///< a required edge that another contour or its band touches
    // close_contour
    not_open,
    not_on_vertices,
    no_path_around,
    // searches
    too_large,
    infeasible,
};

/// The enumerator's name, such as "not_simple".
std::string_view code_name(ErrorCode code);

/// A part of the mesh that an error names.
struct Element {
    enum class Kind { vertex, edge, face };
    Kind kind = Kind::vertex;
    std::array<int, 2> ids{no_element, no_element};  ///< of an edge its ends; of others the second is `no_element`

    static Element vertex(int v) { return {Kind::vertex, {v, no_element}}; }
    static Element edge(int a, int b) { return {Kind::edge, {a, b}}; }
    static Element face(int f) { return {Kind::face, {f, no_element}}; }
    bool operator==(const Element&) const = default;
};

/// Input that cannot be used. The message names the elements and says what to do.
///
/// TooLarge and Infeasible add nothing but their class: a copy as InvalidInput keeps everything, and `raise` throws it as what it was.
class InvalidInput : public std::invalid_argument {
  public:
    InvalidInput(ErrorCode code, const std::string& sentence, std::vector<Element> elements = {});

    ErrorCode code() const { return details_->code; }
    const std::vector<Element>& elements() const { return details_->elements; }  ///< first those to look at first
    /// The contour's place in the list of several; none: the error is of no list.
    std::optional<int> contour() const { return details_->contour; }
    /// `what()` without the contour's place.
    const std::string& sentence() const { return details_->sentence; }

    /// The same error, said of a contour of a list or of none; `what()` begins with the prefix.
    InvalidInput of_contour(std::optional<int> place, const std::string& prefix = {}) const;
    /// Throws TooLarge, Infeasible or InvalidInput, as the code says.
    [[noreturn]] void raise() const;

  private:
    struct Details {
        ErrorCode code;
        std::string sentence;
        std::vector<Element> elements;
        std::optional<int> contour;
    };
    std::shared_ptr<const Details> details_;  // shared, so that copying throws nothing

    InvalidInput(const std::string& what, Details details);
};

/// The search would take more memory than there is. The message says what to lower.
class TooLarge : public InvalidInput {
  public:
    explicit TooLarge(const std::string& sentence) : InvalidInput(ErrorCode::too_large, sentence) {}

  private:
    friend class InvalidInput;
    explicit TooLarge(const InvalidInput& error) : InvalidInput(error) {}
};

/// No contour satisfies the constraints. The message says where the search stops.
class Infeasible : public InvalidInput {
  public:
    explicit Infeasible(const std::string& sentence, std::vector<Element> elements = {})
        : InvalidInput(ErrorCode::infeasible, sentence, std::move(elements)) {}

  private:
    friend class InvalidInput;
    explicit Infeasible(const InvalidInput& error) : InvalidInput(error) {}
};

}  // namespace mrc
