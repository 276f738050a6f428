#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace vcarve {

/// The first hit of a ray on a surface.
struct FirstHit {
    double along = 0.0; ///< distance, in units of the length from `from` to `towards`
    bool front = false; ///< whether the ray hits the side that the normal points to
};

/// The face nearest to a point.
struct NearestFace {
    double distance = 0.0;
    Eigen::Vector3d normal; ///< of the face, unit
};

/// A search structure for triangles: intersections with segments, first hits of rays, distances,
/// and nearest faces. All queries are thread-safe. Intersection tests are exact and include the
/// boundary, so no ray slips through an edge or a vertex. Distances are rounded. Triangles that are
/// degenerate or not finite are ignored. Uses CGAL's AABB tree. Cost: O(n log n) to build. Queries
/// usually take O(log n), and as much per visited triangle. Memory: about 400 bytes per triangle.
class TriangleTree {
  public:
    explicit TriangleTree(std::span<const std::array<Eigen::Vector3d, 3>> triangles);
    /// Uses the faces of a mesh in the frame of its positions; the offset is ignored. Center a mesh
    /// that is far from zero first.
    explicit TriangleTree(const TriMesh& mesh);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;

    /// Whether all triangles are degenerate.
    bool is_empty() const;

    /// Whether the closed segment meets a triangle, from either side. Precondition: `from` != `to`.
    bool is_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
    /// Receives the index of a triangle in the input.
    using Visitor = std::function<void(std::size_t)>;
    /// Calls `visit` for each triangle that the closed segment meets, in any order.
    void visit_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   const Visitor& visit) const;
    /// The first hit of the ray from `from` through `towards` and beyond, if any. Triangles whose
    /// plane contains the ray are ignored. A front side wins a tie. Precondition: `from` !=
    /// `towards`.
    std::optional<FirstHit> first_hit(const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& towards) const;

    /// The distance from a point to the nearest triangle. Precondition: not empty.
    double distance(const Eigen::Vector3d& point) const;
    /// The nearest face and its distance. Ties are broken arbitrarily. Precondition: not empty.
    NearestFace nearest(const Eigen::Vector3d& point) const;

  private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace vcarve
