#pragma once

#include "base/progress.h"
#include "geometry/triangle_tree.h"
#include "vcarve/scene.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace vcarve {

/// A ray without the part close to its point.
struct TrimmedRay {
    Eigen::Vector3d begin;
    std::uint32_t view = 0; ///< the view at whose center it ends
};

/// Finds the rays that meet triangles. A balanced binary tree over the pairs of endpoints of the
/// rays. So the rays of a node are inside the convex hull of two boxes: a shaft (Haines and
/// Wallace, "Shaft culling for efficient ray-traced radiosity", 1991). Boxes around whole rays
/// would all overlap at the views.
class RayTree {
  public:
    /// Takes all rays of `scene` that are longer than the margin of their point, and cuts it off.
    /// Margins are in scene units, one per point. Cost: O(n log n) for n rays, in parallel; 60 to
    /// 80 bytes per ray.
    RayTree(const Scene& scene, const std::vector<double>& margins);

    std::size_t size() const { return rays_.size(); }
    const TrimmedRay& operator[](std::size_t ray) const { return rays_[ray]; }
    const Eigen::Vector3d& end_of(std::size_t ray) const { return ends_[rays_[ray].view]; }
    /// Called with the number of a ray. Returns whether to continue.
    using Visitor = std::function<bool(std::size_t)>;
    /// Calls `visit` for each ray that meets one of the triangles, including their edges. Exact for
    /// the given doubles. Ignores triangles with collinear corners. Faster for several adjacent
    /// triangles than for one at a time. Thread-safe.
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

    std::vector<Eigen::Vector3d> ends_; ///< one per view
    std::vector<TrimmedRay> rays_;
    std::vector<Shaft> nodes_; ///< children of i: 2 i + 1 (first half) and 2 i + 2
};

class HalfEdgeMesh;

/// Prevents changes of a surface from occluding observed points. A ray is *free* if no face meets
/// it, except close to its point. If the point is a vertex, the ray is ignored up to the vertex
/// spacing (the median length of its edges), because the surface may move within it. Otherwise the
/// whole ray counts. If no new face blocks a free ray, all stay free.
class RayGuard {
  public:
    /// Cost: O(rays log rays + faces log faces), in parallel; 60 to 80 bytes per ray, 400 per face.
    RayGuard(const Scene& scene, const HalfEdgeMesh& surface, const Progress& progress = {});

    /// Whether one of the triangles `after` meets a free ray that no triangle `before` meets. Exact
    /// for the given doubles. Thread-safe.
    bool blocks(std::span<const std::array<Eigen::Vector3d, 3>> before,
                std::span<const std::array<Eigen::Vector3d, 3>> after) const;

    std::int64_t num_rays() const { return static_cast<std::int64_t>(rays_.size()); }

  private:
    RayTree rays_;
    std::optional<TriangleTree> faces_; ///< of the surface at first
};

} // namespace vcarve
