#pragma once

#include "model/tet_mesh.h"
#include "steps/2_cells/sphere_bound.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace vcarve {

/// A run of points, [first, last).
struct PointRun {
    std::size_t first;
    std::size_t last;

    bool contains(std::size_t point) const { return first <= point && point < last; }
    std::size_t size() const { return last - first; }
};

/// Boxes around runs of points that follow each other in space: leaves of 16 points, and boxes of 8
/// of the level below. Keeps a reference to the points. Memory: 4 bytes a point; cost: O(points).
class PointTree {
  public:
    static constexpr std::size_t kLeaf = 16;

    explicit PointTree(const std::vector<Eigen::Vector3d>& points);

    const std::vector<Eigen::Vector3d>& points() const { return points_; }

    /// Shows visit(box) boxes from the top down, those only whose points are not all in `own`. It
    /// returns whether it wants what is in there; at last visit_point(i) is shown points that are
    /// not in `own`.
    template <typename VisitBox, typename VisitPoint>
    void visit_foreign(const PointRun& own, const VisitBox& visit,
                       const VisitPoint& visit_point) const
    {
        descend(levels_.size() - 1, 0, own, visit, visit_point);
    }

    /// Of each leaf with points of `own` the distance from its box to the nearest point that is not
    /// in `own`; infinite where there is none.
    std::vector<double> distances_to_foreign(const PointRun& own) const;

  private:
    static constexpr std::size_t kFanout = 8;

    template <typename VisitBox, typename VisitPoint>
    void descend(std::size_t level, std::size_t node, const PointRun& own, const VisitBox& visit,
                 const VisitPoint& visit_point) const
    {
        const PointRun run = run_of(level, node);
        if (own.first <= run.first && run.last <= own.last) return;
        if (!visit(levels_[level][node])) return;
        if (level == 0) {
            for (std::size_t i = run.first; i < run.last; ++i) {
                if (!own.contains(i)) visit_point(i);
            }
            return;
        }
        const std::size_t last = std::min(levels_[level - 1].size(), (node + 1) * kFanout);
        for (std::size_t child = node * kFanout; child < last; ++child)
            descend(level - 1, child, own, visit, visit_point);
    }

    PointRun run_of(std::size_t level, std::size_t node) const
    {
        const std::size_t size = kLeaf << (3 * level);
        return {node * size, std::min(points_.size(), (node + 1) * size)};
    }

    const std::vector<Eigen::Vector3d>& points_;
    std::vector<std::vector<Box>> levels_; ///< the leaves first, one box in the last
};

} // namespace vcarve
