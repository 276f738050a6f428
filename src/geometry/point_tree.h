#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <vector>

namespace vcarve {

/// A box along the axes.
struct Box {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
};

/// How far apart two boxes are; 0 where they touch.
inline double distance_between(const Box& a, const Box& b)
{
    const Eigen::Vector3d gap =
        (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(Eigen::Vector3d::Zero());
    return gap.norm();
}

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
    /// Around all points.
    const Box& box() const { return levels_.back().front(); }

    /// Shows visit_point(i) points that are not in `own`, those first whose boxes have the least
    /// bound(box), and none in boxes with more than `limit`, which visit_point may lower.
    template <typename Bound, typename VisitPoint>
    void visit_foreign(const PointRun& own, const double& limit, const Bound& bound,
                       const VisitPoint& visit_point) const
    {
        const std::size_t top = levels_.size() - 1;
        if (bound(levels_[top][0]) > limit) return;
        descend(top, 0, Search<Bound, VisitPoint>{own, limit, bound, visit_point});
    }

    /// The same of the distance to a place: shows visit_point(i) all points that are no farther
    /// from it than `limit` and not in `own`, and some that are farther.
    template <typename VisitPoint>
    void visit_near(const Eigen::Vector3d& place, const PointRun& own, const double& limit,
                    const VisitPoint& visit_point) const
    {
        const Box here{place, place};
        visit_foreign(
            own, limit, [&](const Box& box) { return distance_between(here, box); }, visit_point);
    }

    /// A point, and how far it is.
    struct Near {
        double distance;
        std::size_t point;

        // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a 0 in the default
        auto operator<=>(const Near&) const = default;
    };

    /// Fills `nearest` with the `count` points nearest to a place, or all if there are fewer, the
    /// nearest first, and of those equally far the first. Safe from many threads. Cost: O(log
    /// points + count) where the points follow each other in space.
    void find_nearest(const Eigen::Vector3d& place, std::size_t count,
                      std::vector<Near>& nearest) const;

    /// Of each leaf with points of `own` the distance from its box to the nearest point that is not
    /// in `own`; infinite where there is none.
    std::vector<double> distances_to_foreign(const PointRun& own) const;

  private:
    static constexpr std::size_t kFanout = 8;

    /// A box amid those of its siblings.
    struct Child {
        double bound;
        std::size_t node;
    };

    /// What visit_foreign() was told.
    template <typename Bound, typename VisitPoint>
    struct Search {
        const PointRun& own;
        const double& limit;
        const Bound& bound;
        const VisitPoint& visit_point;
    };

    template <typename Bound, typename VisitPoint>
    void descend(std::size_t level, std::size_t node, const Search<Bound, VisitPoint>& search) const
    {
        const PointRun run = run_of(level, node);
        if (level == 0) {
            for (std::size_t i = run.first; i < run.last; ++i) {
                if (!search.own.contains(i)) search.visit_point(i);
            }
            return;
        }
        std::array<Child, kFanout> children; // those worth a look, the best first
        std::size_t count = 0;
        const std::size_t last = std::min(levels_[level - 1].size(), (node + 1) * kFanout);
        for (std::size_t child = node * kFanout; child < last; ++child) {
            const PointRun below = run_of(level - 1, child);
            if (search.own.first <= below.first && below.last <= search.own.last) continue;
            const double bound = search.bound(levels_[level - 1][child]);
            if (bound > search.limit) continue;
            std::size_t place = count++;
            for (; place > 0 && children[place - 1].bound > bound; --place)
                children[place] = children[place - 1];
            children[place] = {bound, child};
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (!(children[i].bound > search.limit)) descend(level - 1, children[i].node, search);
        }
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
