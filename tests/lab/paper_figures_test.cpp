#include "figures/figures.h"
#include "figures/timed_object.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace vcarve::paper::paper_figures_test {
namespace {

PaperCase paper_case(const std::string& name)
{
    return read_case(fixtures_folder() / "paper", name);
}

TEST(PaperFigures, OnlyTheTrueSolidIsExact)
{
    const TriMesh solid = paper_case("desk").solid;
    EXPECT_TRUE(is_exact(solid, solid));
    TriMesh other_order = solid;
    std::ranges::reverse(other_order.faces);
    Face& first = other_order.faces.front();
    std::rotate(first.begin(), first.begin() + 1, first.end());
    EXPECT_TRUE(is_exact(other_order, solid));
    TriMesh turned = solid;
    std::swap(turned.faces.front()[0], turned.faces.front()[1]);
    EXPECT_FALSE(is_exact(turned, solid));
    TriMesh torn = solid;
    torn.faces.pop_back();
    EXPECT_FALSE(is_exact(torn, solid));
    TriMesh moved = solid;
    moved.positions.front().x() += 1e-9;
    EXPECT_FALSE(is_exact(moved, solid));
}

TEST(PaperFigures, SevenViewsOpenTheCubiclesAndFourDoNot)
{
    const Json figure = recovered_in_states(paper_case("cubicles"));
    EXPECT_TRUE(figure["exact"]);
    EXPECT_EQ(figure["states"][0]["views"], 4);
    EXPECT_FALSE(figure["states"][0]["exact"]);
    EXPECT_EQ(figure["states"][1]["views"], 7);
    EXPECT_TRUE(figure["states"][1]["exact"]);
}

TEST(PaperFigures, SculptingFirstRemovesASolidCell)
{
    EXPECT_TRUE(sculpted(paper_case("boissonnat"))["first_is_solid"]);
}

TEST(PaperFigures, UncrossedTrianglesAreNotOnTheSurface)
{
    const PaperCase cube = paper_case("cube_with_cavity");
    const Json figure = unmet_triangles(cube);
    EXPECT_EQ(figure["left"], 0); // two views are enough
    EXPECT_GT(figure["unmet"], 0);
    EXPECT_EQ(figure["tetrahedra"].size(), cube.solid.faces.size());
    EXPECT_EQ(figure["triangles"].size(),
              cube.solid.faces.size() + figure["unmet"].get<std::size_t>());
    for (const Json& rays : figure["pair_rays"]) {
        EXPECT_FALSE(rays.empty()); // so both adjacent cells are carved
    }
}

TEST(PaperFigures, AWrongRayDrillsATunnelWithTheStrictMethodOnly)
{
    const Json figure = drilled(paper_case("boissonnat"));
    EXPECT_GT(figure["strict"]["lost"], 10);
    EXPECT_EQ(figure["cut"]["lost"], 0);
    EXPECT_EQ(figure["cut"]["kept"], 0);
}

TEST(PaperFigures, HullFacetsHaveNoCellBeyond)
{
    const PaperCase cube = paper_case("cube_with_cavity");
    for (const Json& facet : panel(cube.cells, hull(cube.cells, "hull"))) {
        EXPECT_EQ(facet[3], "hull");
        EXPECT_FALSE(cube.cells.cells[facet[4].get<Index>()].is_infinite());
        EXPECT_EQ(facet[5], -1);
    }
}

TEST(TimedObject, HasTheRequestedPointsAndViewpoints)
{
    for (const std::size_t points : {kPapersPoints, std::size_t{1000}}) {
        const Scene few = timed_object(points, 7);
        const Scene many = timed_object(points, 23);
        EXPECT_EQ(few.num_points(), points);
        EXPECT_EQ(few.views.size(), 7U);
        EXPECT_EQ(many.positions, few.positions);
        EXPECT_GT(many.num_rays(), 2 * few.num_rays());
        for (std::size_t view = 0; view < few.views.size(); ++view) {
            EXPECT_EQ(many.views[view].center, few.views[view].center);
        }
    }
}

} // namespace
} // namespace vcarve::paper::paper_figures_test
