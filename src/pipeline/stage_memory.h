#pragma once

#include "model/photograph.h"
#include "model/scene_check.h"
#include "vcarve/options.h"

#include <vector>

namespace vcarve {

/// The size of a run's input, its size after the points of a cloud are merged, and the options.
struct RunSize {
    SceneSize read;
    SceneSize thinned;
    bool in_parts = false; ///< points are merged while they are read, so memory never holds all
    Options options = {};
    bool is_tile = false;                    ///< the scene is a part of a large model (tiles/)
    std::vector<PhotographSize> photos = {}; ///< sizes of the photographs that the run reads
    bool measures_dense = false;             ///< the run makes a sparse surface and depth maps
    bool has_report = false;
};

/// Counts of a model. They are doubles, so that products do not overflow.
struct Sizes {
    double points;
    double rays;
    double views;
    double point_bytes; ///< bytes of the scene per point
    /// The usual number of cells per point: 6.77 for random points in space, about 6 for points
    /// near a surface.
    double cells_of_point = 6.8;

    double cells() const { return cells_of_point * points; }
    double faces() const { return 2.0 * points; } ///< in a closed surface through all points
    double scene() const;                         ///< bytes
    double after_triangulation() const;           ///< bytes of the scene and the cells
};

Sizes sizes_of(const SceneSize& size);

/// The data that determine the stages of a run, their memory and their time.
struct Needs {
    const Options& options;
    Sizes read;
    Sizes left; ///< size after points are merged
    double threads;
    bool is_dense;
    bool in_parts;
    bool is_tile;
    const std::vector<PhotographSize>& photos;
    bool measures_dense;
    bool has_report;
};

/// `size` must outlive the result.
Needs needs_of(const RunSize& size, int threads);

// The maximum bytes of the arrays that are alive at the same time in a stage.

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
double adjusting(const Needs& n);
double measuring_depth(const Needs& n);
double masking(const Needs& n);
double refining(const Needs& n);
double finding_photos(const Needs& n);
double coloring(const Needs& n);
double painting(const Needs& n);
double reporting(const Needs& n);

} // namespace vcarve
