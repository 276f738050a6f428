#include "baselines/alpha_shape.h"
#include "baselines/sculpt.h"
#include "mesh/check.h"
#include "steps/3_cells/triangulate.h"
#include "steps/6_surface/carve_surface.h"
#include "support/random_cells.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace vcarve::sculpt_test {
namespace {

using Edge = std::pair<Index, Index>;

/// The vertices and edges of the boundary, collected from all facets.
struct Boundary {
    std::set<Index> vertices;
    std::set<Edge> edges;

    Boundary(const TetMesh& cells, const Labels& labels)
    {
        for (Index cell = 0; cell < labels.size(); ++cell) {
            for (int slot = 0; slot < 4; ++slot) {
                const Index neighbor = cells.cells[cell].neighbors[slot];
                if (labels[cell] == Label::inside && labels[neighbor] == Label::outside) {
                    add(cells.cells[cell], slot);
                }
            }
        }
    }

    void add(const Cell& cell, int slot)
    {
        for (int i = 0; i < 4; ++i) {
            if (i != slot) vertices.insert(cell.vertices[i]);
            for (int j = 0; j < 4; ++j) {
                if (i != slot && j != slot) edges.insert({cell.vertices[i], cell.vertices[j]});
            }
        }
    }
};

/// The height of the circumsphere above the boundary facets, if the cell may be removed.
std::optional<double> bulge(const TetMesh& cells, const Labels& labels, const Boundary& boundary,
                            Index index)
{
    const Cell& cell = cells.cells[index];
    const Circumsphere sphere = circumsphere(cells, index);
    std::vector<Index> opposite;
    double farthest = 0.0;
    for (int slot = 0; slot < 4; ++slot) {
        if (labels[cell.neighbors[slot]] == Label::inside) continue;
        opposite.push_back(cell.vertices[slot]);
        // The far side of the sphere, from its center away from the opposite vertex.
        const auto corner = [&](int i) { return cells.positions[cell.vertices[(slot + i) % 4]]; };
        Eigen::Vector3d normal = (corner(2) - corner(1)).cross(corner(3) - corner(1)).normalized();
        if (normal.dot(corner(0) - corner(1)) > 0.0) normal = -normal;
        const Eigen::Vector3d far_end = sphere.center + sphere.radius * normal;
        farthest = std::max(farthest, normal.dot(far_end - corner(1)));
    }
    const bool one = opposite.size() == 1 && !boundary.vertices.contains(opposite[0]);
    const bool two = opposite.size() == 2 && !boundary.edges.contains({opposite[0], opposite[1]});
    return one || two ? std::optional(farthest) : std::nullopt;
}

Labels sculpt_slowly(const TetMesh& cells)
{
    Labels labels(cells.cells.size(), Label::inside);
    for (Index cell = 0; cell < labels.size(); ++cell) {
        if (cells.cells[cell].is_infinite()) labels[cell] = Label::outside;
    }
    while (true) {
        const Boundary boundary(cells, labels);
        if (boundary.vertices.size() == cells.positions.size()) return labels;
        double farthest = -1.0;
        Index next = kInfinite;
        for (Index cell = 0; cell < labels.size(); ++cell) {
            if (labels[cell] == Label::outside) continue;
            const auto value = bulge(cells, labels, boundary, cell);
            if (value && *value > farthest) {
                farthest = *value;
                next = cell;
            }
        }
        if (next == kInfinite) return labels;
        labels[next] = Label::outside;
    }
}

TEST(Sculpt, RemovesTheSameCellsAsAnExhaustiveSearch)
{
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        const TetMesh cells = triangulate(testing::random_points(40, seed));
        const Labels labels = sculpt(cells);
        EXPECT_EQ(labels, sculpt_slowly(cells)) << "seed " << seed;
        EXPECT_LT(
            std::ranges::count(labels, Label::inside),
            std::ranges::count_if(cells.cells, [](const Cell& c) { return !c.is_infinite(); }));
    }
}

TEST(Sculpt, KeepsTheBoundaryASphere)
{
    const Scene scene = testing::random_points(300, 5);
    const TetMesh cells = triangulate(scene);
    const MeshCheck check = check_mesh(extract_surface(cells, sculpt(cells), scene));
    EXPECT_TRUE(check.is_closed());
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.components, 1);
    EXPECT_EQ(check.euler_characteristic, 2);
}

TEST(Sculpt, DoesNotChangeAConvexCloud)
{
    Scene scene = testing::random_points(50, 6);
    for (Eigen::Vector3d& position : scene.positions) {
        position = (position - Eigen::Vector3d::Constant(0.5)).normalized();
    }
    const TetMesh cells = triangulate(scene);
    const Labels labels = sculpt(cells);
    for (Index cell = 0; cell < labels.size(); ++cell) {
        EXPECT_EQ(labels[cell] == Label::outside, cells.cells[cell].is_infinite());
    }
}

TEST(Sculpt, OpensADent)
{
    // A cube and a point below the center of its top: the cells between the two are removed.
    Scene scene = testing::random_points(9, 1);
    for (std::size_t i = 0; i < 8; ++i) {
        const double tilt = 1e-3 * static_cast<double>(i);
        scene.positions[i] = {static_cast<double>(i & 1U) + tilt,
                              static_cast<double>((i >> 1U) & 1U),
                              static_cast<double>(i >> 2U) + tilt * tilt};
    }
    scene.positions[8] = {0.5, 0.5, 0.9};
    const TetMesh cells = triangulate(scene);
    const TriMesh surface = extract_surface(cells, sculpt(cells), scene);
    EXPECT_EQ(check_mesh(surface).vertices, 9);
    EXPECT_EQ(check_mesh(surface).faces, 14);
}

} // namespace
} // namespace vcarve::sculpt_test
