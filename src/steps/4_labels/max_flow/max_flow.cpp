#include "steps/4_labels/max_flow/max_flow.h"

#include "base/parallel.h"
#include "steps/4_labels/max_flow/flow_forest.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace vcarve {
namespace {

void check_sizes(const TetMesh& cells, const FlowNetwork& network)
{
    const std::size_t count = cells.cells.size();
    if (cells.mirrors.size() != count || network.residuals.size() != count ||
        network.excesses.size() != count)
        throw std::invalid_argument("minimum_cut: cells, mirrors and network differ in size");
}

/// Makes the node of a cell; `graph` has its residuals.
void make_node(const TetMesh& cells, Index cell, std::int32_t excess, FlowGraph& graph)
{
    graph.nodes[cell] = {.level = 0,
                         .excess = excess,
                         .next = kInfinite,
                         .mirrors = cells.mirrors[cell],
                         .parent = kNoParent,
                         .waits = false,
                         .drains = false};
    for (int slot = 0; slot < 4; ++slot) {
        std::int32_t& residual = graph.residuals[cell][slot];
        if (residual < 0) throw std::invalid_argument("minimum_cut: a residual is negative");
        // An arc back to its own cell is in no cut.
        if (graph.neighbor(cell, slot) == cell) residual = 0;
    }
}

/// Makes all nodes of the graph and fills runs of so many alone.
std::vector<FilledRun> fill_runs(const TetMesh& cells, std::vector<std::int32_t> excesses,
                                 FlowGraph& graph, std::size_t run_size)
{
    const std::size_t count = excesses.size();
    std::vector<FilledRun> runs((count + run_size - 1) / run_size);
    const auto fill = [&](std::size_t run) {
        const auto first = static_cast<Index>(run * run_size);
        const auto last = static_cast<Index>(std::min(count, (run + 1) * run_size));
        for (Index cell = first; cell < last; ++cell)
            make_node(cells, cell, excesses[cell], graph);
        runs[run] = FlowForest(graph, first, last).fill();
    };
    parallel_for(runs.size(), fill, 1);
    return runs;
}

/// Merges so many runs at a time.
std::vector<FilledRun> merge_runs(std::span<const FilledRun> runs, FlowGraph& graph,
                                  std::size_t at_a_time)
{
    std::vector<FilledRun> merged((runs.size() + at_a_time - 1) / at_a_time);
    const auto merge = [&](std::size_t i) {
        const std::size_t begin = i * at_a_time;
        const auto parts = runs.subspan(begin, std::min(at_a_time, runs.size() - begin));
        merged[i] = FlowForest(graph, parts.front().first, parts.back().last).merge(parts);
    };
    parallel_for(merged.size(), merge, 1);
    return merged;
}

} // namespace

struct MinimumCut::Solver {
    Solver(const std::vector<Cell>& cells, std::vector<std::array<std::int32_t, 4>> residuals)
        : graph{cells, std::move(residuals),
                std::make_unique_for_overwrite<FlowNode[]>(cells.size())},
          forest(graph, 0, static_cast<Index>(cells.size()))
    {
    }

    FlowGraph graph;
    FlowForest forest;
};

MinimumCut::MinimumCut(const TetMesh& cells, FlowNetwork network, const FlowRuns& runs)
{
    check_sizes(cells, network);
    if (runs.cells == 0 || runs.merged < 2)
        throw std::invalid_argument("minimum_cut: the runs are too small");
    solver_ = std::make_unique<Solver>(cells.cells, std::move(network.residuals));
    FlowGraph& graph = solver_->graph;
    std::vector<FilledRun> filled =
        fill_runs(cells, std::move(network.excesses), graph, runs.cells);
    while (filled.size() > runs.merged)
        filled = merge_runs(filled, graph, runs.merged);
    solver_->forest.merge(filled);
}

MinimumCut::~MinimumCut() = default;

void MinimumCut::offer(std::span<const Index> cells, std::int32_t flow)
{
    for (const Index cell : cells)
        solver_->forest.offer(cell, flow);
    solver_->forest.settle();
}

Labels MinimumCut::labels() const
{
    const FlowGraph& graph = solver_->graph;
    Labels labels(graph.cells.size());
    parallel_for(labels.size(), [&](std::size_t cell) {
        labels[cell] = graph.nodes[cell].level > 0 ? Label::inside : Label::outside;
    });
    return labels;
}

Labels minimum_cut(const TetMesh& cells, FlowNetwork network, const FlowRuns& runs)
{
    return MinimumCut(cells, std::move(network), runs).labels();
}

} // namespace vcarve
