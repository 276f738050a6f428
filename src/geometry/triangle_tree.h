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

/// Where a ray first meets a surface.
struct FirstHit {
    double along = 0.0; ///< the way there in lengths of the ray's `from` to `towards`
    bool front = false; ///< from the side its face's normal looks to
};

/// Where a surface is nearest to a point.
struct NearestFace {
    double distance = 0.0;
    Eigen::Vector3d normal; ///< of the face, unit
};

/// Triangles made ready for four questions: which does a segment meet, where does a ray first meet
/// one, how far are they, and which is nearest. All may be asked from any number of threads.
/// Whether a triangle is met, its border included, is exact, so that nothing slips through an edge
/// or a vertex; distances are in doubles. Triangles without area, or not finite, are left out.
/// CGAL's tree of boxes; cost: O(n log n) to build, O(log n) a question as a rule, and as much for
/// each triangle that is shown; about 400 bytes a triangle.
class TriangleTree {
  public:
    explicit TriangleTree(std::span<const std::array<Eigen::Vector3d, 3>> triangles);
    /// The faces of a mesh, in the frame of its positions: its offset plays no part, so one far
    /// from zero should be centred first.
    explicit TriangleTree(const TriMesh& mesh);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;

    /// Whether no triangle has an area.
    bool is_empty() const;

    /// Whether the closed segment meets any, from whichever side. Precondition: `from` != `to`.
    bool is_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
    /// Called with the place of a triangle among all.
    using Visitor = std::function<void(std::size_t)>;
    /// Shows `visit` each that the closed segment meets, in any order.
    void visit_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   const Visitor& visit) const;
    /// Where the ray from `from` through `towards` and beyond first meets one; nothing where it
    /// does not. A triangle it runs along counts only by its neighbours. Of two equally far, the
    /// front. Precondition: `from` != `towards`.
    std::optional<FirstHit> first_hit(const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& towards) const;

    /// From a point to the nearest point of any. Precondition: not empty.
    double distance(const Eigen::Vector3d& point) const;
    /// The same, with the face that is nearest; of several equally near, any one.
    NearestFace nearest(const Eigen::Vector3d& point) const;

  private:
    struct Tree;
    std::unique_ptr<const Tree> tree_;
};

} // namespace vcarve
