#include "label/max_flow.h"

#include "base/parallel.h"
#include "label/flow_forest.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace vcarve {
namespace {

constexpr Index kRun = 16384; ///< cells solved alone first: about 1 MB

FlowGraph make_graph(const TetMesh& cells, FlowNetwork network)
{
    const std::size_t count = cells.cells.size();
    if (cells.mirrors.size() != count || network.residuals.size() != count ||
        network.excesses.size() != count)
        throw std::invalid_argument("minimum_cut: cells, mirrors and network differ in size");
    FlowGraph graph = {cells.cells, std::move(network.residuals), std::vector<FlowNode>(count)};
    for (Index cell = 0; cell < count; ++cell) {
        graph.nodes[cell].excess = network.excesses[cell];
        graph.nodes[cell].mirrors = cells.mirrors[cell];
        for (int slot = 0; slot < 4; ++slot) {
            std::int32_t& residual = graph.residuals[cell][slot];
            if (residual < 0) throw std::invalid_argument("minimum_cut: a residual is negative");
            // An arc back to its own cell is in no cut.
            if (graph.neighbor(cell, slot) == cell) residual = 0;
        }
    }
    return graph;
}

} // namespace

struct MinimumCut::Solver {
    explicit Solver(FlowGraph network)
        : graph(std::move(network)), forest(graph, 0, static_cast<Index>(graph.nodes.size()))
    {
    }

    FlowGraph graph;
    FlowForest forest;
};

MinimumCut::MinimumCut(const TetMesh& cells, FlowNetwork network)
    : solver_(std::make_unique<Solver>(make_graph(cells, std::move(network))))
{
    FlowGraph& graph = solver_->graph;
    const auto count = static_cast<Index>(graph.nodes.size());
    // Runs of cells alone, then what is left between them.
    const auto fill_run = [&](std::size_t run) {
        const auto first = static_cast<Index>(run * kRun);
        FlowForest(graph, first, first + std::min(kRun, count - first)).fill();
    };
    if (count > kRun) parallel_for((std::size_t(count) + kRun - 1) / kRun, fill_run, 1);
    solver_->forest.fill();
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
    const std::vector<FlowNode>& nodes = solver_->graph.nodes;
    Labels labels(nodes.size());
    std::transform(nodes.begin(), nodes.end(), labels.begin(), [](const FlowNode& node) {
        return node.level > 0 ? Label::inside : Label::outside;
    });
    return labels;
}

Labels minimum_cut(const TetMesh& cells, FlowNetwork network)
{
    return MinimumCut(cells, std::move(network)).labels();
}

} // namespace vcarve
