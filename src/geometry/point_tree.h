#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <vector>

namespace vcarve {

/// An axis-aligned box.
struct Box {
    Eigen::Vector3d low;
    Eigen::Vector3d high;
};

/// The distance between two boxes; 0 if they touch.
inline double distance_between(const Box& a, const Box& b)
{
    const Eigen::Vector3d gap =
        (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(Eigen::Vector3d::Zero());
    return gap.norm();
}

/// A range of points, [first, last).
struct PointRun {
    std::size_t first;
    std::size_t last;

    bool contains(std::size_t point) const { return first <= point && point < last; }
    std::size_t size() const { return last - first; }
};

/// A tree of boxes over spatially sorted points, with 16 points per leaf and 8 children per node.
/// Keeps a reference to the points. Memory: 4 bytes per point. Cost: O(points).
class PointTree {
  public:
    static constexpr std::size_t kLeaf = 16;

    explicit PointTree(const std::vector<Eigen::Vector3d>& points);

    const std::vector<Eigen::Vector3d>& points() const { return points_; }
    /// The bounding box of all points.
    const Box& box() const { return levels_.back().front(); }

    /// Calls visit_point(i) for points outside `own`. Boxes with the least bound(box) come first.
    /// Boxes with a bound above `limit` are skipped; visit_point may lower `limit`.
    template <typename Bound, typename VisitPoint>
    void visit_excluding(const PointRun& own, const double& limit, const Bound& bound,
                         const VisitPoint& visit_point) const
    {
        const std::size_t top = levels_.size() - 1;
        if (bound(levels_[top][0]) > limit) return;
        descend(top, 0, Search<Bound, VisitPoint>{own, limit, bound, visit_point});
    }

    /// Calls visit_point(i) for all points outside `own` within the distance `limit` of `place`,
    /// and for some farther points. visit_point may lower `limit`.
    template <typename VisitPoint>
    void visit_near(const Eigen::Vector3d& place, const PointRun& own, const double& limit,
                    const VisitPoint& visit_point) const
    {
        const Box here{place, place};
        visit_excluding(
            own, limit, [&](const Box& box) { return distance_between(here, box); }, visit_point);
    }

    /// A point and its distance.
    struct Near {
        double distance;
        std::size_t point;

        // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a 0 in the default
        auto operator<=>(const Near&) const = default;
    };

    /// Fills `nearest` with the `count` points nearest to `place`, or all if there are fewer, in
    /// ascending distance. Ties go to the lower index. Thread-safe. Cost: O(log points + count) if
    /// the points are in a spatial order.
    void find_nearest(const Eigen::Vector3d& place, std::size_t count,
                      std::vector<Near>& nearest) const;

    /// For each leaf with points of `own`, the distance from its box to the nearest point outside
    /// `own`; infinite if there are no other points.
    std::vector<double> distances_to_others(const PointRun& own) const;

  private:
    static constexpr std::size_t kFanout = 8;

    /// A child node and its bound.
    struct Child {
        double bound;
        std::size_t node;
    };

    /// The arguments of visit_excluding().
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
        std::array<Child, kFanout> children; // children within the limit, ascending
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
    std::vector<std::vector<Box>> levels_; ///< from the leaves up to the root
};

} // namespace vcarve
