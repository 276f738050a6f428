#pragma once

#include "geometry/triangle_tree.h"
#include "steps/2_planes/flat_parts.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <vector>

namespace vcarve {

/// The flat parts of a scene as what covers what lies behind them, as roofs do the ground, each as
/// large as the convex hull of its points. Keeps a reference. Cost: O(points log points), and 400
/// bytes a corner of a hull.
class Covers {
  public:
    explicit Covers(const FlatParts& parts);

    /// The parts that a ray from a place along a way, a unit vector, meets from behind, from so far
    /// on. Safe from many threads. Cost: O(log parts + parts met).
    std::vector<std::uint32_t> over(const Eigen::Vector3d& place, const Eigen::Vector3d& way,
                                    double from) const;

  private:
    const FlatParts& parts_;
    std::vector<std::uint32_t> owners_; ///< of the triangles
    double reach_ = 0.0;                ///< farther than from any part to another
    std::unique_ptr<TriangleTree> tree_;
};

} // namespace vcarve
