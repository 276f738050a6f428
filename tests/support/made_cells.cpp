#include "support/made_cells.h"

#include <algorithm>

namespace vcarve::testing {

using Eigen::Vector3d;

Vector3d middle(const TetMesh& mesh, Index cell)
{
    Vector3d sum = Vector3d::Zero();
    for (const Index vertex : mesh.cells[cell].vertices) {
        sum += mesh.positions[vertex];
    }
    return sum / 4.0;
}

Vector3d middle(const TetMesh& mesh, const CellFacet& facet)
{
    Vector3d sum = Vector3d::Zero();
    for (const int corner : kFacetCorners[facet.slot]) {
        sum += mesh.positions[mesh.cells[facet.cell].vertices[corner]];
    }
    return sum / 3.0;
}

Index cell_of(const TetMesh& mesh, const std::array<Index, 4>& corners)
{
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (std::ranges::is_permutation(mesh.cells[cell].vertices, corners)) return cell;
    }
    return kInfinite;
}

CellFacet facet_across(const TetMesh& mesh, Index cell, Index corner)
{
    const auto& vertices = mesh.cells[cell].vertices;
    return {cell, static_cast<int>(std::ranges::find(vertices, corner) - vertices.begin())};
}

Labels labels_where(const TetMesh& mesh, const std::function<bool(Index)>& is_inside)
{
    Labels labels(mesh.cells.size(), Label::outside);
    for (Index cell = 0; cell < labels.size(); ++cell) {
        if (!mesh.cells[cell].is_infinite() && is_inside(cell)) labels[cell] = Label::inside;
    }
    return labels;
}

Labels solid(const TetMesh& mesh)
{
    return labels_where(mesh, [](Index) { return true; });
}

void aim(View& view, const Vector3d& place)
{
    view.cam_from_world =
        Eigen::Quaterniond::FromTwoVectors(place - view.center, Vector3d::UnitZ());
}

void forget(Scene& scene, const std::set<Index>& points)
{
    Tracks tracks;
    for (Index point = 0; point < scene.num_points(); ++point) {
        const bool is_forgotten = points.contains(point);
        tracks.push_back(is_forgotten ? std::span<const std::uint32_t>() : scene.tracks[point]);
    }
    scene.tracks = std::move(tracks);
}

Positions triangular_lattice(int columns, int rows)
{
    Positions points;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            points.emplace_back(column + 0.5 * row, 0.875 * row, 0.0);
        }
    }
    return points;
}

} // namespace vcarve::testing
