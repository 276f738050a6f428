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

/// The maximum number of views to test for occlusion of a position, among views that image it from
/// the front. If all of these are occluded, the others mostly are, too.
inline constexpr std::size_t kMostAsked = 32;

/// A tree of boxes around camera centers. Each box has a cone that contains the fields of view of
/// its views. So views that may see a position are found in ascending distance, without visiting
/// all views.
class ViewTree {
  public:
    /// Cost: O(views log views), about 100 bytes per view.
    explicit ViewTree(const Scene& scene);

    /// Whether ask(view) is true for a view. Calls ask() in ascending distance of views from
    /// `place`, by index for ties, until it returns true. May skip views whose image does not
    /// contain `place`, or that are behind the plane through `place` with this normal; a zero
    /// normal disables this test. Skips views without a finite center. Thread-safe, but ask() must
    /// not call this function. Cost: O(log views) per ask(), if most other views are skipped.
    template <typename Ask>
    bool any_from_nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                          const Ask& ask) const;

  private:
    struct Node {
        Eigen::Vector3d middle;
        Eigen::Vector3d half; ///< half the side lengths of the box
        std::uint32_t first;  ///< range of its views in `order_`
        std::uint32_t last;
        std::uint32_t right;  ///< second child, or 0 for a leaf; the first child is the next node
        Eigen::Vector3d axis; ///< of the cone, unit
        double cosine;        ///< of the cone's half angle
        double sine;
    };

    /// A node, or a view (its index plus the number of nodes), and a lower bound of its distance.
    struct Near {
        double distance;
        std::size_t number;

        bool operator>(const Near& other) const
        {
            return std::tie(distance, number) > std::tie(other.distance, other.number);
        }
    };

    /// The largest angle to its axis that each view shows.
    static std::vector<double> angles_of(const Scene& scene);

    void add_node(const Scene& scene, const std::vector<double>& angles, std::uint32_t first,
                  std::uint32_t last);

    /// Whether certainly no view of a node images a position.
    static bool is_out_of_view(const Node& node, const Eigen::Vector3d& place);
    /// Whether certainly all views of a node are behind the plane.
    static bool is_behind(const Node& node, const Eigen::Vector3d& place,
                          const Eigen::Vector3d& normal);

    /// Adds a node to the queue, unless it can be skipped.
    void add(std::size_t number, const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
             std::vector<Near>& queue) const;
    /// Adds the children or views of a node to the queue.
    void add_parts(std::size_t number, const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                   std::vector<Near>& queue) const;

    std::vector<Eigen::Vector3d> centers_; ///< of all views
    std::vector<std::uint32_t> order_;     ///< views with finite centers, grouped by box
    std::vector<Node> nodes_;
};

template <typename Ask>
bool ViewTree::any_from_nearest(const Eigen::Vector3d& place, const Eigen::Vector3d& normal,
                                const Ask& ask) const
{
    thread_local std::vector<Near> queue; // a heap with the nearest on top
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
