#include "steps/5_labels/max_flow/flow_forest.h"

#include "base/arrays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

// The minimum cut by EIBFS, excesses incremental breadth-first search, in a sink-side-only variant:
// Goldberg, Hed, Kaplan, Kohli, Tarjan, Werneck, "Faster and more dynamic maximum flow by
// incremental breadth-first search" (ESA 2015), after "Maximum flows by incremental breadth-first
// search" (ESA 2011).
//
// Network (FlowNetwork, model/visibility_energy.h). Nodes are cells; an arc leads through each
// facet in each direction. The source side of the cut is outside, the sink side inside. A cut pays
// the source capacity of each inside cell, the sink capacity of each outside cell, and each arc
// from an outside to an inside cell. A ray adds to the sink capacity of the cell behind its point.
// At each facet that it crosses, it adds to the arc that leads towards the point. RayCaster
// (4_visibility/trace.cpp) does so, and pushes the flow of each ray: capacities are residual from
// the start. A positive excess of a cell is the capacity left from the source. A negative one is a
// deficit: the capacity left to the sink. cut_network() (5_labels/label_cells.cpp) adds the cost of
// each facet to both arcs, and merges infinite cells and cells of views with the source.
//
// Algorithm. A forest of shortest paths grows level by level from its roots, the cells with a
// deficit. A cell joins if an arc with residual capacity leads from it into the forest. Excess of a
// neighbor is pulled in, as far as the arc carries it, and pushed from parent to parent to the
// root. Levels count from the root: a cell whose level rises moves away from it. Saturated arcs and
// filled roots leave orphans, which look for another parent one level closer to the root. Orphans
// without one are detached with their subtrees, then reattached by breadth-first search from the
// rest of the forest, or left out. Excess that cannot reach a root stays outside the forest. In the
// end the forest contains exactly the cells that reach a deficit, and no arc with residual capacity
// enters it: it is the sink side. All other cells are outside.
//
// Differences from EIBFS. Only the sink side grows, because the excess of a ray is a few cells from
// the deficit behind its point. One search reattaches all detached cells, instead of relabeling one
// by one. Blocks of consecutive cells, which are close in space and fit a cache, are solved
// separately, in parallel, then merged. The labels do not depend on the blocks.
//
// Merging. A merge grows the joint forest level by level again. It visits only cells that can lower
// the level of a neighbor: cells with a neighbor in another block, then cells with a lowered level.
// Up to level depth_ the forest is as if grown from scratch. Deeper parts are those of the blocks:
// no cell has excess, but levels may be too large, and parents more than one level away.
//
// Loops over the facets of a cell first select facets as bits, without unpredictable branches.
//
// Cost: while a forest grows, levels only rise, and each rise costs a constant. An
// augmentation pushes from a cell at most once, unless a cell with excess is reattached. This is
// O(cells^3) at worst, and nearly linear for networks of rays. Only merges lower levels,
// those of the forests of their blocks.

namespace vcarve {
namespace {

constexpr std::int32_t kElsewhere = -1; ///< level of cells outside the block
constexpr std::size_t kFetchAhead = 8;
/// Scanned cells between augmentations: for paths to share pushes, and fit the cache.
constexpr int kScansPerAugmentation = 256;

} // namespace

std::int32_t FlowForest::level(Index cell) const
{
    const bool here = cell - first_ < count_;
    const std::int32_t found = nodes_[here ? cell : first_].level;
    return here ? found : kElsewhere;
}

/// `cell`, or `other` if `cell` is outside the block.
Index FlowForest::if_here(Index cell, Index other) const
{
    return cell - first_ < count_ ? cell : other;
}

void FlowForest::join(Index cell, int parent, std::int32_t level)
{
    FlowNode& node = nodes_[cell];
    node.level = level;
    node.parent = static_cast<std::uint8_t>(parent);
    if (level != depth_ || node.waits) return;
    node.waits = true;
    front_.push_back(cell);
}

void FlowForest::list_to_augment(Index cell)
{
    FlowNode& node = nodes_[cell];
    if (node.is_active || node.excess <= 0) return;
    node.is_active = true;
    active_.add(cell, node.level);
}

// ---- orphans ------------------------------------------------------------------------------------

/// Gives an orphan another parent one level closer to the root. Returns false if there is none.
bool FlowForest::adopt(Index cell)
{
    const std::int32_t above = nodes_[cell].level - 1;
    if (above == 0) return false;
    unsigned parents = 0;
    for (int slot = 0; slot < 4; ++slot) {
        const std::int32_t there = level(graph_.neighbor(cell, slot));
        const bool fits = (there == above) & (graph_.capacity_out(cell, slot) != 0);
        parents |= static_cast<unsigned>(fits) << slot;
    }
    for (; parents != 0; parents &= parents - 1) {
        const int slot = std::countr_zero(parents);
        // Filled roots are orphans themselves.
        if (above == 1 && nodes_[graph_.neighbor(cell, slot)].excess >= 0) continue;
        nodes_[cell].parent = static_cast<std::uint8_t>(slot);
        return true;
    }
    return false;
}

void FlowForest::adopt_or_detach(Index cell)
{
    if (adopt(cell)) return;
    const std::int32_t own = nodes_[cell].level;
    nodes_[cell].level = 0;
    detached_.push_back(cell);
    unsigned children = 0;
    for (int slot = 0; slot < 4; ++slot) {
        const FlowNode& child = nodes_[if_here(graph_.neighbor(cell, slot), cell)];
        const bool hangs = (child.level > own) & (child.parent == graph_.mirror(cell, slot));
        children |= static_cast<unsigned>(hangs) << slot;
    }
    for (; children != 0; children &= children - 1) {
        const Index child = graph_.neighbor(cell, std::countr_zero(children));
        nodes_[child].parent = kNoParent;
        orphans_.add(child, nodes_[child].level);
    }
}

/// Finds the best parent of a detached cell in the rest of the forest; lists the cell one level
/// farther from the root than that parent.
void FlowForest::seek_parent(Index cell)
{
    std::int32_t best = depth_;
    int best_slot = kNoParent;
    for (int slot = 0; slot < 4; ++slot) {
        const std::int32_t above = level(graph_.neighbor(cell, slot));
        const bool better = (above > 0) & (above < best) & (graph_.capacity_out(cell, slot) != 0);
        best = better ? above : best;
        best_slot = better ? slot : best_slot;
    }
    nodes_[cell].parent = static_cast<std::uint8_t>(best_slot);
    if (best < depth_) orphans_.add(cell, best + 1);
}

/// Adds neighbors outside the forest as children of a reattached cell.
void FlowForest::reach_from(Index cell)
{
    const std::int32_t below = nodes_[cell].level + 1;
    if (below > depth_) return;
    unsigned reached = 0;
    for (int slot = 0; slot < 4; ++slot) {
        const Index beyond = if_here(graph_.neighbor(cell, slot), cell);
        const std::uint32_t capacity = graph_.capacity_out(beyond, graph_.mirror(cell, slot));
        const bool hangs = (nodes_[beyond].level == 0) & (capacity != 0);
        reached |= static_cast<unsigned>(hangs) << slot;
    }
    for (; reached != 0; reached &= reached - 1) {
        const int slot = std::countr_zero(reached);
        const Index beyond = graph_.neighbor(cell, slot);
        join(beyond, graph_.mirror(cell, slot), below);
        next_wave_.push_back(beyond);
    }
}

/// Reattaches detached cells by breadth-first search from the rest of the forest.
void FlowForest::reattach()
{
    for (std::int32_t level = orphans_.lowest(); level <= depth_; ++level) {
        wave_.clear();
        std::swap(wave_, next_wave_);
        while (orphans_.lowest() == level) {
            const Index cell = orphans_.take(level);
            if (nodes_[cell].level != 0) continue;
            join(cell, nodes_[cell].parent, level);
            wave_.push_back(cell);
        }
        for (const Index cell : wave_)
            reach_from(cell);
        if (next_wave_.empty()) level = orphans_.lowest() - 1;
    }
}

/// Repairs the forest after augmentations. Handles orphans by increasing level, so possible parents
/// are final.
void FlowForest::repair()
{
    for (std::int32_t level = orphans_.lowest(); level != kMost; level = orphans_.lowest())
        adopt_or_detach(orphans_.take(level));
    for (const Index cell : detached_)
        seek_parent(cell);
    reattach();
    for (const Index cell : detached_) {
        if (nodes_[cell].level > 0) {
            list_to_augment(cell);
        } else if (!visits_.empty()) {
            list_to_visit_around(cell);
        }
    }
    detached_.clear();
}

// ---- augmenting ---------------------------------------------------------------------------------

/// Pushes the excess of a cell through its parent, then through others one level closer to the
/// root.
void FlowForest::augment(Index cell)
{
    FlowNode& node = nodes_[cell];
    while (node.excess > 0) {
        const int slot = node.parent;
        const Index parent = graph_.neighbor(cell, slot);
        const bool to_root = nodes_[parent].level == 1;
        const std::uint32_t room = graph_.room(parent);
        const auto excess = static_cast<std::uint32_t>(node.excess);
        const std::uint32_t amount = std::min({excess, graph_.capacity_out(cell, slot), room});
        graph_.push(cell, slot, amount);
        if (!to_root) list_to_augment(parent);

        const bool filled = to_root && amount == room;
        if (filled && room > 0) orphans_.add(parent, 1);
        if (filled || graph_.capacity_out(cell, slot) == 0) {
            if (adopt(cell)) continue;
            node.parent = kNoParent;
            orphans_.add(cell, node.level);
            return;
        }
        if (node.excess > 0) {
            late_.push_back(cell);
            return;
        }
    }
}

/// Augments from the deepest level up, so that excess accumulates, then repairs the forest. Repeats
/// this for cells that were reattached with excess. Leaves no excess in the forest.
void FlowForest::augment_all()
{
    do {
        for (std::int32_t level = active_.highest(); level != 0; level = active_.highest()) {
            const Index cell = active_.take(level);
            nodes_[cell].is_active = false;
            augment(cell);
        }
        repair();
        for (const Index cell : late_) {
            if (nodes_[cell].level > 0) list_to_augment(cell);
        }
        late_.clear();
    } while (active_.highest() != 0);
}

// ---- growing ------------------------------------------------------------------------------------

/// Pulls excess from neighbors outside the forest; those left without excess become children. Stops
/// and returns true if the cell has no room.
bool FlowForest::activate(Index cell)
{
    unsigned gains = 0;
    for (int slot = 0; slot < 4; ++slot) {
        const std::int32_t there = level(graph_.neighbor(cell, slot));
        gains |= static_cast<unsigned>((there == 0) | (there > depth_)) << slot;
    }
    for (; gains != 0; gains &= gains - 1) {
        const int slot = std::countr_zero(gains);
        const Index beyond = graph_.neighbor(cell, slot);
        const int mirror = graph_.mirror(cell, slot);
        const std::uint32_t capacity = graph_.capacity_out(beyond, mirror);
        if (capacity == 0) continue;
        if (nodes_[beyond].excess > 0) {
            const std::uint32_t room = graph_.room(cell);
            const auto excess = static_cast<std::uint32_t>(nodes_[beyond].excess);
            const std::uint32_t amount = std::min({excess, capacity, room});
            graph_.push(beyond, mirror, amount);
            if (amount == room) return true;
            if (amount == capacity) continue;
        }
        join(beyond, mirror, depth_);
    }
    return false;
}

void FlowForest::grow_from(Index cell)
{
    const std::int32_t own = nodes_[cell].level;
    bool full = true;
    while (full && nodes_[cell].level == own) {
        full = activate(cell);
        list_to_augment(cell);
        if (full && own == 1) orphans_.add(cell, 1);
        if (full) augment_all();
    }
}

/// Prefetches the memory of the next cells of growing_. Without this, waiting is half of the time
/// of a large front.
void FlowForest::fetch_ahead(std::size_t at) const
{
    if (at + 2 * kFetchAhead >= growing_.size()) return;
    const Index far = growing_[at + 2 * kFetchAhead];
    prefetch(&graph_.cells[far].neighbors);
    prefetch(&nodes_[far]);
    for (const Index beyond : graph_.cells[growing_[at + kFetchAhead]].neighbors) {
        prefetch(&nodes_[beyond]);
        prefetch(&graph_.arc_capacities[beyond]);
    }
}

/// Adds a level to the forest.
void FlowForest::grow()
{
    growing_.clear();
    std::swap(growing_, front_);
    for (const Index cell : growing_)
        nodes_[cell].waits = false;
    const std::int32_t level = depth_++;
    if (static_cast<std::size_t>(level) < visits_.size()) {
        const std::vector<Index> visits = std::move(visits_[static_cast<std::size_t>(level)]);
        growing_.insert(growing_.end(), visits.begin(), visits.end());
    }
    int scans = 0;
    for (std::size_t k = 0; k < growing_.size(); ++k) {
        fetch_ahead(k);
        const Index cell = growing_[k];
        if (nodes_[cell].level == level) grow_from(cell);
        if (++scans % kScansPerAugmentation == 0) augment_all();
    }
    augment_all();
}

FilledBlock FlowForest::fill()
{
    FilledBlock filled = {first_, first_ + count_, 0, {}};
    for (Index cell = first_; cell - first_ < count_; ++cell) {
        if (nodes_[cell].excess < 0) join(cell, kNoParent, 1);
        if (leaves(cell)) filled.border.push_back(cell);
    }
    while (!front_.empty())
        grow();
    filled.deepest = depth_;
    return filled;
}

// ---- merging ------------------------------------------------------------------------------------

/// Whether a cell has a neighbor outside the block.
bool FlowForest::leaves(Index cell) const
{
    const std::array<Index, 4>& neighbors = graph_.cells[cell].neighbors;
    return std::any_of(neighbors.begin(), neighbors.end(),
                       [&](Index beyond) { return beyond - first_ >= count_; });
}

/// Whether a cell can lower the level of a neighbor.
bool FlowForest::lowers(Index cell) const
{
    const std::int32_t own = nodes_[cell].level;
    if (own == 0) return false;
    for (int slot = 0; slot < 4; ++slot) {
        const std::int32_t there = level(graph_.neighbor(cell, slot));
        const bool higher = there == 0 || there > own + 1;
        if (higher && graph_.capacity_in(cell, slot) != 0) return true;
    }
    return false;
}

/// Lists the neighbors in old forests through which a detached cell may return.
void FlowForest::list_to_visit_around(Index cell)
{
    for (const Index beyond : graph_.cells[cell].neighbors) {
        // Waiting cells are visited anyway.
        if (level(beyond) < depth_ || nodes_[beyond].waits) continue;
        visits_[static_cast<std::size_t>(nodes_[beyond].level)].push_back(beyond);
    }
}

FilledBlock FlowForest::merge(std::span<const FilledBlock> parts)
{
    FilledBlock merged = {first_, first_ + count_, 1, {}};
    for (const FilledBlock& part : parts)
        merged.deepest = std::max(merged.deepest, part.deepest);
    visits_.resize(static_cast<std::size_t>(merged.deepest) + 1);
    for (const FilledBlock& part : parts) {
        for (const Index cell : part.border) {
            if (leaves(cell)) merged.border.push_back(cell);
            if (lowers(cell)) visits_[static_cast<std::size_t>(nodes_[cell].level)].push_back(cell);
        }
    }
    while (depth_ <= merged.deepest || !front_.empty())
        grow();
    visits_.clear();
    merged.deepest = depth_;
    return merged;
}

} // namespace vcarve
