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

inline constexpr std::size_t kSumsOfRun = 8; ///< cells

/// Sums of all cells without the long runs of cells where they are zero, as the sights to a part of
/// the points leave them: cells lie in the order of points, and most sights end near their points.
template <typename T>
struct SparseSums {
    std::uint64_t count = 0;         ///< of all cells
    std::vector<std::uint32_t> runs; ///< those with a sum that is not zero, ascending
    UnsetArray<T> values;            ///< of these runs, one after the other
};

/// Cost: O(cells), and memory for the runs that are not zero.
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

/// Calls add(sum, value) for each sum in `sums` and what is to be added to it, from many threads.
/// Throws std::logic_error where the sums are of another number of cells.
template <typename T, typename Sums, typename Add>
void add_sparse(const SparseSums<T>& sparse, Sums& sums, const Add& add)
{
    if (sparse.count != sums.size()) throw std::logic_error("sums of other cells");
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
