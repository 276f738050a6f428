#include "compare/evidence.h"
#include "support/measured_scenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace vcarve::evidence_test {
namespace {

using testing::few_samples;
using testing::high_centers;
using testing::scene_above_square;
using testing::square;
using testing::strip;
using testing::together;

/// 11 x 11 points at a step of 0.1. The 6th nearest of an inner point lies a diagonal step away, so
/// the median spacing is sqrt(2) / 10.
Reference grid_reference()
{
    return make_reference(scene_above_square(11, high_centers()), nullptr, few_samples());
}

EvidenceFigures figures_of(const TriMesh& mesh, const Reference& reference)
{
    return measure_against_views(place_mesh({"a.ply", mesh}, reference), reference);
}

TEST(Evidence, FindsNoFaultInTheTrueSurface)
{
    const EvidenceFigures figures = figures_of(square(), grid_reference());
    EXPECT_EQ(figures.hidden_sights, 0.0);
    EXPECT_EQ(figures.missed_points, 0.0);
    EXPECT_EQ(figures.unsupported_area, 0.0);
    EXPECT_NEAR(figures.median_distance, 0.0, 1e-12);
}

TEST(Evidence, CountsSightsBehindAScreen)
{
    // The screen hangs half way up. A sight to a view at x = 0.2 meets it where x / 2 + 0.1 <=
    // 0.26, for 4 of the 11 columns; one to a view at x = 0.8 where x / 2 + 0.4 <= 0.26, for none.
    const TriMesh screened = together(square(), strip(-1.0, 0.26, 5.0));
    const EvidenceFigures figures = figures_of(screened, grid_reference());
    EXPECT_DOUBLE_EQ(figures.hidden_sights, 0.5 * 4.0 / 11.0);
}

TEST(Evidence, TakesWhatPassesNearAPointForItsSurface)
{
    // Spacings are 0.141 within the grid, 0.224 at its corners: 3 of them are 0.42 to 0.67.
    EXPECT_EQ(figures_of(square(0.4), grid_reference()).hidden_sights, 0.0);
    EXPECT_EQ(figures_of(square(1.0), grid_reference()).hidden_sights, 1.0);
}

TEST(Evidence, CountsPointsFarFromTheMesh)
{
    // No point is farther from the strip than 0.35; 3 spacings are 0.42 and more.
    const EvidenceFigures none = figures_of(strip(0.0, 0.65, 0.0), grid_reference());
    EXPECT_EQ(none.missed_points, 0.0);
    EXPECT_EQ(figures_of(square(-1.0), grid_reference()).missed_points, 1.0);
}

TEST(Evidence, MeasuresTheMedianDistanceInSpacings)
{
    const EvidenceFigures figures = figures_of(square(-0.1), grid_reference());
    EXPECT_NEAR(figures.median_distance, 1.0 / std::sqrt(2.0), 1e-12);
}

TEST(Evidence, FindsNoSupportForAFaceSeenFromBehind)
{
    EXPECT_EQ(figures_of(testing::flipped(square()), grid_reference()).unsupported_area, 1.0);
}

TEST(Evidence, FindsNoSupportForAFaceBehindAnother)
{
    const TriMesh stacked = together(square(), square(-0.5));
    EXPECT_NEAR(figures_of(stacked, grid_reference()).unsupported_area, 0.5, 1e-3);
}

TEST(Evidence, FindsNoSupportOutsideTheImages)
{
    // Cameras 10 above that show 0.5 to either side of what lies right under them. 2500 samples by
    // area give a share to within 0.01, one standard deviation.
    Scene scene = scene_above_square(11, {{0.5, 0.5, 10.0}, {0.5, 0.5, 10.0}});
    scene.cameras[0] = testing::square_camera(100, 0.05);
    const Reference reference = make_reference(scene, nullptr, few_samples());
    EXPECT_NEAR(figures_of(strip(0.0, 4.0, 0.0), reference).unsupported_area, 0.75, 0.02);
}

TEST(Evidence, CountsBoundaryEdgesInPlainSight)
{
    const Reference reference = grid_reference();
    // The diagonal is no boundary; from which side the rim is seen plays no part.
    EXPECT_EQ(figures_of(square(), reference).seen_boundary_edges, 4);
    EXPECT_EQ(figures_of(testing::flipped(square()), reference).seen_boundary_edges, 4);
    EXPECT_EQ(figures_of(testing::cube(), reference).seen_boundary_edges, 0);
    // A screen hides the square from all views, whichever side it turns to them.
    const TriMesh screen = strip(-1.0, 2.0, 1.0);
    EXPECT_EQ(figures_of(together(square(), screen), reference).seen_boundary_edges, 4);
    const TriMesh turned = testing::flipped(screen);
    EXPECT_EQ(figures_of(together(square(), turned), reference).seen_boundary_edges, 4);
    // Over more than half of the square it leaves one edge in sight.
    const TriMesh half = strip(0.4, 2.0, 1.0);
    EXPECT_EQ(figures_of(together(square(), half), reference).seen_boundary_edges, 4 + 1);
}

TEST(Evidence, CountsNoBoundaryEdgesOutsideTheImages)
{
    // The images show 0.25 to either side of the middle.
    Scene scene = scene_above_square(11, {{0.5, 0.5, 10.0}, {0.5, 0.5, 10.0}});
    scene.cameras[0] = testing::square_camera(100, 0.025);
    const Reference reference = make_reference(scene, nullptr, few_samples());
    EXPECT_EQ(figures_of(square(), reference).seen_boundary_edges, 0);
    EXPECT_EQ(figures_of(strip(0.4, 1.0, 0.0), reference).seen_boundary_edges, 1);
    EXPECT_EQ(figures_of(strip(0.4, 0.6, 0.0), reference).seen_boundary_edges, 2);
}

TEST(Evidence, SamplesTheSightsWhereThereAreMore)
{
    CompareOptions options;
    options.samples = 10000;
    // 14,641 points of 4 views each.
    const Reference reference =
        make_reference(scene_above_square(121, high_centers()), nullptr, options);
    const TriMesh screened = together(square(), strip(-1.0, 0.26, 5.0));
    // x / 2 + 0.1 <= 0.26 holds for 39 of 121 columns.
    EXPECT_NEAR(figures_of(screened, reference).hidden_sights, 0.5 * 39.0 / 121.0, 0.005);
}

TEST(Evidence, DoesNotDependOnUnitOrPlace)
{
    const Scene scene = scene_above_square(11, high_centers());
    const TriMesh mesh = together(strip(0.0, 0.5, 0.31), strip(-1.0, 0.26, 5.0));
    const EvidenceFigures figures = figures_of(mesh, make_reference(scene, nullptr, few_samples()));
    for (const double factor : {1e-3, 1e6}) {
        Scene other = scene;
        const Eigen::Vector3d shift = factor * Eigen::Vector3d(5e5, 4.6e6, 100);
        for (Eigen::Vector3d& position : other.positions) {
            position = position * factor + shift;
        }
        for (View& view : other.views) {
            view.center = view.center * factor + shift;
        }
        const TriMesh same = testing::moved(testing::scaled(mesh, factor), shift);
        const EvidenceFigures there =
            figures_of(same, make_reference(other, nullptr, few_samples()));
        EXPECT_DOUBLE_EQ(there.hidden_sights, figures.hidden_sights);
        EXPECT_DOUBLE_EQ(there.missed_points, figures.missed_points);
        EXPECT_NEAR(there.unsupported_area, figures.unsupported_area, 2e-3);
        EXPECT_NEAR(there.median_distance, figures.median_distance, 1e-6);
    }
}

TEST(Evidence, IsTheSameForAnyNumberOfThreads)
{
    const TriMesh mesh = testing::random_soup(100, 5);
    const EvidenceFigures many = figures_of(mesh, grid_reference());
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const EvidenceFigures alone = figures_of(mesh, grid_reference());
    EXPECT_EQ(alone.hidden_sights, many.hidden_sights);
    EXPECT_EQ(alone.missed_points, many.missed_points);
    EXPECT_EQ(alone.unsupported_area, many.unsupported_area);
    EXPECT_EQ(alone.median_distance, many.median_distance);
    EXPECT_EQ(alone.seen_boundary_edges, many.seen_boundary_edges);
    EXPECT_GT(many.seen_boundary_edges, 0);
}

} // namespace
} // namespace vcarve::evidence_test
