#pragma once

#include "base/arrays.h"
#include "base/parallel.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace vcarve {

/// Adds to the network, from any number of threads. Sums of arcs are clamped to a limit, because no
/// cut crosses a facet that two million rays cross. Their terms are not negative, so the order of
/// addition does not matter. Terms of cells have signs, so their sums must be exact. is_exceeded()
/// returns whether one was too large.
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
    /// The same for a given sum.
    void add_terminal(std::int32_t& sum, std::int32_t flow)
    {
        const std::int32_t before = add(sum, flow);
        if (before > kMaxSum || before < -kMaxSum) {
            is_exceeded_.store(true, std::memory_order_relaxed);
        }
    }
    bool is_exceeded() const { return is_exceeded_; }

    /// Clamps the arc capacities. Call it after the last addition.
    void limit_full_arcs()
    {
        ArcCapacities& arcs = network_.arc_capacities;
        if (!has_full_arcs_) return;
        parallel_for(arcs.size(), [&](std::size_t cell) {
            for (std::int32_t& capacity : arcs[cell])
                capacity = std::min(capacity, kMaxSum);
        });
    }

    /// Prefetches a cell's arcs.
    void fetch(Index cell) const { prefetch(&network_.arc_capacities[cell]); }

  private:
    // A quarter of the range, because the cut adds several sums and the costs of facets.
    static constexpr std::int32_t kMaxSum = 1 << 29;

    /// Returns the sum before the addition.
    static std::int32_t add(std::int32_t& sum, std::int32_t value)
    {
        return std::atomic_ref<std::int32_t>(sum).fetch_add(value, std::memory_order_relaxed);
    }

    FlowNetwork& network_;
    std::atomic<bool> has_full_arcs_ = false;
    std::atomic<bool> is_exceeded_ = false;
};

} // namespace vcarve
