#include "surface/freed_pieces.h"

#include "base/parallel.h"
#include "surface/face_evidence.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

namespace vcarve {

namespace {

using Eigen::Vector3d;

std::vector<Index> freed_cells(const TetMesh& cells, const Labels& before, const Labels& after)
{
    return parallel_collect<Index>(cells.cells.size(), [&](std::size_t cell, auto& freed) {
        if (before[cell] == Label::inside && after[cell] == Label::outside) {
            freed.push_back(static_cast<Index>(cell));
        }
    });
}

double area_of(const TetMesh& cells, const Face& face)
{
    const Vector3d& a = cells.positions[face[0]];
    return 0.5 * (cells.positions[face[1]] - a).cross(cells.positions[face[2]] - a).norm();
}

/// What a face is worth: its area by its plausibility and by how its corners were seen.
double worth(const TetMesh& cells, const Scene& scene, const Boundary& boundary, std::size_t face)
{
    constexpr double kDoubtful = 0.5;
    const Face& corners = boundary.faces()[face];
    const Vector3d normal = boundary.normals().of(face);
    const double area = area_of(cells, corners);
    if (is_seen(scene, corners, normal)) return area * plausibility(boundary, face);
    if (is_seen(scene, corners, -normal)) return -kDoubtful * area;
    return kDoubtful * area * plausibility(boundary, face);
}

/// A freed cell, by its place among them, and the worth of a face of it.
struct CellWorth {
    std::uint32_t cell;
    double worth;
};

} // namespace

double plausibility(const Boundary& boundary, std::size_t face)
{
    constexpr double kGoesOn = 0.8; // cosine, about 37 degrees
    constexpr double kNotKnown = -1.0;
    const auto cosines = boundary.normals().cosines(face, kNotKnown);
    const double size = boundary.edges().relative_size(face);
    double chance = 0.75 / (1.0 + size / 6.0); // goes on with the surface at one corner at most
    if (cosines[1] >= kGoesOn)
        chance = 1.0 / (1.0 + size * size / 144.0);
    else if (cosines[2] >= kGoesOn)
        chance = 0.85 / (1.0 + size * size / 225.0);
    return chance >= 0.0 ? chance : 0.0; // 0 where the size is not known
}

FreedPieces::FreedPieces(const TetMesh& cells, const Scene& scene, const Labels& before,
                         const Labels& after)
    : cells_(cells),
      scene_(scene),
      before_(before),
      after_(after),
      freed_(freed_cells(cells, before, after)),
      pieces_(freed_.size()),
      gains_(freed_.size(), 0.0)
{
    parallel_for(freed_.size(), [&](std::size_t i) {
        for (const Index neighbor : cells.cells[freed_[i]].neighbors) {
            const bool is_freed =
                before[neighbor] == Label::inside && after[neighbor] == Label::outside;
            if (is_freed) pieces_.join(static_cast<std::uint32_t>(i), number_of(neighbor));
        }
    });
}

/// Where a freed cell stands among them.
std::uint32_t FreedPieces::number_of(Index cell) const
{
    return static_cast<std::uint32_t>(std::ranges::lower_bound(freed_, cell) - freed_.begin());
}

/// Adds the worths of the faces of a boundary that belong to freed cells: freed_cell(facet) tells
/// which, or kInfinite.
template <typename FreedCell>
void FreedPieces::add_worths(const Boundary& boundary, double sign, const FreedCell& freed_cell)
{
    const std::vector<CellFacet>& facets = boundary.facets();
    const auto worths = parallel_collect<CellWorth>(facets.size(), [&](std::size_t i, auto& found) {
        const Index cell = freed_cell(facets[i]);
        if (cell == kInfinite) return;
        found.push_back({number_of(cell), worth(cells_, scene_, boundary, i)});
    });
    for (const auto& [cell, worth] : worths) {
        gains_[pieces_.root(cell)] += sign * worth;
    }
}

void FreedPieces::take_away(const Boundary& boundary_before)
{
    constexpr double kAtLeast = 0.9; // of what it takes away a piece must lay open
    add_worths(boundary_before, -kAtLeast, [&](const CellFacet& facet) {
        return after_[facet.cell] == Label::outside ? facet.cell : kInfinite;
    });
}

void FreedPieces::lay_open(const Boundary& boundary_after)
{
    add_worths(boundary_after, 1.0, [&](const CellFacet& facet) {
        const Index outer = cells_.other_side(facet).cell;
        return before_[outer] == Label::inside ? outer : kInfinite;
    });
}

std::vector<Index> FreedPieces::unpaid()
{
    std::vector<Index> unpaid;
    for (std::uint32_t i = 0; i < freed_.size(); ++i) {
        if (gains_[pieces_.root(i)] < 0.0) unpaid.push_back(freed_[i]);
    }
    return unpaid;
}

} // namespace vcarve
