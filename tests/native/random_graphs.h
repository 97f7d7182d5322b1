// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.h"

#include <array>
#include <ostream>

namespace mrc_test {

/// A random acyclic graph of layers, as a band has them: sources, layers of nodes, destinations.
mrc::WeightedGraph layered_graph(unsigned seed, bool matched, int width = 5, int layers = 5);

enum class Shape {
    layers,       ///< as above
    mesh,         ///< any node to any later one
    sparse_mesh,  ///< the same with so few arcs that many nodes are never reached
    multi_mesh,   ///< the same with up to three arcs between two nodes
    islands,      ///< three meshes, their nodes mixed
    chains,       ///< long and thin, with a few short cuts and changes of chain
    stars         ///< from sources straight to destinations
};
enum class Weights { real, integer, alike, one_sign, scattered };
enum class Terminals { outer, anywhere };  ///< anywhere: also twice on one node, and where other paths run through

/// What random graphs of one kind have in common.
struct GraphKind {
    const char* name;
    Shape shape = Shape::layers;
    Weights weights = Weights::real;
    Terminals terminals = Terminals::outer;
    bool own_weights = false;  ///< the terminals of matched pairs have some, too
};

inline void PrintTo(const GraphKind& kind, std::ostream* out) { *out << kind.name; }

inline constexpr std::array graph_kinds{
    GraphKind{"layers"},
    GraphKind{"ties", Shape::layers, Weights::integer},
    GraphKind{"all_alike", Shape::layers, Weights::alike},
    GraphKind{"own_weights", Shape::layers, Weights::real, Terminals::outer, true},
    GraphKind{"mesh", Shape::mesh},
    GraphKind{"one_sign_or_zero", Shape::mesh, Weights::one_sign},
    GraphKind{"scattered_lengths", Shape::mesh, Weights::scattered},
    GraphKind{"terminals_anywhere", Shape::mesh, Weights::real, Terminals::anywhere, true},
    GraphKind{"terminals_anywhere_with_ties", Shape::mesh, Weights::integer, Terminals::anywhere, true},
    GraphKind{"hardly_reachable", Shape::sparse_mesh},
    GraphKind{"parallel_arcs", Shape::multi_mesh},
    GraphKind{"parallel_arcs_with_ties", Shape::multi_mesh, Weights::integer},
    GraphKind{"islands", Shape::islands},
    GraphKind{"chains", Shape::chains},
    GraphKind{"chains_with_ties", Shape::chains, Weights::integer},
    GraphKind{"single_arcs", Shape::stars},
};

/// A small graph of a kind: few enough paths to walk them all.
mrc::WeightedGraph random_graph(const GraphKind& kind, unsigned seed, bool matched);

}  // namespace mrc_test
