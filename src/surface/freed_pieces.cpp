#include "surface/freed_pieces.h"

#include "base/parallel.h"
#include "surface/face_evidence.h"
#include "surface/union_find.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The cells that became free, ascending, and which piece each belongs to.
class FreedPieces {
  public:
    FreedPieces(const TetMesh& cells, const Labels& before, const Labels& after)
        : freed_(parallel_collect<Index>(cells.cells.size(),
                                         [&](std::size_t cell, auto& freed) {
                                             if (before[cell] == Label::inside &&
                                                 after[cell] == Label::outside)
                                                 freed.push_back(static_cast<Index>(cell));
                                         })),
          pieces_(freed_.size())
    {
        parallel_for(freed_.size(), [&](std::size_t i) {
            for (const Index neighbor : cells.cells[freed_[i]].neighbors) {
                const bool is_freed =
                    before[neighbor] == Label::inside && after[neighbor] == Label::outside;
                if (is_freed) pieces_.join(static_cast<std::uint32_t>(i), number_of(neighbor));
            }
        });
    }

    const std::vector<Index>& cells() const { return freed_; }

    /// The number of the piece that holds the i-th freed cell, below cells().size().
    std::uint32_t piece(std::uint32_t i) { return pieces_.root(i); }

    /// Which of the freed cells a freed cell is.
    std::uint32_t number_of(Index cell) const
    {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(freed_, cell) - freed_.begin());
    }

  private:
    std::vector<Index> freed_;
    UnionFind pieces_;
};

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

/// A freed cell, by its number, and the worth of a face of it.
struct CellWorth {
    std::uint32_t cell;
    double worth;
};

/// The worth of each face of `boundary` that belongs to a freed cell: freed_cell(facet) tells
/// which, or kInfinite.
template <typename FreedCell>
std::vector<CellWorth> worths(const TetMesh& cells, const Scene& scene, const Boundary& boundary,
                              const FreedPieces& pieces, const FreedCell& freed_cell)
{
    return parallel_collect<CellWorth>(
        boundary.facets().size(), [&](std::size_t face, auto& found) {
            const Index cell = freed_cell(boundary.facets()[face]);
            if (cell == kInfinite) return;
            found.push_back({pieces.number_of(cell), worth(cells, scene, boundary, face)});
        });
}

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

std::vector<Index> unpaid_cells(const TetMesh& cells, const Scene& scene,
                                const BoundedLabels& before, const BoundedLabels& after)
{
    FreedPieces pieces(cells, before.labels, after.labels);
    if (pieces.cells().empty()) return {};
    const auto freed_inner = [&](const CellFacet& facet) {
        return after.labels[facet.cell] == Label::outside ? facet.cell : kInfinite;
    };
    const auto freed_outer = [&](const CellFacet& facet) {
        const Index outer = cells.cells[facet.cell].neighbors[facet.slot];
        return before.labels[outer] == Label::inside ? outer : kInfinite;
    };
    std::vector<double> gains(pieces.cells().size(), 0.0); // of pieces, at their numbers
    for (const auto& [cell, worth] : worths(cells, scene, before.boundary, pieces, freed_inner)) {
        gains[pieces.piece(cell)] -= worth;
    }
    for (const auto& [cell, worth] : worths(cells, scene, after.boundary, pieces, freed_outer)) {
        gains[pieces.piece(cell)] += worth;
    }
    std::vector<Index> unpaid;
    for (std::uint32_t i = 0; i < pieces.cells().size(); ++i) {
        if (gains[pieces.piece(i)] < 0.0) unpaid.push_back(pieces.cells()[i]);
    }
    return unpaid;
}

} // namespace vcarve
