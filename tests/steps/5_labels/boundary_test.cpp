#include "steps/5_labels/boundary.h"
#include "steps/5_labels/labelling.h"
#include "support/made_cells.h"
#include "support/point_sets.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using testing::labels_where;

using FacetList = std::vector<std::pair<Index, int>>;

FacetList list(const std::vector<CellFacet>& facets)
{
    FacetList all;
    for (const CellFacet& facet : facets) {
        all.emplace_back(facet.cell, facet.slot);
    }
    return all;
}

FacetList facets_at(const Boundary& boundary, Index vertex)
{
    std::vector<CellFacet> facets;
    for (const std::uint32_t face : boundary.edges().faces_at()[vertex]) {
        EXPECT_TRUE(boundary.is_there(face));
        facets.push_back(boundary.facets()[face]);
    }
    return list(facets);
}

/// All that is asked of a boundary, which must be the same of both, to the last bit.
void expect_same(const TetMesh& mesh, const Boundary& updated, const Boundary& fresh)
{
    constexpr double kUnknown = -2.0;
    ASSERT_EQ(list(updated.facets_in_order()), list(fresh.facets()));
    EXPECT_EQ(list(fresh.facets_in_order()), list(fresh.facets()));
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        ASSERT_EQ(facets_at(updated, vertex), facets_at(fresh, vertex));
        EXPECT_EQ(updated.edges().median(vertex), fresh.edges().median(vertex));
        EXPECT_EQ(updated.normals().at(vertex), fresh.normals().at(vertex));
    }
    for (std::uint32_t i = 0; i < fresh.faces().size(); ++i) {
        const auto face = static_cast<std::uint32_t>(updated.number_of(fresh.facets()[i]));
        EXPECT_TRUE(updated.is_there(face));
        EXPECT_EQ(updated.faces()[face], fresh.faces()[i]);
        EXPECT_EQ(updated.edges().relative_size(face), fresh.edges().relative_size(i));
        EXPECT_EQ(updated.normals().cosines(face, kUnknown), fresh.normals().cosines(i, kUnknown));
    }
}

/// Some finite cells, a few of them twice.
std::vector<Index> some_cells(const TetMesh& mesh, std::size_t count, std::mt19937_64& random)
{
    std::vector<Index> cells;
    while (cells.size() < count) {
        const auto cell = static_cast<Index>(pick(random, mesh.cells.size()));
        if (mesh.cells[cell].is_infinite()) continue;
        cells.push_back(cell);
        if (pick(random, 8) == 0) cells.push_back(cell);
    }
    return cells;
}

TEST(Boundary, UpdatedIsAsExtractedAnew)
{
    std::mt19937_64 random(17);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const TetMesh mesh = triangulation_of(random_points(60, seed));
        Labels labels = labels_where(mesh, [&](Index) { return pick(random, 10) < seed % 10; });
        Boundary boundary(mesh, labels);
        expect_same(mesh, boundary, {mesh, labels});
        for (int change = 0; change < 8; ++change) {
            const std::size_t count = pick(random, 2) == 0 ? 1 : pick(random, mesh.cells.size());
            const std::vector<Index> cells = some_cells(mesh, count, random);
            for (const Index cell : cells) {
                labels[cell] = pick(random, 2) == 0 ? Label::inside : Label::outside;
            }
            boundary.update(labels, cells);
            expect_same(mesh, boundary, {mesh, labels});
        }
    }
}

TEST(Boundary, FacesComeBackByTheirNumbers)
{
    std::mt19937_64 random(18);
    const TetMesh mesh = triangulation_of(random_points(60, 3));
    const Labels before = labels_where(mesh, [&](Index) { return pick(random, 2) == 0; });
    Labels labels = before;
    Boundary boundary(mesh, before);
    const FacetList facets = list(boundary.facets());
    const std::vector<Index> cells = some_cells(mesh, 10, random);
    std::size_t num_ever = 0;
    for (int time = 0; time < 3; ++time) {
        for (const Index cell : cells) {
            labels[cell] = before[cell] == Label::inside ? Label::outside : Label::inside;
        }
        boundary.update(labels, cells);
        EXPECT_GT(boundary.facets().size(), facets.size());
        if (time == 0) num_ever = boundary.facets().size();
        EXPECT_EQ(boundary.facets().size(), num_ever);
        labels = before;
        boundary.update(labels, cells);
    }
    for (std::uint32_t face = 0; face < num_ever; ++face) {
        EXPECT_EQ(boundary.is_there(face), face < facets.size());
    }
    EXPECT_EQ(list(boundary.facets_in_order()), facets);
}

TEST(Boundary, OfALabellingFollowsWhatIsSet)
{
    std::mt19937_64 random(19);
    const TetMesh mesh = triangulation_of(random_points(200, 4));
    Labelling labelling(mesh, labels_where(mesh, [&](Index) { return pick(random, 3) > 0; }));
    const Boundary& boundary = labelling.boundary();
    for (int time = 0; time < 5; ++time) {
        labelling.set(some_cells(mesh, 20, random), time % 2 == 0 ? Label::outside : Label::inside);
        EXPECT_EQ(&labelling.boundary(), &boundary);
        expect_same(mesh, labelling.boundary(), {mesh, labelling.labels()});
        EXPECT_EQ(list(labelling.facets()), list(boundary_facets(mesh, labelling.labels())));
    }
}

} // namespace
} // namespace vcarve
