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
    none,          ///< it is not returned
    already_best,  ///< nothing in its band is better
    not_salient,   ///< nothing concave was found (min_salience); also set for a constrained result, which is not the given one
    no_room,       ///< no band can grow: its faces touch it all around
    against_flow,  ///< no contour in the band runs along with the flow
    no_neighbour,  ///< the given contour is refined, and no simple contour along edges lies beside it
    shared_faces,  ///< no band can grow: other contours cross its faces too
    none_refined,  ///< a contour along edges is better, but none with Steiner points is
    slipped_off,   ///< the best found follows nothing and cuts off next to nothing: it has slipped off the part, onto its tip
    cancelled,
};

/// The columns of tables 5.1 and 5.2, for the last iteration unless a comment says otherwise.
struct Statistics {
    int faces = 0;  ///< polygons in the band
    int cut = 0;    ///< chords that cross the chosen level
    int nodes = 0;
    int arcs = 0;
    int linear_steps = 0;  ///< times that lambda fell
    int passes = 0;        ///< relaxations of the graph
    int iterations = 0;    ///< how many were done in the whole call
    int rings = 0;         ///< how many edges lead from the given contour to the farthest point of the one returned
    std::map<std::string, double> seconds;  ///< of each stage by name, summed over the iterations
};

/// What a search found. Points, ratios and scales are in the mesh's unit of length.
struct Result {
    Contour contour;
    double length = 0.0;  ///< of the contour returned, along its segments
    Status status = Status::unchanged;
    Reason reason_code = Reason::none;
    std::string reason;                               ///< the same in words
    double ratio = 0.0, initial_ratio = 0.0;          ///< of the contour returned and of the given one, 1 / unit of length
    double objective = 0.0, initial_objective = 0.0;  ///< what is minimized: see `Measure::objective`
    /// Of the best found, even where the given contour is returned: minus the ratio of eq. 3.2's energy alone, over K. That
    /// energy includes the clamp, but not anchor, crease, attractors and region.
    double salience = 0.0;
    double lower_bound = 0.0;  ///< no contour of the last iteration's graph, nor the given one, has a lower objective
    double gap = 0.0;          ///< objective of the best found minus lower_bound, never negative
    /// The objective of the contour that the iterations start from, then that after each iteration that had a band: one such
    /// series for the iterations along edges, and one for those with refinement. Where the given contour breaks a requirement,
    /// the first contour that keeps all is the start.
    std::vector<double> history;
    std::vector<int> held_back_by;  ///< of several contours: those that kept this one's last band from growing, ascending
    /// Vertices at which the last band had to stop: beside it lie faces at vertices with more than one fan, at edges of more than
    /// two faces, or at edges whose two normals disagree. Ascending.
    std::vector<int> non_manifold;
    Scales scales;
    Statistics statistics;
};

/// Moves a contour to the one of least ratio in a band around it (chapter 4).
///
/// `scales`: those of an earlier result, to continue from it; none: they are computed from this contour.
/// `progress` is called three times per iteration, and every few milliseconds during long phases.
/// @throws InvalidInput for options and constraints out of range, and for contours that are not simple, not inside the mesh or
/// cross a barrier.
/// @throws Infeasible where no contour of the band has all required elements.
/// @throws TooLarge where the search would take more memory than there is, or more arcs than can be counted.
Result optimize(const Surface& surface, const Contour& contour, const Options& options = {}, const Constraints& constraints = {},
                const std::optional<Scales>& scales = std::nullopt, const Progress& progress = {});

/// One of several contours, with its own constraints and scales.
struct Task {
    Contour contour;
    Constraints constraints;
    std::optional<Scales> scales;  ///< as for `optimize`
};

/// Optimizes several contours of one mesh, which never cross or touch each other where the given ones did not (1.4).
///
/// They move together, iteration by iteration: each searches the faces that are nearer to it than to any other contour, and what
/// two bands have in common is closed to both. The results have the order of the tasks, but depend neither on it nor on the
/// number of threads.
/// @throws what `optimize` throws, for the first contour in error. The error holds the contour's place in the list; where there
/// are several contours, the message begins with it.
std::vector<Result> optimize_all(const Surface& surface, std::span<const Task> tasks, const Options& options = {},
                                 const Progress& progress = {});

/// The result of one of several contours, or its error. `InvalidInput::raise` throws TooLarge and Infeasible as such.
using Outcome = std::variant<Result, InvalidInput>;

/// As `optimize_all`, but a contour in error gets its error, which holds its place, and the others are optimized all the same.
///
/// A contour that is refused before any search stays where it is, and its real edges are barriers for all others. A contour that
/// already crosses them is returned unchanged; where the refused contour crosses faces, others may cross it. A contour whose
/// search fails returns to its given place, which all others avoid from the start. Without errors the results are those of
/// `optimize_all`.
/// @throws InvalidInput for options out of range only.
std::vector<Outcome> optimize_each(const Surface& surface, std::span<const Task> tasks, const Options& options = {},
                                   const Progress& progress = {});

}  // namespace mrc
