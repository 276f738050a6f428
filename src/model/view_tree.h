#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

namespace vcarve {

/// Of the views that have a place in their image, and stand before the surface there, so many are
/// asked at most whether they see it: what hides it from these mostly hides it from all.
inline constexpr std::size_t kMostAsked = 32;

/// Boxes around the centers of views, one within the other, each with a cone around what its views
/// show, so that the views that may see a place are found from the nearest on without a look at all
/// others.
class ViewTree {
  public:
    /// Cost: O(views log views), some 100 bytes a view.
    explicit ViewTree(const Scene& scene);

    /// Whether ask(view) says yes for some view; the views are asked from the nearest to a place
    /// on, and of those equally near the first. Left out are some that do not have the place in
    /// their image or stand behind a plane through it with such a normal; none do if that is zero.
    /// Views whose center is not finite are not asked. Safe from many threads; ask() must not ask
    /// in turn. Cost: O(log views) for each that is asked, where most others are left out.
    template <typename Ask>
    bool any_from_nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                          const Ask& ask) const;

  private:
    struct Node {
        Eigen::Vector3d middle;
        Eigen::Vector3d half; ///< of the box's sides
        std::uint32_t first;  ///< of its views, in `order_`
        std::uint32_t last;
        std::uint32_t right;  ///< its second half; the first half follows it. 0 where it has none
        Eigen::Vector3d axis; ///< of a cone, of unit length
        double cosine;        ///< of how far off it lies what its views show, at most
        double sine;
    };

    /// A node, or behind all of these a view, and how far it is from a place at least.
    struct Near {
        double distance;
        std::size_t number;

        bool operator>(const Near& other) const
        {
            return std::tie(distance, number) > std::tie(other.distance, other.number);
        }
    };

    /// How far off its axis each view shows things at most.
    static std::vector<double> angles_of(const Scene& scene);

    void add_node(const Scene& scene, const std::vector<double>& angles, std::uint32_t first,
                  std::uint32_t last);

    /// Whether no view of a node shows a place.
    static bool is_out_of_sight(const Node& node, const Eigen::Vector3d& place);
    /// Whether all views of a node stand behind a plane.
    static bool is_behind(const Node& node, const Eigen::Vector3d& place,
                          const Eigen::Vector3d& normal);

    /// Puts a node into the queue, unless it may be left out.
    void add(std::size_t number, const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
             std::vector<Near>& queue) const;
    /// Puts what is in a node into the queue.
    void add_parts(std::size_t number, const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                   std::vector<Near>& queue) const;

    std::vector<Eigen::Vector3d> centers_; ///< of all views
    std::vector<std::uint32_t> order_;     ///< the views, those of a box next to each other
    std::vector<Node> nodes_;
};

template <typename Ask>
bool ViewTree::any_from_nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                                const Ask& ask) const
{
    thread_local std::vector<Near> queue; // a heap, the nearest on top
    queue.clear();
    if (!nodes_.empty()) add(0, place, normal, queue);
    while (!queue.empty()) {
        std::ranges::pop_heap(queue, std::greater<>());
        const std::size_t number = queue.back().number;
        queue.pop_back();
        if (number < nodes_.size()) {
            add_parts(number, place, normal, queue);
        } else if (ask(static_cast<std::uint32_t>(number - nodes_.size()))) {
            return true;
        }
    }
    return false;
}

} // namespace vcarve
