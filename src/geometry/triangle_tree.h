#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <span>

namespace vcarve {

/// Says whether a segment meets one of some triangles, exact. Those without area are met by none.
/// Cost: O(n log n) to build, O(log n) a question as a rule. Questions from any thread.
class TriangleTree {
  public:
    explicit TriangleTree(std::span<const std::array<Eigen::Vector3d, 3>> triangles);
    ~TriangleTree();
    TriangleTree(TriangleTree&&) = delete;
    TriangleTree& operator=(TriangleTree&&) = delete;

    bool is_met(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_; ///< null where there is no triangle
};

} // namespace vcarve
