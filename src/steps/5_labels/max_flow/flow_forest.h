#pragma once

#include "steps/5_labels/max_flow/flow_graph.h"

#include <cstddef>
#include <span>
#include <vector>

namespace vcarve {

/// The cells [first, last) once all excess has been pushed to the deficits that it can reach within
/// them.
struct FilledBlock {
    Index first;
    Index last;
    std::int32_t deepest;      ///< no cell has a higher level
    std::vector<Index> border; ///< cells with a neighbour elsewhere
};

/// The forest of shortest paths to the deficits in the cells [first, last), see flow_forest.cpp. It
/// neither reads nor writes nodes or arcs elsewhere.
class FlowForest {
  public:
    FlowForest(FlowGraph& graph, Index first, Index last)
        : graph_(graph), nodes_(graph.nodes.data()), first_(first), count_(last - first)
    {
    }

    /// Pushes all excess to the deficits it can reach within the block. No cell has a level before.
    FilledBlock fill();

    /// The same for a block made of filled ones, in their order, at the cost of what changes.
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
    /// Deepest level grown so far; while blocks are merged, parts of their forests lie deeper.
    std::int32_t depth_ = 1;
    std::vector<Index> front_;     ///< all cells that joined on that level, and some that were
    std::vector<Index> growing_;   ///< the front of the level above, and the cells to visit there
    LevelBuckets orphans_{nodes_}; ///< by their level; of detached cells, by the one they may get
    LevelBuckets active_{nodes_};  ///< cells of the forest with excess
    std::vector<Index> late_;      ///< cells whose parent had no room left for all their excess
    std::vector<Index> detached_;
    std::vector<Index> wave_; ///< cells reattached on one level, and on the next
    std::vector<Index> next_wave_;
    /// While blocks are merged: by level, cells that may give a lower level to their neighbours.
    std::vector<std::vector<Index>> visits_;
};

} // namespace vcarve
