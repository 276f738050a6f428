#pragma once

#include "model/tet_mesh.h"
#include "model/usual_values.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <span>

namespace vcarve {

/// The 25th percentile of the lengths of finite edges, a measure of the spacing of points, in scene
/// units. Meshes beyond 50,000 cells use a fixed sample of about as many edges. Cost: O(cells), in
/// parallel.
double short_edge_length(const TetMesh& mesh);

/// The references of ray weights. They are measured once over the whole model, so that passes that
/// use them are local.
struct Scales {
    double short_edge = 0.0;        ///< see short_edge_length(), in scene units
    double median_error_px = 0.0;   ///< of the known reprojection errors; 0 if none is known
    double median_views = 1.0;      ///< of the points that any view saw; 1 if there are none
    double points_of_witness = 1.0; ///< points that a PointKind::witness represents
};

/// Cost: O(cells + points).
Scales measure_scales(const TetMesh& cells, const Scene& scene, UsualValues* usual = nullptr);

/// Weights rays by their points. More views increase the weight; a larger reprojection error
/// decreases it. A ray to a point that a scanner measured weighs twice as much as one to a point
/// with the median number of views. `scene` and `options` must outlive it. Cost: O(1).
class RayWeights {
  public:
    static constexpr std::int32_t kUnit = 256; ///< steps per ray of full weight

    RayWeights(const Scene& scene, const Scales& scales, const TraceOptions& options);

    /// The weight of `weight` rays to a point, in whole steps.
    std::int32_t full_weight(Index point, double weight = 1.0) const;

  private:
    double by_views(std::span<const std::uint32_t> track) const;
    double by_error(double error_px) const;

    const Scene& scene_;
    const TraceOptions& options_;
    double median_error_px_; ///< 0 if no error is known
    double full_;
};

} // namespace vcarve
