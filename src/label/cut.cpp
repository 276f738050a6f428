#include "label/cut.h"

#include "base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using FacetCosts = std::vector<std::array<std::int32_t, 4>>;

/// 1 - cos of the angle between each facet of a cell and the sphere around the cell; 0 for infinite
/// cells.
std::array<double, 4> sphere_angle_costs(const TetMesh& mesh, const Cell& cell)
{
    if (cell.is_infinite()) {
        return {0.0, 0.0, 0.0, 0.0};
    }
    const Vector3d& origin = mesh.positions[cell.vertices[0]];
    const Vector3d a = mesh.positions[cell.vertices[1]] - origin;
    const Vector3d b = mesh.positions[cell.vertices[2]] - origin;
    const Vector3d c = mesh.positions[cell.vertices[3]] - origin;
    const double volume_6 = a.dot(b.cross(c));
    const Vector3d center = (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) +
                             c.squaredNorm() * a.cross(b)) /
                            (2.0 * volume_6);
    const std::array<Vector3d, 4> corners = {Vector3d::Zero(), a, b, c};
    std::array<double, 4> costs{};
    for (int slot = 0; slot < 4; ++slot) {
        const auto& [i, j, k] = kFacetCorners[slot];
        const Vector3d inward = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
        const Vector3d to_center = center - corners[i];
        const double cosine = inward.dot(to_center) / (inward.norm() * to_center.norm());
        constexpr double kUnknown = 0.5; // a cell too flat to have a sphere
        costs[slot] = std::isfinite(cosine) ? 1.0 - std::clamp(cosine, -1.0, 1.0) : kUnknown;
    }
    return costs;
}

/// What cutting each facet costs by its shape, in steps.
FacetCosts facet_costs(const TetMesh& mesh, double steps)
{
    FacetCosts costs(mesh.cells.size());
    parallel_for(costs.size(), [&](std::size_t i) {
        const auto angles = sphere_angle_costs(mesh, mesh.cells[i]);
        std::transform(angles.begin(), angles.end(), costs[i].begin(), [&](double cost) {
            return static_cast<std::int32_t>(std::lround(steps * cost));
        });
    });
    return costs;
}

/// Makes each facet cost the same from both sides: the worse of the two.
void add_facet_costs(const TetMesh& mesh, const FacetCosts& costs, FlowNetwork& network)
{
    parallel_for(mesh.cells.size(), [&](std::size_t i) {
        for (int slot = 0; slot < 4; ++slot) {
            const Index neighbor = mesh.cells[i].neighbors[slot];
            const int mirror = mesh.mirror(static_cast<Index>(i), slot);
            network.residuals[i][slot] += std::max(costs[i][slot], costs[neighbor][mirror]);
        }
    });
}

/// Takes a cell out of the network as part of the source: its arcs are full, its neighbours hold
/// what came.
void give_to_source(const TetMesh& mesh, Index cell, FlowNetwork& network)
{
    for (int slot = 0; slot < 4; ++slot) {
        const Index neighbor = mesh.cells[cell].neighbors[slot];
        // Held below the end of 32 bits: so much excess is more than any cell can pass on.
        const std::int64_t sum =
            std::int64_t{network.excesses[neighbor]} + std::int64_t{network.residuals[cell][slot]};
        constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
        network.excesses[neighbor] = static_cast<std::int32_t>(std::min(sum, kMost));
        network.residuals[cell][slot] = 0;
        network.residuals[neighbor][mesh.mirror(cell, slot)] = 0;
    }
}

/// The cells that are outside for certain: those that hold views, and the infinite ones.
std::vector<Index> source_cells(const TetMesh& mesh, const std::vector<Index>& cells_of_views)
{
    std::vector<Index> sources;
    std::copy_if(cells_of_views.begin(), cells_of_views.end(), std::back_inserter(sources),
                 [](Index cell) { return cell != kInfinite; });
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (mesh.cells[cell].is_infinite()) {
            sources.push_back(cell);
        }
    }
    return sources;
}

void pin_outside(const TetMesh& mesh, const std::vector<Index>& sources, FlowNetwork& network)
{
    for (const Index cell : sources) {
        give_to_source(mesh, cell, network);
    }
    // A source cell may have got flow from the next one; it has no way on and no meaning.
    for (const Index cell : sources) {
        network.excesses[cell] = 0;
    }
}

} // namespace

FlowNetwork cut_network(const TetMesh& cells, Votes votes, const CutOptions& options)
{
    add_facet_costs(cells, facet_costs(cells, options.quality * votes.unit), votes.network);
    pin_outside(cells, source_cells(cells, votes.cell_of_view), votes.network);
    return std::move(votes.network);
}

MinimumCut cut(const TetMesh& cells, Votes votes, const CutOptions& options)
{
    return MinimumCut(cells, cut_network(cells, std::move(votes), options));
}

} // namespace vcarve
