#pragma once

#include "geometry/point_tree.h"
#include "steps/2_planes/flat_parts.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The points that a view saw, by where its image shows them: how near two are is the angle between
/// the lines on which the view sees them. Keeps a reference to the scene.
class ShownPoints {
  public:
    /// The points must be some of those that the view saw, at least one, and follow each other in
    /// space as the scene's do, or looking up takes longer. Cost: O(points), and 32 bytes a point.
    ShownPoints(const Scene& scene, std::uint32_t view, std::vector<std::uint32_t> points);
    ShownPoints(const ShownPoints&) = delete; // the tree refers to the ways of this one
    ShownPoints& operator=(const ShownPoints&) = delete;

    /// Whether the view looks at a place in the plane of a flat part before which it stands, as far
    /// as the points tell. The one that it shows nearest to the place must be the part's own. And
    /// so must be, of the nearest 40, the first that it shows onward, within 45 degrees of the way
    /// that leads on along the plane away from the view, unless it is farther from the view than
    /// the place: what stands on a plane hides it from the foot up to the top, and there the
    /// thing's own points show. Cost: O(log points).
    bool looks_at(const Eigen::Vector3d& place, const FlatParts& parts, std::uint32_t part) const;

  private:
    const Scene& scene_;
    const Eigen::Vector3d& center_;
    std::vector<std::uint32_t> points_;
    std::vector<Eigen::Vector3d> ways_; ///< to the points, unit
    PointTree tree_;                    ///< of these
};

} // namespace vcarve
