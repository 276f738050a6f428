#pragma once

#include "label/flow_graph.h"

#include <cstddef>
#include <vector>

namespace vcarve {

/// The forest of shortest paths to the deficits in the cells [first, last), see flow_forest.cpp. It
/// neither reads nor writes nodes or residuals elsewhere.
class FlowForest {
  public:
    FlowForest(FlowGraph& graph, Index first, Index last)
        : graph_(graph), nodes_(graph.nodes), first_(first), count_(last - first)
    {
    }

    /// Takes in all excess that can reach a deficit within the run.
    void fill();

    /// Adds to the excess of a cell of a filled forest; settle() then takes in what can drain.
    void offer(Index cell, std::int32_t flow);
    void settle();

  private:
    std::int32_t level(Index cell) const;
    void join(Index cell, int parent, std::int32_t level);
    void list_to_drain(Index cell);

    void detach_or_rehang(Index cell);
    bool rehang(Index cell);
    void seek_parent(Index cell);
    void reattach();
    void reach_from(Index cell);
    void repair();

    void drain(Index cell);
    void drain_all();

    bool take_in(Index cell);
    void grow_from(Index cell);
    void fetch_ahead(std::size_t at) const;
    void grow();

    FlowGraph& graph_;
    std::vector<FlowNode>& nodes_;
    Index first_;
    Index count_;
    std::int32_t depth_ = 1;       ///< deepest level a cell may have
    std::vector<Index> front_;     ///< all cells on that level, and some that were
    std::vector<Index> growing_;   ///< the front of the level above
    LevelBuckets orphans_{nodes_}; ///< by their level; of detached cells, by the one they may get
    LevelBuckets drains_{nodes_};  ///< cells of the forest with excess
    std::vector<Index> late_;      ///< cells whose parent had no room left for all their excess
    std::vector<Index> detached_;
    std::vector<Index> offered_; ///< cells that got more excess, not yet settled
    std::vector<Index> wave_;    ///< cells reattached on one level, and on the next
    std::vector<Index> next_wave_;
};

} // namespace vcarve
