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
#include <stdexcept>
#include <vector>

namespace vcarve {

inline constexpr std::size_t kSumsOfRun = 8; ///< cells per run

/// The sums of all cells, without runs of zeros. Rays to a subset of the points leave many such
/// runs: cells are in the order of the points, and most rays end near their points.
template <typename T>
struct SparseSums {
    std::uint64_t count = 0;         ///< number of all cells
    std::vector<std::uint32_t> runs; ///< runs with a nonzero sum, ascending
    UnsetArray<T> values;            ///< the sums of these runs, concatenated
};

/// Drops runs of zeros. Cost: O(cells), and memory for the other runs.
template <typename Sums, typename T = typename Sums::value_type>
SparseSums<T> sparse_sums(const Sums& sums)
{
    const auto end_of = [&](std::size_t run) {
        return std::min(sums.size(), (run + 1) * kSumsOfRun);
    };
    SparseSums<T> sparse;
    sparse.count = sums.size();
    const std::size_t num_runs = (sums.size() + kSumsOfRun - 1) / kSumsOfRun;
    sparse.runs = parallel_collect<std::uint32_t>(
        num_runs,
        [&](std::size_t run, auto& used) {
            const auto begin = sums.begin();
            const bool is_zero = std::all_of(begin + static_cast<std::ptrdiff_t>(run * kSumsOfRun),
                                             begin + static_cast<std::ptrdiff_t>(end_of(run)),
                                             [](const T& sum) { return sum == T{}; });
            if (!is_zero) used.push_back(static_cast<std::uint32_t>(run));
        },
        8192);
    if (sparse.runs.empty()) return sparse;
    const std::size_t last = sparse.runs.back();
    sparse.values =
        UnsetArray<T>((sparse.runs.size() - 1) * kSumsOfRun + end_of(last) - last * kSumsOfRun);
    parallel_for(
        sparse.runs.size(),
        [&](std::size_t k) {
            const std::size_t run = sparse.runs[k];
            std::copy(sums.begin() + static_cast<std::ptrdiff_t>(run * kSumsOfRun),
                      sums.begin() + static_cast<std::ptrdiff_t>(end_of(run)),
                      sparse.values.begin() + static_cast<std::ptrdiff_t>(k * kSumsOfRun));
        },
        2048);
    return sparse;
}

/// Calls add(sum, value) for each stored value and its sum in `sums`, from several threads.
/// Throws std::logic_error if the numbers of cells differ.
template <typename T, typename Sums, typename Add>
void add_sparse(const SparseSums<T>& sparse, Sums& sums, const Add& add)
{
    if (sparse.count != sums.size()) throw std::logic_error("add_sparse: the sums differ in size");
    parallel_for(
        sparse.runs.size(),
        [&](std::size_t k) {
            const std::size_t first = std::size_t{sparse.runs[k]} * kSumsOfRun;
            const std::size_t end = std::min(sums.size(), first + kSumsOfRun);
            for (std::size_t cell = first; cell < end; ++cell) {
                add(sums[cell], sparse.values[k * kSumsOfRun + cell - first]);
            }
        },
        2048);
}

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

    /// Adds two clamped sums of a cell's arcs and clamps the result.
    static void add_full_arcs(std::array<std::int32_t, 4>& sums,
                              const std::array<std::int32_t, 4>& others)
    {
        for (std::size_t slot = 0; slot < 4; ++slot) {
            sums[slot] = std::min(sums[slot] + others[slot], kMaxSum);
        }
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
