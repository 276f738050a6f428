#pragma once

#include "base/progress.h"
#include "steps/7_refine/sight_tree.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

class HalfEdgeMesh;

/// Keeps changes of a surface from hiding what was seen. A sight is *free* if no face of the
/// surface meets it, the part next to its point aside: a point that is a vertex of the surface
/// gives away its spacing, the median length of the edges there, because the surface may move
/// within it; of a point that is none, the whole sight counts. A change that lets only those new
/// faces in that block no free sight leaves every free sight free.
class SightGuard {
  public:
    /// Finds the free sights. Cost: O(sights log sights + faces x sights near them), in parallel.
    SightGuard(const Scene& scene, const HalfEdgeMesh& surface, const Progress& progress = {});

    /// Whether one of the triangles meets a free sight, its border included; decided exactly. A
    /// triangle without area meets none. Faster for triangles next to each other than for one by
    /// one. Safe from many threads.
    bool blocks(std::span<const std::array<Eigen::Vector3d, 3>> triangles) const;
    bool blocks(const std::array<Eigen::Vector3d, 3>& triangle) const
    {
        return blocks(std::span(&triangle, 1));
    }

    std::int64_t num_sights() const { return static_cast<std::int64_t>(tree_.size()); }
    std::int64_t num_free() const;

  private:
    SightTree tree_;
    std::vector<std::uint8_t> blocked_; ///< one a sight of the tree
};

} // namespace vcarve
