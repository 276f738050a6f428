#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace vcarve {

inline constexpr std::uint8_t kNoParent = 4; ///< of roots and orphans
inline constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

/// The solver's state of a cell, beside the residual capacities of its arcs.
struct FlowNode {
    std::int32_t level;  ///< 1 for roots, 0 for cells outside the forest
    std::int32_t excess; ///< negative: a deficit
    Index next;          ///< in a bucket
    std::uint8_t mirrors;
    std::uint8_t parent; ///< slot towards the parent
    bool waits;          ///< is in the front
    bool is_active;      ///< is in the bucket of cells to augment
};
static_assert(sizeof(FlowNode) == 16);
static_assert(std::is_trivially_default_constructible_v<FlowNode>); // allocation touches no page

/// A flow network while it is solved.
struct FlowGraph {
    const UnsetArray<Cell>& cells;
    ArcCapacities arc_capacities; ///< residual
    UnsetArray<FlowNode> nodes;

    Index neighbor(Index cell, int slot) const { return cells[cell].neighbors[slot]; }
    int mirror(Index cell, int slot) const { return (nodes[cell].mirrors >> (2 * slot)) & 3; }

    /// Of the arc that leaves `cell` by `slot`. Below 2^32: it and its reverse start below 2^31.
    std::uint32_t capacity_out(Index cell, int slot) const
    {
        return static_cast<std::uint32_t>(arc_capacities[cell][slot]);
    }

    /// Of the arc that enters `cell` by `slot`.
    std::uint32_t capacity_in(Index cell, int slot) const
    {
        return capacity_out(neighbor(cell, slot), mirror(cell, slot));
    }

    /// The excess that a cell of the forest can receive: a root its deficit, others up to kMost.
    std::uint32_t room(Index cell) const
    {
        const auto excess = static_cast<std::uint32_t>(nodes[cell].excess);
        return (nodes[cell].level == 1 ? 0U : static_cast<std::uint32_t>(kMost)) - excess;
    }

    /// Moves excess through the arc that leaves `cell` by `slot`.
    void push(Index cell, int slot, std::uint32_t amount)
    {
        const Index beyond = neighbor(cell, slot);
        std::int32_t& forward = arc_capacities[cell][slot];
        std::int32_t& reverse = arc_capacities[beyond][mirror(cell, slot)];
        forward = static_cast<std::int32_t>(static_cast<std::uint32_t>(forward) - amount);
        reverse = static_cast<std::int32_t>(static_cast<std::uint32_t>(reverse) + amount);
        nodes[cell].excess -= static_cast<std::int32_t>(amount);
        nodes[beyond].excess += static_cast<std::int32_t>(amount);
    }
};

/// Buckets of cells by level. A cell can be in one bucket at a time.
class LevelBuckets {
  public:
    explicit LevelBuckets(FlowNode* nodes) : nodes_(nodes) {}

    void add(Index cell, std::int32_t level)
    {
        const auto bucket = static_cast<std::size_t>(level);
        if (firsts_.size() <= bucket) firsts_.resize(2 * bucket + 1, kInfinite);
        nodes_[cell].next = std::exchange(firsts_[bucket], cell);
        lowest_ = std::min(lowest_, level);
        highest_ = std::max(highest_, level);
    }

    /// The lowest level with cells; kMost if there is none.
    std::int32_t lowest()
    {
        while (lowest_ <= highest_ && first(lowest_) == kInfinite)
            ++lowest_;
        if (lowest_ > highest_) reset();
        return lowest_;
    }

    /// The highest level with cells; 0 if there is none.
    std::int32_t highest()
    {
        while (lowest_ <= highest_ && first(highest_) == kInfinite)
            --highest_;
        if (lowest_ > highest_) reset();
        return highest_;
    }

    Index take(std::int32_t level)
    {
        const Index cell = first(level);
        first(level) = nodes_[cell].next;
        return cell;
    }

  private:
    Index& first(std::int32_t level) { return firsts_[static_cast<std::size_t>(level)]; }

    void reset()
    {
        lowest_ = kMost;
        highest_ = 0;
    }

    FlowNode* nodes_;
    std::vector<Index> firsts_;
    std::int32_t lowest_ = kMost;
    std::int32_t highest_ = 0;
};

} // namespace vcarve
