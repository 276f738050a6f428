#pragma once

#include "steps/5_labels/max_flow/flow_graph.h"

#include <cstddef>
#include <span>
#include <vector>

namespace vcarve {

/// The cells [first, last) after all excess was pushed to the deficits that it can reach in them.
struct FilledBlock {
    Index first;
    Index last;
    std::int32_t deepest;      ///< upper bound of the levels
    std::vector<Index> border; ///< cells with a neighbor in another block
};

/// The forest of shortest paths to the deficits in the block of cells [first, last);
/// flow_forest.cpp explains it. It neither reads nor writes nodes or arcs outside the block.
class FlowForest {
  public:
    FlowForest(FlowGraph& graph, Index first, Index last)
        : graph_(graph), nodes_(graph.nodes.data()), first_(first), count_(last - first)
    {
    }

    /// Pushes all excess to the deficits it can reach in the block. Precondition: all levels are 0.
    FilledBlock fill();

    /// The same for the concatenation of filled blocks, at a cost that depends on the changes.
    FilledBlock merge(std::span<const FilledBlock> parts);

  private:
    std::int32_t level(Index cell) const;
    Index if_here(Index cell, Index other) const;
    void join(Index cell, int parent, std::int32_t level);
    void list_to_augment(Index cell);

    void adopt_or_detach(Index cell);
    bool adopt(Index cell);
    void seek_parent(Index cell);
    void reattach();
    void reach_from(Index cell);
    void repair();

    void augment(Index cell);
    void augment_all();

    bool activate(Index cell);
    void grow_from(Index cell);
    void fetch_ahead(std::size_t at) const;
    void grow();

    bool leaves(Index cell) const;
    bool lowers(Index cell) const;
    void list_to_visit_around(Index cell);

    FlowGraph& graph_;
    FlowNode* nodes_;
    Index first_;
    Index count_;
    /// Deepest level grown so far. While blocks are merged, parts of their forests are deeper.
    std::int32_t depth_ = 1;
    std::vector<Index> front_;     ///< all cells that joined at that level; some have left it
    std::vector<Index> growing_;   ///< the front of the level above, and its visits
    LevelBuckets orphans_{nodes_}; ///< by level; detached cells by their new level
    LevelBuckets active_{nodes_};  ///< cells of the forest with excess
    std::vector<Index> late_;      ///< cells whose parent had no room for all their excess
    std::vector<Index> detached_;
    std::vector<Index> wave_; ///< cells reattached at one level, and at the next
    std::vector<Index> next_wave_;
    /// While blocks are merged: by level, cells that may lower the level of a neighbor.
    std::vector<std::vector<Index>> visits_;
};

} // namespace vcarve
