#pragma once

#include "model/tet_mesh.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <span>

namespace vcarve {

/// The 25th percentile of the lengths of finite edges: how far apart neighbouring points are, in
/// the units of the scene. Of meshes beyond 50,000 cells a fixed choice of about as many edges
/// stands for all. Cost: O(cells), in parallel.
double short_edge_length(const TetMesh& mesh);

/// What the weights of sights are relative to. Measured once over the whole model, so that every
/// pass that is handed them is local.
struct Scales {
    double short_edge = 0.0;      ///< see short_edge_length(), in the units of the scene
    double median_error_px = 0.0; ///< of the known reprojection errors; 0 where none is known
    double median_views = 1.0;    ///< of the points that any view saw; 1 where none was
};

/// Cost: O(cells + points).
Scales measure_scales(const TetMesh& cells, const Scene& scene);

/// Says what a sight weighs by the point it leads to: more with more views, less with a larger
/// reprojection error; to a point that a scanner measured, twice as much as to one of the median
/// of views. `scene` and `options` must outlive it. Cost: O(1).
class SightWeights {
  public:
    static constexpr std::int32_t kUnit = 256; ///< steps of one sight of full weight

    SightWeights(const Scene& scene, const Scales& scales, const TraceOptions& options);

    /// `weight` sights to a point, in whole steps.
    std::int32_t full_weight(Index point, double weight = 1.0) const;

  private:
    double by_views(std::span<const std::uint32_t> track) const;
    double by_error(double error_px) const;

    const Scene& scene_;
    const TraceOptions& options_;
    double median_error_px_; ///< 0 where no error is known
    double full_;
};

} // namespace vcarve
