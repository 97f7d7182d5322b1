// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/constraints.h>
#include <mrc/errors.h>
#include <mrc/options.h>
#include <mrc/scales.h>
#include <mrc/surface.h>

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace mrc {

/// `constrained`: the given contour breaks a requirement, and the best that keeps all is returned, whatever its objective.
enum class Status { improved, unchanged, constrained, cancelled };

/// Why the given contour is returned.
enum class Reason {
    none,          ///< it is not
    already_best,  ///< nothing in its band is better
    not_salient,   ///< there is nothing concave to find (min_salience); of a constrained result too, which is not the given one
    no_room,       ///< no band can grow: its faces touch it all around
    against_flow,  ///< no contour in the band runs along with the flow
    no_neighbour,  ///< it is refined, and no simple contour along edges lies beside it
    shared_faces,  ///< no band can grow: other contours cross its faces too
    none_refined,  ///< what is better along edges is not with Steiner points
    cancelled,
};

/// The columns of tables 5.1 and 5.2, of the last iteration but where a sum is named.
struct Statistics {
    int faces = 0;  ///< polygons in the band
    int cut = 0;    ///< chords that cross the chosen level
    int nodes = 0;
    int arcs = 0;
    int linear_steps = 0;                   ///< times that lambda fell
    int passes = 0;                         ///< relaxations of the graph
    int iterations = 0;                     ///< done, over the whole call
    std::map<std::string, double> seconds;  ///< a stage, summed over the iterations
};

/// What a search found. Points, ratios and scales are in the mesh's unit of length.
struct Result {
    Contour contour;
    double length = 0.0;  ///< of the contour returned, along its segments
    Status status = Status::unchanged;
    Reason reason_code = Reason::none;
    std::string reason;                               ///< the same in words
    double ratio = 0.0, initial_ratio = 0.0;          ///< of the contour returned and of the given one, 1 / unit of length
    double objective = 0.0, initial_objective = 0.0;  ///< what is minimized: see `Objective`
    /// Of the best found, even where the given contour is returned: minus the ratio of eq. 3.2's energy alone (with the clamp; without
    /// anchor, crease, attractors and region), over K.
    double salience = 0.0;
    double lower_bound = 0.0;  ///< no contour of the last iteration's graph, nor the given one, has a lower objective
    double gap = 0.0;          ///< objective of the best found minus lower_bound, never negative
    /// The objective after each iteration that had a band, before these that of the contour they start from: once for those along edges and once for
    /// those with refinement. Where the given contour breaks a requirement, the first that keeps all is the start.
    std::vector<double> history;
    std::vector<int> held_back_by;  ///< of several contours: which ones kept this one's last band from growing, ascending
    Scales scales;
    Statistics statistics;
};

/// Moves a contour to the one of least ratio in a band around it (chapter 4).
///
/// `scales`: those of an earlier result, to go on from it; none: of this contour.
/// `progress` is called at each of three phases an iteration, and in long phases again every few milliseconds.
/// @throws InvalidInput for options and constraints out of range and for contours that are not simple, not inside the mesh or cross a
/// barrier.
/// @throws Infeasible where no contour of the band has all required elements.
/// @throws TooLarge where the search would take more memory than there is, or more arcs than can be counted.
Result optimize(const Surface& surface, const Contour& contour, const Options& options = {}, const Constraints& constraints = {},
                const std::optional<Scales>& scales = std::nullopt, const Progress& progress = {});

/// One of several contours, with what is its own.
struct Task {
    Contour contour;
    Constraints constraints;
    std::optional<Scales> scales;  ///< those of an earlier result, to go on from it; none: of this contour
};

/// Optimizes several contours of one mesh, which never cross or touch each other where the given ones did not (1.4).
///
/// They move together, iteration by iteration: each has the faces that are nearer to it than to any other, and what two bands have
/// in common is closed to both. The results have the order of the tasks, but depend neither on it nor on the number of threads.
/// @throws as `optimize` does, of several contours in error for the first by its place; the error has that place, and of several
/// contours the message begins with it.
std::vector<Result> optimize_all(const Surface& surface, std::span<const Task> tasks, const Options& options = {},
                                 const Progress& progress = {});

/// What one of several contours gets. `InvalidInput::raise` throws TooLarge and Infeasible as such.
using Outcome = std::variant<Result, InvalidInput>;

/// The same, but a contour in error gets its error, which has its place, and the others are optimized all the same.
///
/// A contour that is refused at first stays where it is: where it runs along real edges, these are barriers for all others. One that
/// crosses them already just finds no room there, and across faces nothing is kept from it. A contour whose search fails goes back
/// to its given place, of which all others keep clear from the first. Without errors the results are those of `optimize_all`.
/// @throws InvalidInput for options out of range only.
std::vector<Outcome> optimize_each(const Surface& surface, std::span<const Task> tasks, const Options& options = {},
                                   const Progress& progress = {});

}  // namespace mrc
