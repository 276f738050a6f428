#pragma once

#include "base/parallel.h"
#include "base/prefetch.h"
#include "model/flow_network.h"
#include "model/tet_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace vcarve {

/// Adds to the network from many threads. What is added to arcs has no sign, so a sum that goes on
/// from where it is too large stays too large in any order, and can end at a limit: a facet in free
/// space that two million sights cross is as safe from any cut as one that more cross. A sum of a
/// cell's terms has signs and must be exact; it is remembered whether one was too large.
class EnergySums {
  public:
    explicit EnergySums(FlowNetwork& network) : network_(network) {}

    void add_arc_capacity(Index cell, int slot, std::int32_t weight)
    {
        std::int32_t& sum = network_.arc_capacities[cell][slot];
        const std::int32_t before = add(sum, weight);
        if (before + weight <= kMaxSum) return;
        has_full_arcs_.store(true, std::memory_order_relaxed);
        if (before > kMaxSum) add(sum, -weight);
    }
    void add_terminal_capacity(Index cell, std::int32_t flow)
    {
        add_terminal(network_.terminal_capacities[cell], flow);
    }
    /// The same for the sum itself.
    void add_terminal(std::int32_t& sum, std::int32_t flow)
    {
        const std::int32_t before = add(sum, flow);
        if (before > kMaxSum || before < -kMaxSum) {
            is_exceeded_.store(true, std::memory_order_relaxed);
        }
    }
    bool is_exceeded() const { return is_exceeded_; }

    /// To be called when all is added.
    void limit_full_arcs()
    {
        ArcCapacities& arcs = network_.arc_capacities;
        if (!has_full_arcs_) return;
        parallel_for(arcs.size(), [&](std::size_t cell) {
            for (std::int32_t& capacity : arcs[cell])
                capacity = std::min(capacity, kMaxSum);
        });
    }

    /// Adds two sums of a cell's arcs, each made by itself and limited.
    static void add_full_arcs(std::array<std::int32_t, 4>& sums,
                              const std::array<std::int32_t, 4>& others)
    {
        for (std::size_t slot = 0; slot < 4; ++slot) {
            sums[slot] = std::min(sums[slot] + others[slot], kMaxSum);
        }
    }

    /// Asks early for the memory of a cell's arcs.
    void fetch(Index cell) const { prefetch(&network_.arc_capacities[cell]); }

  private:
    // The cut adds a few sums and the costs of facets: a quarter of the range is theirs.
    static constexpr std::int32_t kMaxSum = 1 << 29;

    /// Gives the sum before.
    static std::int32_t add(std::int32_t& sum, std::int32_t value)
    {
        return std::atomic_ref<std::int32_t>(sum).fetch_add(value, std::memory_order_relaxed);
    }

    FlowNetwork& network_;
    std::atomic<bool> has_full_arcs_ = false;
    std::atomic<bool> is_exceeded_ = false;
};

} // namespace vcarve
