#pragma once

#include "base/parallel.h"
#include "base/unset_array.h"

#include <algorithm>
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

} // namespace vcarve
