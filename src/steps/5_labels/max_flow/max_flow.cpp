#include "steps/5_labels/max_flow/max_flow.h"

#include "base/parallel.h"
#include "steps/5_labels/max_flow/flow_forest.h"

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
    if (cells.mirrors.size() != count || network.arc_capacities.size() != count ||
        network.terminal_capacities.size() != count)
        throw std::invalid_argument("minimum_cut: cells, mirrors and network differ in size");
}

/// Initializes the node of a cell; `graph` has its arcs.
void make_node(const TetMesh& cells, Index cell, std::int32_t excess, FlowGraph& graph)
{
    graph.nodes[cell] = {.level = 0,
                         .excess = excess,
                         .next = kInfinite,
                         .mirrors = cells.mirrors[cell],
                         .parent = kNoParent,
                         .waits = false,
                         .is_active = false};
    for (int slot = 0; slot < 4; ++slot) {
        std::int32_t& capacity = graph.arc_capacities[cell][slot];
        if (capacity < 0) throw std::invalid_argument("minimum_cut: an arc capacity is negative");
        // An arc from a cell to itself is in no cut.
        if (graph.neighbor(cell, slot) == cell) capacity = 0;
    }
}

/// Initializes all nodes of the graph and fills blocks of `block_size` cells separately.
std::vector<FilledBlock> fill_blocks(const TetMesh& cells,
                                     UnsetArray<std::int32_t> terminal_capacities, FlowGraph& graph,
                                     std::size_t block_size, const Progress& progress)
{
    const std::size_t count = terminal_capacities.size();
    std::vector<FilledBlock> blocks((count + block_size - 1) / block_size);
    const auto fill = [&](std::size_t block) {
        const auto first = static_cast<Index>(block * block_size);
        const auto last = static_cast<Index>(std::min(count, (block + 1) * block_size));
        for (Index cell = first; cell < last; ++cell)
            make_node(cells, cell, terminal_capacities[cell], graph);
        blocks[block] = FlowForest(graph, first, last).fill();
    };
    parallel_for(blocks.size(), progress, fill, 1);
    return blocks;
}

/// Merges groups of `at_a_time` consecutive blocks.
std::vector<FilledBlock> merge_blocks(std::span<const FilledBlock> blocks, FlowGraph& graph,
                                      std::size_t at_a_time, const Progress& progress)
{
    std::vector<FilledBlock> merged((blocks.size() + at_a_time - 1) / at_a_time);
    const auto merge = [&](std::size_t i) {
        const std::size_t begin = i * at_a_time;
        const auto parts = blocks.subspan(begin, std::min(at_a_time, blocks.size() - begin));
        merged[i] = FlowForest(graph, parts.front().first, parts.back().last).merge(parts);
    };
    parallel_for(merged.size(), progress, merge, 1);
    return merged;
}

} // namespace

Labels minimum_cut(const TetMesh& cells, FlowNetwork network, const FlowBlocks& blocks,
                   const Progress& progress)
{
    check_sizes(cells, network);
    if (blocks.cells == 0 || blocks.merged < 2)
        throw std::invalid_argument("minimum_cut: the blocks are too small");
    const auto count = static_cast<Index>(cells.cells.size());
    FlowGraph graph{cells.cells, std::move(network.arc_capacities), UnsetArray<FlowNode>(count)};
    std::vector<FilledBlock> filled = fill_blocks(cells, std::move(network.terminal_capacities),
                                                  graph, blocks.cells, progress.part(0.0, 0.7));
    while (filled.size() > blocks.merged)
        filled = merge_blocks(filled, graph, blocks.merged, progress.part(0.7, 0.9));
    FlowForest(graph, 0, count).merge(filled);
    Labels labels(count);
    parallel_for(labels.size(), [&](std::size_t cell) {
        labels[cell] = graph.nodes[cell].level > 0 ? Label::inside : Label::outside;
    });
    return labels;
}

} // namespace vcarve
