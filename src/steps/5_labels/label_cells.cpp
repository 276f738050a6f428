#include "steps/5_labels/label_cells.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "steps/5_labels/boundary.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Array2d;
using Eigen::Array4d;
using Eigen::Vector3d;

using Costs = std::array<std::int32_t, 4>;
using FacetCosts = UnsetArray<Costs>;

/// The cosines of the angles between each facet of a finite cell and its circumsphere; not finite
/// if the cell is too flat to have one. Roots and divisions, which are most of the cost, are
/// vectorized.
Array4d sphere_cosines(const TetMesh& mesh, const Cell& cell)
{
    const Vector3d& origin = mesh.positions[cell.vertices[0]];
    const Vector3d a = mesh.positions[cell.vertices[1]] - origin;
    const Vector3d b = mesh.positions[cell.vertices[2]] - origin;
    const Vector3d c = mesh.positions[cell.vertices[3]] - origin;
    // Inward normals per slot. Facets 1 to 3 meet at the origin, and facet 0 is opposite.
    const Vector3d opposite = (c - a).cross(b - a);
    const Vector3d bc = b.cross(c);
    const Vector3d ca = c.cross(a);
    const Vector3d ab = a.cross(b);
    const double volume_6 = a.dot(bc);
    const Vector3d center =
        (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab) / (2.0 * volume_6);
    const Vector3d center_from_a = center - a;
    const Array2d radii = Array2d(center_from_a.squaredNorm(), center.squaredNorm()).sqrt();
    const Array4d lengths =
        Array4d(opposite.squaredNorm(), bc.squaredNorm(), ca.squaredNorm(), ab.squaredNorm())
            .sqrt();
    const Array4d dots(opposite.dot(center_from_a), bc.dot(center), ca.dot(center), ab.dot(center));
    return dots / (lengths * Array4d(radii[0], radii[1], radii[1], radii[1]));
}

/// 1 - cos of the angle between each facet of a cell and the cell's circumsphere, in steps; 0 for
/// infinite cells.
Costs sphere_angle_costs(const TetMesh& mesh, const Cell& cell, double steps)
{
    Costs costs = {0, 0, 0, 0};
    if (cell.is_infinite()) return costs;
    const Array4d cosines = sphere_cosines(mesh, cell);
    for (int slot = 0; slot < 4; ++slot) {
        constexpr double kUnknown = 0.5; // a cell too flat to have a circumsphere
        const double cosine = cosines[slot];
        const double cost = std::isfinite(cosine) ? 1.0 - std::clamp(cosine, -1.0, 1.0) : kUnknown;
        costs[slot] = round_half_up(steps * cost);
    }
    return costs;
}

/// The cost of each facet by the shape of the cell, in steps.
FacetCosts facet_costs(const TetMesh& mesh, double steps)
{
    FacetCosts costs(mesh.cells.size());
    parallel_for(mesh.cells.size(),
                 [&](std::size_t i) { costs[i] = sphere_angle_costs(mesh, mesh.cells[i], steps); });
    return costs;
}

/// Adds the cost of each facet to its arcs in both directions: the larger one of its two cells.
void add_facet_costs(const TetMesh& mesh, const FacetCosts& costs, FlowNetwork& network)
{
    parallel_for(mesh.cells.size(), [&](std::size_t i) {
        for (int slot = 0; slot < 4; ++slot) {
            const Index neighbor = mesh.cells[i].neighbors[slot];
            const int mirror = mesh.mirror(static_cast<Index>(i), slot);
            network.arc_capacities[i][slot] += std::max(costs[i][slot], costs[neighbor][mirror]);
        }
    });
}

/// Merges a cell with the source: its outgoing arcs are saturated, and their flow becomes excess of
/// its neighbors.
void give_to_source(const TetMesh& mesh, Index cell, FlowNetwork& network)
{
    for (int slot = 0; slot < 4; ++slot) {
        const Index neighbor = mesh.cells[cell].neighbors[slot];
        // Clamped to 32 bits: no cell can pass on that much excess.
        const std::int64_t sum = std::int64_t{network.terminal_capacities[neighbor]} +
                                 std::int64_t{network.arc_capacities[cell][slot]};
        network.terminal_capacities[neighbor] = static_cast<std::int32_t>(
            std::min<std::int64_t>(sum, std::numeric_limits<std::int32_t>::max()));
        network.arc_capacities[cell][slot] = 0;
        network.arc_capacities[neighbor][mesh.mirror(cell, slot)] = 0;
    }
}

/// The cells that are certainly outside: infinite cells, and cells that contain views.
std::vector<Index> source_cells(const TetMesh& mesh, const std::vector<Index>& cells_of_views)
{
    auto sources = parallel_collect<Index>(mesh.cells.size(), [&](std::size_t i, auto& infinite) {
        if (mesh.cells[i].is_infinite()) infinite.push_back(static_cast<Index>(i));
    });
    std::copy_if(cells_of_views.begin(), cells_of_views.end(), std::back_inserter(sources),
                 [](Index cell) { return cell != kInfinite; });
    return sources;
}

void pin_outside(const TetMesh& mesh, const std::vector<Index>& sources, FlowNetwork& network)
{
    for (const Index cell : sources) {
        give_to_source(mesh, cell, network);
    }
    // A source cell may have received flow from another. It cannot leave and means nothing.
    for (const Index cell : sources) {
        network.terminal_capacities[cell] = 0;
    }
}

} // namespace

FlowNetwork cut_network(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options)
{
    add_facet_costs(cells, facet_costs(cells, options.quality * energy.unit), energy.network);
    pin_outside(cells, source_cells(cells, energy.cell_of_view), energy.network);
    return std::move(energy.network);
}

Labels cut(const TetMesh& cells, VisibilityEnergy energy, const CutOptions& options,
           const Progress& progress)
{
    FlowNetwork network = cut_network(cells, std::move(energy), options);
    progress.report(0.2);
    return minimum_cut(cells, std::move(network), {}, progress.part(0.2, 1.0));
}

CutCells cut_cells(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
                   const LabelOptions& options, const Progress& progress)
{
    const std::vector<Index> uncrossed = uncrossed_hull_cells(cells, energy.network);
    CutCells made;
    made.labels = cut(cells, std::move(energy), options.cut, progress);
    made.inside = std::ranges::count(made.labels, Label::inside);
    made.on_hull = continue_along_hull(cells, scene, uncrossed, options.hull, made.labels);
    return made;
}

Labels carve(const TetMesh& cells, const Crossings& crossings, int min_crossings)
{
    Labels labels(cells.cells.size(), Label::inside);
    parallel_for(labels.size(), [&](std::size_t i) {
        const bool is_redundant =
            std::any_of(crossings[i].begin(), crossings[i].end(), [&](std::uint32_t count) {
                return count >= static_cast<std::uint32_t>(min_crossings);
            });
        if (is_redundant || cells.cells[i].is_infinite()) {
            labels[i] = Label::outside;
        }
    });
    return labels;
}

} // namespace vcarve
