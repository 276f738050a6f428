#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve {

/// Boxes around the centers of views, one within the other, so that what holds for all views in a
/// box, such as that the same facet hides a place from them, is asked once.
class ViewTree {
  public:
    /// Cost: O(views log views), some 100 bytes a view.
    explicit ViewTree(const Scene& scene);

    /// Whether ask(view) says yes for some view from which a place on a facet may be seen: the view
    /// stands before the facet, its image may show the place, and goes_on(ahead) says yes of each
    /// facet that the way to it crosses, the first one included, each given from the cell before
    /// it. The facet is given from the cell behind it, the place lies inside it. Views whose way is
    /// stopped may be asked, too, where rounding could tell. Cost: a step through a cell for each
    /// box that is looked at, some log(views) of them where few facets hide the place.
    template <typename GoesOn, typename Ask>
    bool any_view(const TetMesh& cells, const CellFacet& facet, const Eigen::Vector3d& place,
                  const GoesOn& goes_on, const Ask& ask) const;

  private:
    struct Node {
        Eigen::Vector3d middle;
        Eigen::Vector3d half; ///< of the box's sides
        std::uint32_t first;  ///< of its views, in `order_`
        std::uint32_t last;
        std::uint32_t right;  ///< its second half; the first half follows it. 0 where it has none
        Eigen::Vector3d axis; ///< of a cone; what its views show lies so far off it at most
        double angle;         ///< pi or more where that is not known
    };
    enum class Side { before, behind, unclear };

    /// How far off its axis each view shows things at most.
    static std::vector<double> angles_of(const Scene& scene);

    void add_node(const Scene& scene, const std::vector<double>& angles, std::uint32_t first,
                  std::uint32_t last);

    /// Whether no view of a node shows a place.
    static bool is_out_of_sight(const Node& node, const Eigen::Vector3d& place);

    /// Where a node's views stand beside the plane through a place with such a normal. What is
    /// computed of the normal may be off by a share of `length`.
    static Side side_of(const Node& node, const Eigen::Vector3d& place,
                        const Eigen::Vector3d& normal, double length);

    /// The facet by which all ways from a place to a node's views leave a cell that they entered by
    /// a facet; none where they part, or where some end within the cell.
    static std::optional<CellFacet> exit_of(const TetMesh& cells, const CellFacet& entered,
                                            const Eigen::Vector3d& place, const Node& node);

    static Side side_of_facet(const TetMesh& cells, const CellFacet& facet,
                              const Eigen::Vector3d& place, const Node& node);

    /// What any_view() is given.
    template <typename GoesOn, typename Ask>
    struct Question {
        const TetMesh& cells;
        const CellFacet& facet;
        const Eigen::Vector3d& place;
        const GoesOn& goes_on;
        const Ask& ask;
    };
    template <typename GoesOn, typename Ask>
    bool any_before(const Question<GoesOn, Ask>& question, std::uint32_t number) const;
    template <typename GoesOn, typename Ask>
    bool any_beyond(const Question<GoesOn, Ask>& question, CellFacet entered,
                    std::uint32_t number) const;
    template <typename Ask>
    bool any_of(const Node& node, const Ask& ask) const
    {
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            if (ask(order_[i])) return true;
        }
        return false;
    }

    std::vector<std::uint32_t> order_; ///< the views, those of a box next to each other
    std::vector<Node> nodes_;
};

template <typename GoesOn, typename Ask>
bool ViewTree::any_view(const TetMesh& cells, const CellFacet& facet, const Eigen::Vector3d& place,
                        const GoesOn& goes_on, const Ask& ask) const
{
    const Question<GoesOn, Ask> question = {cells, facet, place, goes_on, ask};
    return !nodes_.empty() && goes_on(facet) && any_before(question, 0);
}

/// Of the views of a node that stand before the facet.
template <typename GoesOn, typename Ask>
bool ViewTree::any_before(const Question<GoesOn, Ask>& question, std::uint32_t number) const
{
    const auto& [cells, facet, place, goes_on, ask] = question;
    const Node& node = nodes_[number];
    if (is_out_of_sight(node, place)) return false;
    const Side side = side_of_facet(cells, facet, place, node);
    if (side == Side::behind) return false;
    if (node.right == 0) return any_of(node, ask);
    if (side == Side::before) return any_beyond(question, cells.other_side(facet), number);
    return any_before(question, number + 1) || any_before(question, node.right);
}

/// Of the views of a node, to all of which the way is free up to the facet by which it entered a
/// cell.
template <typename GoesOn, typename Ask>
bool ViewTree::any_beyond(const Question<GoesOn, Ask>& question, CellFacet entered,
                          std::uint32_t number) const
{
    const auto& [cells, facet, place, goes_on, ask] = question;
    const Node& node = nodes_[number];
    if (is_out_of_sight(node, place)) return false;
    if (node.right == 0) return any_of(node, ask);
    while (const std::optional<CellFacet> ahead = exit_of(cells, entered, place, node)) {
        if (!goes_on(*ahead)) return false;
        entered = cells.other_side(*ahead);
    }
    return any_beyond(question, entered, number + 1) || any_beyond(question, entered, node.right);
}

} // namespace vcarve
