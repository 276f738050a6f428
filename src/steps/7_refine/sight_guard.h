#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace vcarve {

/// A sight without the part next to its point.
struct TrimmedSight {
    Eigen::Vector3d begin;
    std::uint32_t view = 0; ///< whose centre it ends in
};

/// Answers which sights meet triangles. A balanced binary tree over pairs of a sight's two ends,
/// so that a node's sights lie in the convex hull of two boxes: a shaft (Haines and Wallace, "Shaft
/// culling for efficient ray-traced radiosity", 1991). Boxes around whole sights would all overlap
/// where the views are.
class SightTree {
  public:
    /// All sights of `scene` longer than the margin of their point, which is cut off them (lengths
    /// in scene units, one a point). Cost: O(n log n) for n sights, in parallel; 60 to 80 bytes a
    /// sight.
    SightTree(const Scene& scene, const std::vector<double>& margins);

    std::size_t size() const { return sights_.size(); }
    const TrimmedSight& operator[](std::size_t sight) const { return sights_[sight]; }
    /// Called with the number of a sight; tells whether to go on.
    using Visitor = std::function<bool(std::size_t)>;
    /// Shows `visit` every sight that meets one of the triangles, its border included, in exact
    /// arithmetic on the doubles as they are; a triangle whose corners lie on one line meets none.
    /// Faster for triangles next to each other than for one by one. Safe from many threads.
    void visit_meeting(std::span<const std::array<Eigen::Vector3d, 3>> triangles,
                       const Visitor& visit) const;

  private:
    using Box = Eigen::AlignedBox3d;
    struct Shaft {
        Box begins;
        Box ends;
    };
    struct Query;

    void build(std::size_t node, std::size_t first, std::size_t last);
    bool descend(std::size_t node, std::size_t first, std::size_t last, const Query& query) const;

    std::vector<Eigen::Vector3d> ends_; ///< one a view
    std::vector<TrimmedSight> sights_;
    std::vector<Shaft> nodes_; ///< children of i: 2 i + 1 with the first half, 2 i + 2 the rest
};

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
