#include "steps/3_cells/triangulate.h"
#include "steps/5_labels/max_flow/max_flow.h"
#include "support/random_cells.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace vcarve::max_flow_test {
namespace {

constexpr Label o = Label::outside;
constexpr Label i = Label::inside;
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

struct Problem {
    TetMesh cells;
    FlowNetwork network;
};

// ---- problems -----------------------------------------------------------------------------------

/// Cells without usable arcs: every cell is its own neighbor.
Problem isolated_cells(UnsetArray<std::int32_t> terminal_capacities)
{
    Problem problem;
    problem.cells.cells.resize(terminal_capacities.size());
    for (Index cell = 0; cell < terminal_capacities.size(); ++cell)
        problem.cells.cells[cell].neighbors = {cell, cell, cell, cell};
    problem.cells.mirrors.assign(terminal_capacities.size(), 0b10'11'00'01);
    problem.network.arc_capacities.assign(terminal_capacities.size(), {0, 0, 0, 0});
    problem.network.terminal_capacities = std::move(terminal_capacities);
    return problem;
}

void set_mirror(TetMesh& cells, Index cell, int slot, int mirror)
{
    const int cleared = cells.mirrors[cell] & ~(3 << (2 * slot));
    cells.mirrors[cell] = static_cast<std::uint8_t>(cleared | mirror << (2 * slot));
}

void connect(TetMesh& cells, std::pair<Index, int> a, std::pair<Index, int> b)
{
    cells.cells[a.first].neighbors[a.second] = b.first;
    cells.cells[b.first].neighbors[b.second] = a.first;
    set_mirror(cells, a.first, a.second, b.second);
    set_mirror(cells, b.first, b.second, a.second);
}

/// Cells in a row, each with an arc to the next by slot 1 and one back by slot 0.
Problem chain(UnsetArray<std::int32_t> terminal_capacities,
              const std::vector<std::int32_t>& forward, const std::vector<std::int32_t>& backward)
{
    Problem problem = isolated_cells(std::move(terminal_capacities));
    for (Index cell = 0; cell + 1 < problem.cells.cells.size(); ++cell) {
        connect(problem.cells, {cell, 1}, {cell + 1, 0});
        problem.network.arc_capacities[cell][1] = forward[cell];
        problem.network.arc_capacities[cell + 1][0] = backward[cell];
    }
    // The unpaired slots of the first and last cell are joined, without capacity.
    connect(problem.cells, {static_cast<Index>(problem.cells.cells.size() - 1), 1}, {0, 0});
    return problem;
}

struct Kind {
    Index cells;
    std::int32_t max_arc_capacity;
    std::int32_t max_excess;
    double arcs;  ///< fraction of nonzero arcs
    double roots; ///< fraction of cells with an excess or a deficit
};

/// Pairs facets at random, sometimes several between two cells, or two of one cell.
Problem random_problem(const Kind& kind, std::mt19937& random)
{
    UnsetArray<std::int32_t> terminal_capacities(kind.cells, 0);
    std::bernoulli_distribution is_root(kind.roots), is_arc(kind.arcs);
    std::uniform_int_distribution<std::int32_t> excess(-kind.max_excess, kind.max_excess);
    std::uniform_int_distribution<std::int32_t> residual(0, kind.max_arc_capacity);
    for (std::int32_t& value : terminal_capacities)
        value = is_root(random) ? excess(random) : 0;
    Problem problem = isolated_cells(std::move(terminal_capacities));

    std::vector<std::pair<Index, int>> facets;
    for (Index cell = 0; cell < kind.cells; ++cell)
        for (int slot = 0; slot < 4; ++slot)
            facets.emplace_back(cell, slot);
    std::shuffle(facets.begin(), facets.end(), random);
    for (std::size_t k = 0; k < facets.size(); k += 2)
        connect(problem.cells, facets[k], facets[k + 1]);
    for (auto& arc_capacities : problem.network.arc_capacities)
        for (std::int32_t& value : arc_capacities)
            value = is_arc(random) ? residual(random) : 0;
    return problem;
}

/// Random arc and terminal capacities on the cells of a Delaunay triangulation.
Problem triangulated_problem(std::size_t points, const Kind& kind, std::mt19937& random)
{
    TetMesh cells = triangulate(testing::random_points(points, 11));
    Kind counted = kind;
    counted.cells = static_cast<Index>(cells.cells.size());
    Problem problem = random_problem(counted, random);
    problem.cells = std::move(cells);
    return problem;
}

/// A long row of cells, also joined over two steps: deep forests with few alternative parents.
Problem random_ladder(const Kind& kind, std::mt19937& random)
{
    Problem problem = random_problem(kind, random);
    for (Index cell = 0; cell < kind.cells; ++cell) {
        connect(problem.cells, {cell, 1}, {(cell + 1) % kind.cells, 0});
        connect(problem.cells, {cell, 3}, {(cell + 2) % kind.cells, 2});
    }
    return problem;
}

// ---- oracles ------------------------------------------------------------------------------------

std::int64_t cut_value(const Problem& problem, const Labels& labels)
{
    std::int64_t value = 0;
    for (Index cell = 0; cell < labels.size(); ++cell) {
        const std::int64_t excess = problem.network.terminal_capacities[cell];
        if (labels[cell] == i) {
            value += std::max<std::int64_t>(excess, 0);
            continue;
        }
        value += std::max<std::int64_t>(-excess, 0);
        for (int slot = 0; slot < 4; ++slot)
            if (labels[problem.cells.cells[cell].neighbors[slot]] == i)
                value += problem.network.arc_capacities[cell][slot];
    }
    return value;
}

/// The minimum cut with the fewest inside cells, among all cuts. The inside sets of minimum cuts
/// are closed under intersection, so this set is a subset of all others.
Labels cheapest_of_all_cuts(const Problem& problem)
{
    const std::size_t count = problem.cells.cells.size();
    Labels best(count, o), labels(count);
    std::pair<std::int64_t, std::ptrdiff_t> best_value(cut_value(problem, best), 0);
    for (std::uint32_t bits = 1; bits < 1U << count; ++bits) {
        for (std::size_t cell = 0; cell < count; ++cell)
            labels[cell] = bits >> cell & 1U ? i : o;
        const std::pair value(cut_value(problem, labels),
                              std::count(labels.begin(), labels.end(), i));
        if (value >= best_value) continue;
        best_value = value;
        best = labels;
    }
    return best;
}

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Vertex {
    boost::default_color_type color;
    long distance;
    Traits::edge_descriptor predecessor;
};
struct Edge {
    std::int64_t capacity;
    std::int64_t residual;
    Traits::edge_descriptor reverse;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Vertex, Edge>;

void add_arcs(Graph& graph, std::pair<std::size_t, std::size_t> ends,
              std::pair<std::int64_t, std::int64_t> capacities)
{
    const auto forward = boost::add_edge(ends.first, ends.second, graph).first;
    const auto backward = boost::add_edge(ends.second, ends.first, graph).first;
    graph[forward] = {capacities.first, 0, backward};
    graph[backward] = {capacities.second, 0, forward};
}

Graph to_boost(const Problem& problem)
{
    const std::size_t count = problem.cells.cells.size();
    Graph graph(count + 2);
    for (Index cell = 0; cell < count; ++cell) {
        const std::int64_t excess = problem.network.terminal_capacities[cell];
        add_arcs(graph, {count, cell}, {std::max<std::int64_t>(excess, 0), 0});
        add_arcs(graph, {cell, count + 1}, {std::max<std::int64_t>(-excess, 0), 0});
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = problem.cells.cells[cell].neighbors[slot];
            if (beyond < cell) continue;
            const int mirror = problem.cells.mirror(cell, slot);
            add_arcs(graph, {cell, beyond},
                     {problem.network.arc_capacities[cell][slot],
                      beyond == cell ? 0 : problem.network.arc_capacities[beyond][mirror]});
        }
    }
    return graph;
}

/// The maximum flow, and the cells from which the sink is reachable in the residual graph.
std::pair<std::int64_t, Labels> boost_cut(const Problem& problem)
{
    Graph graph = to_boost(problem);
    const std::size_t count = problem.cells.cells.size();
    const std::int64_t flow = boost::boykov_kolmogorov_max_flow(
        graph, boost::get(&Edge::capacity, graph), boost::get(&Edge::residual, graph),
        boost::get(&Edge::reverse, graph), boost::get(&Vertex::predecessor, graph),
        boost::get(&Vertex::color, graph), boost::get(&Vertex::distance, graph),
        boost::get(boost::vertex_index, graph), count, count + 1);

    Labels labels(count + 2, o);
    std::vector<std::size_t> open = {count + 1};
    while (!open.empty()) {
        const std::size_t reached = open.back();
        open.pop_back();
        for (const auto& arc : boost::make_iterator_range(boost::out_edges(reached, graph))) {
            const std::size_t from = boost::target(arc, graph);
            if (labels[from] == i || graph[graph[arc].reverse].residual == 0) continue;
            labels[from] = i;
            open.push_back(from);
        }
    }
    labels.resize(count);
    return {flow, labels};
}

Labels cut(const Problem& problem)
{
    return minimum_cut(problem.cells, problem.network);
}

// ---- hand-computed cases ------------------------------------------------------------------------

TEST(MinimumCut, IsEmptyForNoCells)
{
    EXPECT_EQ(cut(isolated_cells({})), Labels());
}

TEST(MinimumCut, LabelsOnlyIsolatedCellsWithADeficitInside)
{
    EXPECT_EQ(cut(isolated_cells({3, -2, 0, -kMost, kMost})), Labels({o, i, o, i, o}));
}

TEST(MinimumCut, IgnoresACapacityFromACellToItself)
{
    Problem problem = isolated_cells({4, -3, 0});
    problem.network.arc_capacities.assign(3, {9, 9, 9, 9});
    EXPECT_EQ(cut(problem), Labels({o, i, o}));
}

TEST(MinimumCut, CutsAChainAtItsNarrowestArc)
{
    EXPECT_EQ(cut(chain({9, 0, 0, 0, -9}, {7, 5, 3, 6}, {0, 0, 0, 0})), Labels({o, o, o, i, i}));
    EXPECT_EQ(cut(chain({9, 0, 0, 0, -9}, {2, 5, 3, 6}, {0, 0, 0, 0})), Labels({o, i, i, i, i}));
    EXPECT_EQ(cut(chain({9, 0, 0, 0, -9}, {7, 5, 3, 2}, {0, 0, 0, 0})), Labels({o, o, o, o, i}));
}

TEST(MinimumCut, ChoosesTheMinimumCutNearestTheSink)
{
    EXPECT_EQ(cut(chain({9, 0, 0, 0, -9}, {3, 3, 3, 3}, {8, 8, 8, 8})), Labels({o, o, o, o, i}));
    EXPECT_EQ(cut(chain({3, 0, 0, 0, -3}, {3, 3, 3, 3}, {8, 8, 8, 8})), Labels({o, o, o, o, o}));
    EXPECT_EQ(cut(chain({2, 0, 0, 0, -3}, {3, 3, 3, 3}, {8, 8, 8, 8})), Labels({i, i, i, i, i}));
}

TEST(MinimumCut, LabelsCellsThatReachNoDeficitOutside)
{
    EXPECT_EQ(cut(chain({0, 0, 5, 0, 0}, {1, 1, 1, 1}, {1, 1, 1, 1})), Labels(5, o));
    EXPECT_EQ(cut(chain({0, 0, -5, 0, 0}, {1, 1, 1, 1}, {1, 1, 1, 0})), Labels({i, i, i, i, o}));
    EXPECT_EQ(cut(chain({0, 0, 0, 0, 0}, {1, 1, 1, 1}, {1, 1, 1, 1})), Labels(5, o));
}

TEST(MinimumCut, ReturnsFlowIfALaterPathNeedsTheArc)
{
    // The short path 1 -> 2 is used first. The cut is correct only if part of its flow returns.
    Problem problem = isolated_cells({0, 4, 0, 0, -4, 0});
    connect(problem.cells, {1, 0}, {2, 0});
    connect(problem.cells, {2, 1}, {4, 0});
    connect(problem.cells, {1, 1}, {3, 0});
    connect(problem.cells, {3, 1}, {5, 0});
    connect(problem.cells, {5, 1}, {4, 1});
    connect(problem.cells, {0, 0}, {2, 2});
    connect(problem.cells, {0, 1}, {1, 2});
    problem.network.arc_capacities[1] = {3, 2, 0, 0};
    problem.network.arc_capacities[2] = {0, 3, 0, 0};
    problem.network.arc_capacities[3] = {0, 2, 0, 0};
    problem.network.arc_capacities[5] = {0, 1, 0, 0};
    problem.network.arc_capacities[0] = {1, 1, 0, 0};
    EXPECT_EQ(cut(problem), Labels({o, o, o, o, o, o}));
    problem.network.terminal_capacities[4] = -5;
    EXPECT_EQ(cut(problem), Labels({o, o, o, o, i, o}));
    problem.network.terminal_capacities[1] = 3;
    EXPECT_EQ(cut(problem), Labels({i, i, i, i, i, i}));
}

TEST(MinimumCut, HandlesTheLargestCapacities)
{
    const std::vector<std::int32_t> most(4, kMost);
    EXPECT_EQ(cut(chain({kMost - 1, 0, 0, 0, -kMost - 1}, most, most)), Labels(5, i));
    EXPECT_EQ(cut(chain({kMost, 0, 0, 0, -kMost - 1}, most, most)), Labels({o, o, o, o, i}));
    EXPECT_EQ(cut(chain({kMost, kMost, 0, -kMost, -kMost - 1}, most, most)),
              Labels({o, o, o, i, i}));
    EXPECT_EQ(cut(chain({kMost, kMost, kMost, kMost, -1}, most, most)), Labels(5, o));
    EXPECT_EQ(cut(chain({1, -kMost, -kMost, -kMost, -kMost}, most, most)), Labels(5, i));
}

TEST(MinimumCut, RejectsANegativeArcCapacity)
{
    Problem problem = isolated_cells({0, 0});
    problem.network.arc_capacities[1][2] = -1;
    EXPECT_THROW(cut(problem), std::invalid_argument);
}

TEST(MinimumCut, RejectsANetworkOfDifferentSize)
{
    Problem problem = isolated_cells({0, 0});
    problem.network.terminal_capacities.push_back(0);
    EXPECT_THROW(cut(problem), std::invalid_argument);
}

TEST(MinimumCut, RejectsBlockSizesThatNeverMerge)
{
    const Problem problem = isolated_cells({0, 0});
    EXPECT_THROW(minimum_cut(problem.cells, problem.network, {.cells = 0, .merged = 2}),
                 std::invalid_argument);
    EXPECT_THROW(minimum_cut(problem.cells, problem.network, {.cells = 1, .merged = 1}),
                 std::invalid_argument);
}

// ---- against the oracles ------------------------------------------------------------------------

TEST(MinimumCut, IsTheCheapestOfAllCutsOfTwelveCells)
{
    std::mt19937 random(1);
    const std::vector<Kind> kinds = {{12, 1, 1, 1.0, 1.0},
                                     {12, 2, 3, 0.7, 0.6},
                                     {12, 9, 30, 0.9, 0.3},
                                     {12, kMost, kMost, 0.8, 1.0}};
    for (int round = 0; round < 120; ++round) {
        const Kind& kind = kinds[static_cast<std::size_t>(round) % kinds.size()];
        const Problem problem =
            round % 8 < 4 ? random_problem(kind, random) : random_ladder(kind, random);
        ASSERT_EQ(cut(problem), cheapest_of_all_cuts(problem)) << "round " << round;
    }
}

TEST(MinimumCut, AgreesWithBoykovKolmogorov)
{
    std::mt19937 random(2);
    const std::vector<Kind> kinds = {{300, 1, 1, 1.0, 0.1},        {300, 3, 40, 0.6, 0.1},
                                     {1000, 100, 400, 1.0, 0.5},   {1000, 2, 1, 0.9, 0.9},
                                     {2000, 1000, 90, 0.95, 0.02}, {500, kMost, kMost, 0.9, 0.5}};
    for (int round = 0; round < 180; ++round) {
        const Kind& kind = kinds[static_cast<std::size_t>(round) % kinds.size()];
        const Problem problem =
            round % 12 < 6 ? random_problem(kind, random) : random_ladder(kind, random);
        const auto [flow, expected] = boost_cut(problem);
        const Labels labels = cut(problem);
        ASSERT_EQ(cut_value(problem, labels), flow) << "round " << round;
        ASSERT_EQ(labels, expected) << "round " << round;
    }
}

TEST(MinimumCut, AgreesWithBoykovKolmogorovOnATriangulation)
{
    std::mt19937 random(6);
    const std::vector<Kind> kinds = {{0, 100, 300, 1.0, 0.9}, {0, 300, 900, 0.9, 0.05}};
    for (const Kind& kind : kinds) {
        const Problem problem = triangulated_problem(8000, kind, random);
        ASSERT_GT(problem.cells.cells.size(), 3 * 16384U) << "several blocks must be merged";
        const auto [flow, expected] = boost_cut(problem);
        const Labels labels = cut(problem);
        EXPECT_EQ(cut_value(problem, labels), flow);
        EXPECT_TRUE(labels == expected);
    }
}

TEST(MinimumCut, DoesNotDependOnBlockSizes)
{
    std::mt19937 random(12);
    const std::vector<Kind> kinds = {{300, 1, 1, 1.0, 0.1},        {300, 3, 40, 0.6, 0.1},
                                     {1000, 100, 400, 1.0, 0.5},   {1000, 2, 1, 0.9, 0.9},
                                     {2000, 1000, 90, 0.95, 0.02}, {500, kMost, kMost, 0.9, 0.5}};
    const std::vector<FlowBlocks> sizes = {{2, 2}, {7, 3}, {40, 2}, {50, 16}, {150, 3}};
    for (int round = 0; round < 180; ++round) {
        const Kind& kind = kinds[static_cast<std::size_t>(round) % kinds.size()];
        const Problem problem =
            round % 12 < 6 ? random_problem(kind, random) : random_ladder(kind, random);
        const Labels expected = cut(problem); // in one block
        for (const FlowBlocks& blocks : sizes)
            ASSERT_EQ(minimum_cut(problem.cells, problem.network, blocks), expected)
                << "round " << round << ", blocks of " << blocks.cells;
    }
}

TEST(MinimumCut, DoesNotDependOnBlockSizesOnATriangulation)
{
    std::mt19937 random(13);
    const std::vector<Kind> kinds = {{0, 100, 300, 1.0, 0.9}, {0, 300, 900, 0.9, 0.05}};
    for (const Kind& kind : kinds) {
        const Problem problem = triangulated_problem(2000, kind, random);
        ASSERT_LT(problem.cells.cells.size(), FlowBlocks().cells) << "one block by default";
        const Labels expected = cut(problem);
        for (const FlowBlocks& blocks :
             {FlowBlocks{10, 4}, FlowBlocks{100, 2}, FlowBlocks{1000, 5}})
            EXPECT_TRUE(minimum_cut(problem.cells, problem.network, blocks) == expected)
                << "blocks of " << blocks.cells;
    }
}

TEST(MinimumCut, DoesNotDependOnTheThreadCount)
{
    std::mt19937 random(8);
    const Problem problem = triangulated_problem(8000, {0, 100, 300, 1.0, 0.9}, random);
    const auto cut_by = [&](int threads) {
        return tbb::task_arena(threads).execute([&] { return cut(problem); });
    };
    const Labels labels = cut_by(1);
    ASSERT_NE(std::count(labels.begin(), labels.end(), i), 0);
    EXPECT_TRUE(cut_by(2) == labels);
}

TEST(MinimumCut, SolvesALongChain)
{
    constexpr std::size_t kCells = 200000;
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int32_t> residual(5, 9);
    UnsetArray<std::int32_t> terminal_capacities(kCells, 0);
    std::vector<std::int32_t> forward(kCells - 1), backward(kCells - 1);
    for (std::int32_t& value : forward)
        value = residual(random);
    for (std::int32_t& value : backward)
        value = residual(random);
    terminal_capacities.front() = 100;
    terminal_capacities.back() = -100;
    forward[123456] = 4;
    Labels expected(kCells, i);
    std::fill(expected.begin(), expected.begin() + 123457, o);
    EXPECT_EQ(cut(chain(std::move(terminal_capacities), forward, backward)), expected);
}

// ---- invariances --------------------------------------------------------------------------------

TEST(MinimumCut, IsInvariantToPermutationsOfCellsAndSlots)
{
    std::mt19937 random(4);
    const Problem problem = random_problem({2000, 20, 60, 0.9, 0.4}, random);
    const std::size_t count = problem.cells.cells.size();
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    Problem permuted = isolated_cells(UnsetArray<std::int32_t>(count, 0));
    for (Index cell = 0; cell < count; ++cell) {
        permuted.network.terminal_capacities[order[cell]] =
            problem.network.terminal_capacities[cell];
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = problem.cells.cells[cell].neighbors[slot];
            connect(permuted.cells, {order[cell], 3 - slot},
                    {order[beyond], 3 - problem.cells.mirror(cell, slot)});
            permuted.network.arc_capacities[order[cell]][3 - slot] =
                problem.network.arc_capacities[cell][slot];
        }
    }
    const Labels labels = cut(problem);
    const Labels permuted_labels = cut(permuted);
    ASSERT_NE(std::count(labels.begin(), labels.end(), i), 0);
    for (Index cell = 0; cell < count; ++cell)
        ASSERT_EQ(permuted_labels[order[cell]], labels[cell]) << "cell " << cell;
}

TEST(MinimumCut, DoesNotChangeIfAllCapacitiesAreDoubled)
{
    std::mt19937 random(5);
    Problem problem = random_problem({2000, 20, 60, 0.9, 0.4}, random);
    const Labels labels = cut(problem);
    for (auto& arc_capacities : problem.network.arc_capacities)
        for (std::int32_t& value : arc_capacities)
            value *= 2;
    for (std::int32_t& value : problem.network.terminal_capacities)
        value *= 2;
    ASSERT_NE(std::count(labels.begin(), labels.end(), i), 0);
    EXPECT_EQ(cut(problem), labels);
}

} // namespace
} // namespace vcarve::max_flow_test
