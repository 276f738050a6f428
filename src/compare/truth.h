#pragma once

#include "compare/reference.h"

#include <array>
#include <optional>

namespace vcarve {

/// The tolerances of precision and recall, as shares of the truth's diagonal.
inline constexpr std::array<double, 4> kTolerances = {0.001, 0.0025, 0.005, 0.01};

/// Precision and recall within one tolerance.
struct Agreement {
    double tolerance = 0.0; ///< share of the truth's diagonal
    double precision =
        0.0;              ///< share of the mesh's samples (of its whole area) so near to the truth
    double recall = 0.0;  ///< share of the truth's samples so near to the mesh
    double f_score = 0.0; ///< harmonic mean of the two, 0 where both are 0
};

/// What the views meet of a mesh where they look at the truth: shares of the lines of sight that
/// go from a view through a sample of the truth it sees within its image and on (one a sample,
/// picked at random). What is left of 1 first meets the front of a face elsewhere.
struct LineFigures {
    double seen_right = 0.0; ///< first meets the mesh from its front, at most 0.5 % of the diagonal
                             ///< before or behind the sample
    double torn = 0.0;       ///< first meets the mesh from its back
    double open = 0.0;       ///< does not meet the mesh
};

/// Angles, in degrees from 0 to 90, between the normals of faces of the mesh and of the nearest
/// face of the truth, whichever way these look: over the mesh's samples at most 1 % of the diagonal
/// from the truth, since elsewhere there is no face of the truth that they stand for.
struct NormalFigures {
    double median_deg = 0.0;
    double most_deg = 0.0; ///< 90th percentile
};

/// A mesh against the truth.
struct TruthFigures {
    std::array<Agreement, kTolerances.size()> agreements;
    double mean_accuracy = 0.0; ///< mean distance of the mesh's samples to the truth, in diagonals
    double mean_completeness =
        0.0; ///< mean distance of the truth's samples to the mesh, in diagonals
    /// Share of the truth's samples whose line to a view that sees them (one a sample, picked at
    /// random) meets the mesh farther than 1 % of the diagonal from the sample.
    double blocked = 0.0;
    std::optional<LineFigures> lines;          ///< where some view sees a sample within its image
    std::optional<NormalFigures> normals = {}; ///< where a sample of the mesh is near the truth
};

/// Samples the truth until at least options.samples of its samples count. Throws like
/// make_reference, which is what to call: the reference must be complete but for its truth.
Truth seen_truth(const NamedMesh& named, const Reference& reference);

/// Precondition: the reference has a truth.
/// Cost: two nearest-point queries, a segment query and a ray a sample, parallel.
TruthFigures measure_against_truth(const MeasuredMesh& mesh, const Reference& reference);

} // namespace vcarve
