#pragma once

#include "model/tet_mesh.h"
#include "steps/4_visibility/scales.h"
#include "steps/4_visibility/trace.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <span>

namespace vcarve {

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
