#pragma once

#include "compare/reference.h"

#include <array>
#include <optional>

namespace vcarve {

/// The tolerances of precision and recall, as fractions of the truth's diagonal.
inline constexpr std::array<double, 4> kTolerances = {0.001, 0.0025, 0.005, 0.01};

/// Precision and recall within one tolerance.
struct Agreement {
    double tolerance = 0.0; ///< fraction of the truth's diagonal
    double precision = 0.0; ///< fraction of the mesh's samples (whole area) within it of the truth
    double recall = 0.0;    ///< fraction of the truth's samples within it of the mesh
    double f_score = 0.0;   ///< harmonic mean of both; 0 if both are 0
};

/// Fractions of the rays from views through samples of the truth, and beyond. Each sample has one
/// ray, from a random view that sees it in its image. The other rays first hit a front elsewhere.
struct LineFigures {
    double seen_right = 0.0; ///< first hit a front, at most 0.5 % of the diagonal before or behind
                             ///< the sample
    double torn = 0.0;       ///< first hit a back
    double open = 0.0;       ///< miss the mesh
};

/// Angles between the normals of the mesh and of the nearest face of the truth, in degrees from 0
/// to 90, regardless of orientation. Only samples of the mesh at most 1 % of the diagonal from the
/// truth count, because other samples have no corresponding face of the truth.
struct NormalFigures {
    double median_deg = 0.0;
    double most_deg = 0.0; ///< 90th percentile
};

/// Compares a mesh with the truth.
struct TruthFigures {
    std::array<Agreement, kTolerances.size()> agreements;
    double mean_accuracy = 0.0; ///< mean distance of the mesh's samples to the truth, in diagonals
    double mean_completeness =
        0.0; ///< mean distance of the truth's samples to the mesh, in diagonals
    /// Fraction of the truth's samples whose line to a random view that sees them hits the mesh
    /// farther than 1 % of the diagonal from the sample.
    double blocked = 0.0;
    std::optional<LineFigures> lines;          ///< if a view sees a sample in its image
    std::optional<NormalFigures> normals = {}; ///< if a sample of the mesh is near the truth
};

/// Samples the truth until at least options.samples of its samples count. Called by
/// make_reference(), and throws like it. Precondition: only the reference's truth is missing.
Truth seen_truth(const NamedMesh& named, const Reference& reference);

/// Precondition: the reference has a truth. Cost: two nearest-point queries, a segment query and a
/// ray per sample, parallel.
TruthFigures measure_against_truth(const MeasuredMesh& mesh, const Reference& reference);

} // namespace vcarve
