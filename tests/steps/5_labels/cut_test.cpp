#include "steps/1_points/spatial_sort.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/trace.h"
#include "steps/5_labels/cut.h"
#include "support/cast_sights.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace vcarve::cut_test {
namespace {

using Eigen::Vector3d;

/// VisibilityEnergy that say nothing, with no view's cell known.
VisibilityEnergy silence(const TetMesh& mesh)
{
    VisibilityEnergy energy;
    energy.unit = 256;
    energy.network.arc_capacities.assign(mesh.cells.size(), {0, 0, 0, 0});
    energy.network.terminal_capacities.assign(mesh.cells.size(), 0);
    return energy;
}

/// Two tetrahedra on one triangle: the apexes of a bipyramid at +-height.
TetMesh bipyramid(double height)
{
    return triangulate(make_scene({{9, 9, 9}}, {{{1, 0, 0}, {0}},
                                                {{-0.5, 0.8, 0}, {0}},
                                                {{-0.5, -0.8, 0}, {0}},
                                                {{0, 0, height}, {0}},
                                                {{0, 0, -height}, {0}}}));
}

std::vector<Index> finite_cells(const TetMesh& mesh)
{
    std::vector<Index> finite;
    for (Index i = 0; i < mesh.cells.size(); ++i) {
        if (!mesh.cells[i].is_infinite()) {
            finite.push_back(i);
        }
    }
    return finite;
}

TEST(Cut, LeavesEverythingOutsideWithoutEvidence)
{
    const TetMesh mesh = triangulate(spatial_sort(bumpy_sphere(300, 31)));
    const Labels labels = cut(mesh, silence(mesh), {});
    EXPECT_EQ(labels, Labels(mesh.cells.size(), Label::outside));
}

TEST(Cut, PutsACellInsideWhenItsVoteOutweighsItsFacets)
{
    const TetMesh mesh = bipyramid(2.0);
    ASSERT_EQ(finite_cells(mesh).size(), 2U);
    const Index chosen = finite_cells(mesh)[0];
    VisibilityEnergy energy = silence(mesh);
    energy.network.terminal_capacities[chosen] = -100 * energy.unit;
    // The other cell stays outside: a border through the triangle between the two costs 0.38 of a
    // sight by the angle of its spheres, one through the other cell's three facets 0.73 to 0.78
    // each.
    Labels expected(mesh.cells.size(), Label::outside);
    expected[chosen] = Label::inside;
    EXPECT_EQ(cut(mesh, energy, {}), expected);

    // Facets that cost more than the sink capacity make it not worth while.
    EXPECT_EQ(cut(mesh, energy, {.quality = 1000.0}), Labels(mesh.cells.size(), Label::outside));
}

TEST(Cut, NeverPutsAViewsCellInside)
{
    const TetMesh mesh = bipyramid(2.0);
    const Index chosen = finite_cells(mesh)[0];
    VisibilityEnergy energy = silence(mesh);
    energy.network.terminal_capacities[chosen] = -100 * energy.unit;
    energy.cell_of_view = {chosen};
    EXPECT_EQ(cut(mesh, energy, {})[chosen], Label::outside);
}

TEST(Cut, LetsOnlyTheSightsDecideWithoutQuality)
{
    const TetMesh mesh = bipyramid(0.3);
    const auto finite = finite_cells(mesh);
    VisibilityEnergy energy = silence(mesh);
    energy.network.terminal_capacities[finite[1]] = -1; // the smallest term there is
    const Labels labels = cut(mesh, energy, {.quality = 0.0});
    EXPECT_EQ(labels[finite[0]], Label::outside);
    EXPECT_EQ(labels[finite[1]], Label::inside);
}

TEST(Cut, NeverPutsAnInfiniteCellInside)
{
    const Scene scene = spatial_sort(bumpy_sphere(1000, 32));
    const TetMesh mesh = triangulate(scene);
    Log silent;
    Stage stage(silent, "");
    const Labels labels = cut(mesh, energy_of(mesh, scene, {}), {});
    std::int64_t inside = 0;
    for (Index i = 0; i < mesh.cells.size(); ++i) {
        inside += labels[i] == Label::inside;
        ASSERT_FALSE(mesh.cells[i].is_infinite() && labels[i] == Label::inside);
    }
    EXPECT_GT(inside, static_cast<std::int64_t>(mesh.cells.size() / 4));
}

} // namespace
} // namespace vcarve::cut_test
