#include "label/max_flow.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

// Incremental breadth-first search after Goldberg, Hed, Kaplan, Tarjan, Werneck, "Maximum flows by
// incremental breadth-first search" (ESA 2011), from a preflow instead of terminal arcs, as in
// "Faster and more dynamic maximum flow by incremental breadth-first search" (ESA 2015).
//
// Two forests of shortest paths grow level by level: the source forest from the cells with an
// excess, along arcs with residual capacity, and the sink forest from those with a deficit, against
// them. Where they meet, flow is pushed from root to root. A tree arc that saturates leaves an
// orphan, which looks for another parent on its own level or a deeper one before it is let go.
// Levels of a cell only grow while it stays in a forest, so the work is at most O(cells^3).
//
// Invariants between augmentations, for the source forest (mirrored for the sink forest):
// - a cell is one level deeper than its parent, and the arc from the parent has residual capacity;
// - an arc with residual capacity climbs at most one level;
// - no arc with residual capacity leads out of the forest except from cells waiting in `front`.

namespace vcarve {
namespace {

enum class Side { source, sink };

constexpr Side opposite(Side side)
{
    return side == Side::source ? Side::sink : Side::source;
}

constexpr std::uint8_t kNoParent = 4; ///< of roots, orphans and free cells

struct Node {
    std::int32_t level = 0; ///< 1 for roots; negative in the sink forest, 0 for free cells
    std::uint8_t mirrors = 0;
    std::uint8_t parent = kNoParent;            ///< slot towards the parent
    std::array<bool, 2> waits = {false, false}; ///< in the front of a side
};
static_assert(sizeof(Node) == 8);

/// What a forest keeps besides the levels and parents of its cells.
struct Forest {
    std::int32_t depth = 1;     ///< deepest level a cell may be given
    std::vector<Index> front;   ///< cells to grow from: all those at `depth`, and stale ones
    std::vector<Index> growing; ///< the front of the level being grown
    std::vector<Index> orphans; ///< per level, the first of a list through next_orphan_
    std::int32_t lowest_orphan = std::numeric_limits<std::int32_t>::max();
    std::int32_t highest_orphan = 0;
};

class Solver {
  public:
    Solver(const TetMesh& cells, FlowNetwork network);
    void solve();
    Labels labels() const;

  private:
    // ---- one arc -----
    Index neighbor(Index cell, int slot) const { return cells_[cell].neighbors[slot]; }
    int mirror(Index cell, int slot) const { return (nodes_[cell].mirrors >> (2 * slot)) & 3; }
    /// Residual capacities stay below 2^32: each arc and its reverse begin below 2^31.
    std::uint32_t capacity_out(Index cell, int slot) const;
    std::uint32_t capacity_in(Index cell, int slot) const;
    /// Capacity to grow the forest from a cell across a slot, or to hang the cell on what lies
    /// there.
    template <Side side>
    std::uint32_t capacity_to_grow(Index cell, int slot) const;
    template <Side side>
    std::uint32_t capacity_to_hang(Index cell, int slot) const;
    void push(Index cell, int slot, std::uint32_t amount);

    // ---- one cell -----
    template <Side side>
    std::int32_t level(Index cell) const; ///< <= 0 unless in the forest
    template <Side side>
    void set_level(Index cell, std::int32_t level);
    template <Side side>
    Forest& forest()
    {
        return forests_[static_cast<int>(side)];
    }
    template <Side side>
    void wait(Index cell);

    void check_arcs();
    void plant();
    template <Side side>
    bool settle(Index cell);
    void settle_all();

    template <Side side>
    void grow();
    template <Side side>
    void grow_from(Index cell);
    void augment(Index cell, int slot);
    template <Side side>
    std::uint32_t bottleneck(Index cell, std::uint32_t limit) const;
    template <Side side>
    void push_to_root(Index cell, std::uint32_t amount);

    template <Side side>
    void make_orphan(Index cell);
    template <Side side>
    void orphan_children(Index cell);
    template <Side side>
    void adopt_orphans();
    template <Side side>
    void adopt(Index cell);

    const std::vector<Cell>& cells_;
    FlowNetwork network_;
    std::vector<Node> nodes_;
    std::vector<Index> next_orphan_;
    std::array<Forest, 2> forests_;
};

std::uint32_t Solver::capacity_out(Index cell, int slot) const
{
    return static_cast<std::uint32_t>(network_.residuals[cell][slot]);
}

std::uint32_t Solver::capacity_in(Index cell, int slot) const
{
    return capacity_out(neighbor(cell, slot), mirror(cell, slot));
}

template <Side side>
std::uint32_t Solver::capacity_to_grow(Index cell, int slot) const
{
    return side == Side::source ? capacity_out(cell, slot) : capacity_in(cell, slot);
}

template <Side side>
std::uint32_t Solver::capacity_to_hang(Index cell, int slot) const
{
    return capacity_to_grow<opposite(side)>(cell, slot);
}

/// Sends flow through the arc that leaves `cell` by `slot`.
void Solver::push(Index cell, int slot, std::uint32_t amount)
{
    std::int32_t& forward = network_.residuals[cell][slot];
    std::int32_t& reverse = network_.residuals[neighbor(cell, slot)][mirror(cell, slot)];
    forward = static_cast<std::int32_t>(static_cast<std::uint32_t>(forward) - amount);
    reverse = static_cast<std::int32_t>(static_cast<std::uint32_t>(reverse) + amount);
}

template <Side side>
std::int32_t Solver::level(Index cell) const
{
    return side == Side::source ? nodes_[cell].level : -nodes_[cell].level;
}

template <Side side>
void Solver::set_level(Index cell, std::int32_t level)
{
    nodes_[cell].level = side == Side::source ? level : -level;
    if (level == forest<side>().depth) wait<side>(cell);
}

template <Side side>
void Solver::wait(Index cell)
{
    bool& waits = nodes_[cell].waits[static_cast<int>(side)];
    if (waits) return;
    waits = true;
    forest<side>().front.push_back(cell);
}

// ---- growing ------------------------------------------------------------------------------------

template <Side side>
std::uint32_t Solver::bottleneck(Index cell, std::uint32_t limit) const
{
    while (nodes_[cell].parent != kNoParent) {
        const int slot = nodes_[cell].parent;
        limit = std::min(limit, capacity_to_hang<side>(cell, slot));
        cell = neighbor(cell, slot);
    }
    const std::int32_t excess = network_.excesses[cell];
    const auto rest = static_cast<std::uint32_t>(excess);
    return std::min(limit, side == Side::source ? rest : 0U - rest);
}

template <Side side>
void Solver::push_to_root(Index cell, std::uint32_t amount)
{
    while (nodes_[cell].parent != kNoParent) {
        const int slot = nodes_[cell].parent;
        const Index parent = neighbor(cell, slot);
        if (side == Side::source)
            push(parent, mirror(cell, slot), amount);
        else
            push(cell, slot, amount);
        if (capacity_to_hang<side>(cell, slot) == 0) make_orphan<side>(cell);
        cell = parent;
    }
    std::int32_t& excess = network_.excesses[cell];
    const auto change = side == Side::source ? 0U - amount : amount;
    excess = static_cast<std::int32_t>(static_cast<std::uint32_t>(excess) + change);
    if (excess == 0) make_orphan<side>(cell);
}

/// Pushes flow from root to root through the arc that leaves a cell of the source forest by `slot`
/// into the sink forest, and mends the forests.
void Solver::augment(Index cell, int slot)
{
    const Index beyond = neighbor(cell, slot);
    std::uint32_t amount = capacity_out(cell, slot);
    amount = bottleneck<Side::source>(cell, amount);
    amount = bottleneck<Side::sink>(beyond, amount);
    push(cell, slot, amount);
    push_to_root<Side::source>(cell, amount);
    push_to_root<Side::sink>(beyond, amount);
    adopt_orphans<Side::source>();
    adopt_orphans<Side::sink>();
}

template <Side side>
void Solver::grow_from(Index cell)
{
    const std::int32_t depth = level<side>(cell);
    for (int slot = 0; slot < 4; ++slot) {
        const Index beyond = neighbor(cell, slot);
        // Push through this arc as long as it leads to the other forest.
        while (level<side>(beyond) < 0 && capacity_to_grow<side>(cell, slot) > 0) {
            if (side == Side::source)
                augment(cell, slot);
            else
                augment(beyond, mirror(cell, slot));
            if (level<side>(cell) != depth) return;
        }
        if (level<side>(beyond) == 0 && capacity_to_grow<side>(cell, slot) > 0) {
            nodes_[beyond].parent = static_cast<std::uint8_t>(mirror(cell, slot));
            set_level<side>(beyond, depth + 1);
        }
    }
}

/// Adds the next level to a forest.
template <Side side>
void Solver::grow()
{
    Forest& grown = forest<side>();
    grown.growing.clear();
    std::swap(grown.growing, grown.front);
    for (const Index cell : grown.growing)
        nodes_[cell].waits[static_cast<int>(side)] = false;
    const std::int32_t depth = grown.depth++;
    for (const Index cell : grown.growing) {
        if (level<side>(cell) == depth) grow_from<side>(cell);
    }
}

// ---- orphans ------------------------------------------------------------------------------------

template <Side side>
void Solver::make_orphan(Index cell)
{
    Forest& mended = forest<side>();
    const std::int32_t depth = level<side>(cell);
    const auto bucket = static_cast<std::size_t>(depth);
    if (mended.orphans.size() <= bucket) mended.orphans.resize(2 * bucket + 1, kInfinite);
    nodes_[cell].parent = kNoParent;
    next_orphan_[cell] = mended.orphans[bucket];
    mended.orphans[bucket] = cell;
    mended.lowest_orphan = std::min(mended.lowest_orphan, depth);
    mended.highest_orphan = std::max(mended.highest_orphan, depth);
}

template <Side side>
void Solver::orphan_children(Index cell)
{
    for (int slot = 0; slot < 4; ++slot) {
        const Index child = neighbor(cell, slot);
        if (nodes_[child].parent == mirror(cell, slot) && level<side>(child) > 0)
            make_orphan<side>(child);
    }
}

/// Hangs an orphan on another parent, at its own level or the next possible one, or lets it go.
template <Side side>
void Solver::adopt(Index cell)
{
    const std::int32_t own = level<side>(cell);
    std::int32_t best = std::numeric_limits<std::int32_t>::max();
    int best_slot = kNoParent;
    for (int slot = 0; slot < 4; ++slot) {
        const std::int32_t depth = level<side>(neighbor(cell, slot));
        if (depth <= 0 || depth >= best || capacity_to_hang<side>(cell, slot) == 0) continue;
        best = depth;
        best_slot = slot;
        if (depth == own - 1) break;
    }
    if (best != own - 1) orphan_children<side>(cell);
    if (best_slot != kNoParent && best < forest<side>().depth) {
        nodes_[cell].parent = static_cast<std::uint8_t>(best_slot);
        if (best != own - 1) set_level<side>(cell, best + 1);
    } else {
        nodes_[cell].level = 0;
    }
}

/// Adopts by rising level: what an orphan finds one level above it is settled.
template <Side side>
void Solver::adopt_orphans()
{
    Forest& mended = forest<side>();
    for (; mended.lowest_orphan <= mended.highest_orphan; ++mended.lowest_orphan) {
        const auto bucket = static_cast<std::size_t>(mended.lowest_orphan);
        while (mended.orphans[bucket] != kInfinite) {
            const Index cell = mended.orphans[bucket];
            mended.orphans[bucket] = next_orphan_[cell];
            adopt<side>(cell);
        }
    }
    mended.lowest_orphan = std::numeric_limits<std::int32_t>::max();
    mended.highest_orphan = 0;
}

// ---- beginning and end --------------------------------------------------------------------------

/// Decides a cell whose excess is at least all its arcs can carry away, so it is outside under
/// every minimum cut, or whose deficit is more than all its arcs can bring, so it is inside: its
/// arcs are saturated and it never takes part again. Leaves cells alone where a sum would overflow.
template <Side side>
bool Solver::settle(Index cell)
{
    const auto signed_by_side = [](std::int64_t amount) {
        return side == Side::source ? amount : -amount;
    };
    std::int64_t total = 0;
    for (int slot = 0; slot < 4; ++slot)
        total += capacity_to_grow<side>(cell, slot);
    const std::int64_t rest = signed_by_side(network_.excesses[cell]) - total;
    if (rest < 0 || (side == Side::sink && rest == 0)) return false;
    for (int slot = 0; slot < 4; ++slot) {
        const std::int64_t there = network_.excesses[neighbor(cell, slot)];
        if (std::abs(there) + total > std::numeric_limits<std::int32_t>::max()) return false;
    }
    for (int slot = 0; slot < 4; ++slot) {
        const std::uint32_t amount = capacity_to_grow<side>(cell, slot);
        const Index beyond = neighbor(cell, slot);
        if (side == Side::source)
            push(cell, slot, amount);
        else
            push(beyond, mirror(cell, slot), amount);
        network_.excesses[beyond] += static_cast<std::int32_t>(signed_by_side(amount));
    }
    network_.excesses[cell] = static_cast<std::int32_t>(signed_by_side(rest));
    nodes_[cell].level = side == Side::source ? 1 : -1;
    return true;
}

/// Settles every cell that can be: what one cell sends to its neighbours may settle them in turn.
void Solver::settle_all()
{
    std::vector<Index> open;
    for (Index start = 0; start < nodes_.size(); ++start) {
        open.push_back(start);
        while (!open.empty()) {
            const Index cell = open.back();
            open.pop_back();
            if (nodes_[cell].level != 0) continue;
            if (!settle<Side::source>(cell) && !settle<Side::sink>(cell)) continue;
            for (const Index beyond : cells_[cell].neighbors) {
                if (beyond < start) open.push_back(beyond);
            }
        }
    }
}

/// Makes roots of the cells with an excess or a deficit.
void Solver::plant()
{
    for (Index cell = 0; cell < nodes_.size(); ++cell) {
        if (nodes_[cell].level != 0) continue;
        if (network_.excesses[cell] > 0) set_level<Side::source>(cell, 1);
        if (network_.excesses[cell] < 0) set_level<Side::sink>(cell, 1);
    }
}

void Solver::check_arcs()
{
    for (Index cell = 0; cell < nodes_.size(); ++cell) {
        for (int slot = 0; slot < 4; ++slot) {
            std::int32_t& residual = network_.residuals[cell][slot];
            if (residual < 0) throw std::invalid_argument("minimum_cut: a residual is negative");
            if (neighbor(cell, slot) == cell) residual = 0;
        }
    }
}

Solver::Solver(const TetMesh& cells, FlowNetwork network)
    : cells_(cells.cells),
      network_(std::move(network)),
      nodes_(cells.cells.size()),
      next_orphan_(cells.cells.size())
{
    const std::size_t count = cells_.size();
    if (cells.mirrors.size() != count || network_.residuals.size() != count ||
        network_.excesses.size() != count)
        throw std::invalid_argument("minimum_cut: cells, mirrors and network differ in size");
    for (Index cell = 0; cell < count; ++cell)
        nodes_[cell].mirrors = cells.mirrors[cell];
    check_arcs();
}

void Solver::solve()
{
    settle_all();
    plant();
    // Once the sink forest cannot grow any more it holds all cells that reach a deficit, and it is
    // cut off from the source forest. Grow the side with the smaller front while both can.
    while (!forest<Side::sink>().front.empty()) {
        const std::size_t source_front = forest<Side::source>().front.size();
        if (source_front > 0 && source_front < forest<Side::sink>().front.size())
            grow<Side::source>();
        else
            grow<Side::sink>();
    }
}

Labels Solver::labels() const
{
    Labels labels(nodes_.size());
    std::transform(nodes_.begin(), nodes_.end(), labels.begin(), [](const Node& node) {
        return node.level < 0 ? Label::inside : Label::outside;
    });
    return labels;
}

} // namespace

Labels minimum_cut(const TetMesh& cells, FlowNetwork network)
{
    Solver solver(cells, std::move(network));
    solver.solve();
    return solver.labels();
}

} // namespace vcarve
