#pragma once

#include "model/scene_check.h"
#include "vcarve/options.h"

namespace vcarve {

/// How much a run reads, how much of it is left when the points of a cloud are merged, and what is
/// to be done with it.
struct RunSize {
    SceneSize read;
    SceneSize thinned;
    bool in_parts = false; ///< points are merged while they are read, and never all in memory
    Options options = {};
};

/// Counts of a model, as doubles: products of them leave no range.
struct Sizes {
    double points;
    double sights;
    double views;
    double point_bytes; ///< of the scene
    /// Points as they usually are: points at random in space have 6.77 and points near a surface
    /// about 6.
    double cells_of_point = 6.8;

    double cells() const { return cells_of_point * points; }
    double faces() const { return 2.0 * points; } ///< of a closed surface through all points
    double scene() const;                         ///< bytes
    double after_triangulation() const;           ///< bytes of the scene and the cells
};

Sizes sizes_of(const SceneSize& size);

/// What the stages of a run, their memory and their time depend on.
struct Needs {
    const Options& options;
    Sizes read;
    Sizes left; ///< when points are merged
    double threads;
    bool is_dense;
    bool in_parts;
};

/// `size` must outlive it.
Needs needs_of(const RunSize& size, int threads);

// The bytes that arrays hold while a stage runs: those that are alive at once.

double reading(const Needs& n);
double thinning(const Needs& n);
double filtering(const Needs& n);
double finding_planes(const Needs& n);
double denoising(const Needs& n);
double triangulating(const Needs& n);
double tracing(const Needs& n);
double cutting(const Needs& n);
double carving(const Needs& n);
double extracting(const Needs& n);
double cleaning(const Needs& n);
double settling(const Needs& n);

/// CGAL's structure of all cells and points.
double cgal(const Sizes& n);

/// What the sights say that one rank walks.
double sums_of_sights(const Sizes& n);

} // namespace vcarve
