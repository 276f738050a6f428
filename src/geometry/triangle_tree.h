#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace vcarve {

/// Says which of some triangles a segment meets, exact. Those without area are met by none. Cost:
/// O(n log n) to build, O(log n) a question as a rule, and as much for each that is met. Questions
/// from any thread.
class TriangleTree {
  public:
    explicit TriangleTree(std::span<const std::array<Eigen::Vector3d, 3>> triangles);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) = delete;
    TriangleTree& operator=(TriangleTree&&) = delete;

    /// Whether any is met.
    bool is_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
    /// Called with the place of a triangle among all.
    using Visitor = std::function<void(std::size_t)>;
    /// Shows `visit` each that is met, in any order.
    void visit_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   const Visitor& visit) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_; ///< null where there is no triangle
};

} // namespace vcarve
