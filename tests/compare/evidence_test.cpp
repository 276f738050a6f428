#include "compare/evidence.h"
#include "support/made_cells.h"
#include "support/measured_scenes.h"
#include "support/scenes.h"
#include "vcarve/reconstruct.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace vcarve::evidence_test {
namespace {

using testing::few_samples;
using testing::high_centers;
using testing::scene_above_square;
using testing::square;
using testing::strip;
using testing::together;

/// 11 x 11 points with a step of 0.1. The 6th nearest point of an inner point is a diagonal step
/// away, so the median spacing is sqrt(2) / 10.
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
    EXPECT_EQ(figures.hidden_rays, 0.0);
    EXPECT_EQ(figures.missed_points, 0.0);
    EXPECT_EQ(figures.unsupported_area, 0.0);
    EXPECT_NEAR(figures.median_distance, 0.0, 1e-12);
}

TEST(Evidence, CountsRaysBehindAScreen)
{
    // The screen is halfway up. Rays to views at x = 0.2 hit it if x / 2 + 0.1 <= 0.26: in 4 of
    // the 11 columns. Rays to views at x = 0.8 hit it if x / 2 + 0.4 <= 0.26: never.
    const TriMesh screened = together(square(), strip(-1.0, 0.26, 5.0));
    const EvidenceFigures figures = figures_of(screened, grid_reference());
    EXPECT_DOUBLE_EQ(figures.hidden_rays, 0.5 * 4.0 / 11.0);
}

TEST(Evidence, IgnoresHitsNearThePoint)
{
    // Spacings are 0.141 inside the grid and 0.224 at its corners, so 3 spacings are 0.42 to 0.67.
    EXPECT_EQ(figures_of(square(0.4), grid_reference()).hidden_rays, 0.0);
    EXPECT_EQ(figures_of(square(1.0), grid_reference()).hidden_rays, 1.0);
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
    // Cameras at height 10 that show 0.5 to either side of the position below them. The fraction of
    // 2500 samples has a standard deviation of 0.01.
    Scene scene = scene_above_square(11, {{0.5, 0.5, 10.0}, {0.5, 0.5, 10.0}});
    scene.cameras[0] = testing::square_camera(100, 0.05);
    const Reference reference = make_reference(scene, nullptr, few_samples());
    EXPECT_NEAR(figures_of(strip(0.0, 4.0, 0.0), reference).unsupported_area, 0.75, 0.02);
}

TEST(Evidence, CountsSeenBoundaryEdges)
{
    const Reference reference = grid_reference();
    // The diagonal is no boundary. Boundary edges are seen from either side.
    EXPECT_EQ(figures_of(square(), reference).seen_boundary_edges, 4);
    EXPECT_EQ(figures_of(testing::flipped(square()), reference).seen_boundary_edges, 4);
    EXPECT_EQ(figures_of(testing::cube(), reference).seen_boundary_edges, 0);
    // A screen of either orientation hides the square from all views.
    const TriMesh screen = strip(-1.0, 2.0, 1.0);
    EXPECT_EQ(figures_of(together(square(), screen), reference).seen_boundary_edges, 4);
    const TriMesh turned = testing::flipped(screen);
    EXPECT_EQ(figures_of(together(square(), turned), reference).seen_boundary_edges, 4);
    // A screen over more than half of the square leaves one of its edges visible.
    const TriMesh half = strip(0.4, 2.0, 1.0);
    EXPECT_EQ(figures_of(together(square(), half), reference).seen_boundary_edges, 4 + 1);
}

TEST(Evidence, CountsNoBoundaryEdgesOutsideTheImages)
{
    // The images show 0.25 to either side of the center.
    Scene scene = scene_above_square(11, {{0.5, 0.5, 10.0}, {0.5, 0.5, 10.0}});
    scene.cameras[0] = testing::square_camera(100, 0.025);
    const Reference reference = make_reference(scene, nullptr, few_samples());
    EXPECT_EQ(figures_of(square(), reference).seen_boundary_edges, 0);
    EXPECT_EQ(figures_of(strip(0.4, 1.0, 0.0), reference).seen_boundary_edges, 1);
    EXPECT_EQ(figures_of(strip(0.4, 0.6, 0.0), reference).seen_boundary_edges, 2);
}

TEST(Evidence, SubsamplesRays)
{
    CompareOptions options;
    options.samples = 10000;
    // 14,641 points of 4 views each.
    const Reference reference =
        make_reference(scene_above_square(121, high_centers()), nullptr, options);
    const TriMesh screened = together(square(), strip(-1.0, 0.26, 5.0));
    // x / 2 + 0.1 <= 0.26 holds for 39 of 121 columns.
    EXPECT_NEAR(figures_of(screened, reference).hidden_rays, 0.5 * 39.0 / 121.0, 0.005);
}

TEST(Evidence, DoesNotDependOnScaleOrOffset)
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
        EXPECT_DOUBLE_EQ(there.hidden_rays, figures.hidden_rays);
        EXPECT_DOUBLE_EQ(there.missed_points, figures.missed_points);
        EXPECT_NEAR(there.unsupported_area, figures.unsupported_area, 2e-3);
        EXPECT_NEAR(there.median_distance, figures.median_distance, 1e-6);
    }
}

using testing::cube;
using testing::square_camera;

CompareOptions with_samples(int samples)
{
    CompareOptions options;
    options.samples = samples;
    return options;
}

/// Two views at the same position, 2 above the center of the unit cube's top, that look down. The
/// top fills 50 of the 100 px of their images. Each has 40 x 40 rays.
Reference reference_above_cube()
{
    Scene scene = testing::scene_above_square(11, {{0.5, 0.5, 3.0}, {0.5, 0.5, 3.0}});
    scene.cameras[0] = square_camera(100, 0.5);
    return make_reference(scene, nullptr, with_samples(4 * 2 * 1600));
}

TriMesh without_top(TriMesh mesh)
{
    mesh.faces.erase(mesh.faces.begin() + 2, mesh.faces.begin() + 4);
    return mesh;
}

TriMesh without_top_and_bottom(TriMesh mesh)
{
    mesh.faces.erase(mesh.faces.begin(), mesh.faces.begin() + 4);
    return mesh;
}

std::optional<RayFigures> ray_figures_of(const TriMesh& mesh, const Reference& reference)
{
    return measure_view_rays(place_mesh({"a.ply", mesh}, reference), reference);
}

TEST(ViewRays, PassThroughTheCentersOfAGrid)
{
    Scene scene = testing::scene_above_square(3, {{0.2, 0.3, 5.0}, {0.7, 0.1, 4.0}});
    scene.cameras[0] = {
        .id = 1, .model = 1, .width_px = 80, .height_px = 40, .params = {100, 50, 30, 25}};
    // At most 36 cells per image: 8 columns and 4 rows of 10 px.
    const std::vector<ViewRay> rays = view_rays(scene, with_samples(4 * 2 * 36));
    ASSERT_EQ(rays.size(), 64U);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::size_t cell = i % 32;
        EXPECT_EQ(rays[i].view, i / 32);
        const double x = (10.0 * static_cast<double>(cell % 8) + 5.0 - 30.0) / 100.0;
        const double y = (10.0 * static_cast<double>(cell / 8) + 5.0 - 25.0) / 50.0;
        // The cameras look down: rotated by 180 degrees about x.
        const Eigen::Vector3d expected(x, -y, -1.0);
        const Eigen::Vector3d line = rays[i].towards - scene.views[rays[i].view].center;
        EXPECT_TRUE(line.normalized().isApprox(expected.normalized(), 1e-12)) << "ray " << i;
    }
}

TEST(ViewRays, AreDividedAmongViewsWithAMinimum)
{
    Scene scene = testing::scene_above_square(3, std::vector<Eigen::Vector3d>(10, {0.5, 0.5, 1}));
    scene.cameras[0] = square_camera(1000, 1.0);
    EXPECT_EQ(view_rays(scene, with_samples(400000)).size(), 100000U);
    EXPECT_EQ(view_rays(scene, with_samples(4000)).size(), 1000U);
    EXPECT_EQ(view_rays(scene, with_samples(1000)).size(), 360U);
}

TEST(ViewRays, SkipCamerasWithoutKnownLensOrSize)
{
    Scene scene = testing::scene_above_square(3, testing::high_centers());
    const Camera known = square_camera(100, 1.0);
    Camera unknown = known;
    unknown.model = -1;
    Camera without_size = known;
    without_size.height_px = 0;
    scene.cameras = {unknown, without_size, known};
    for (std::uint32_t i = 0; i < 4; ++i) {
        scene.views[i].camera = std::min(i, 2U);
    }
    const std::vector<ViewRay> rays = view_rays(scene, with_samples(4 * 4 * 100));
    ASSERT_EQ(rays.size(), 200U);
    EXPECT_EQ(rays.front().view, 2U);
    EXPECT_EQ(rays.back().view, 3U);

    scene.views[2].camera = 0;
    scene.views[3].camera = 1;
    const Reference reference = make_reference(scene, nullptr, with_samples(1000));
    EXPECT_TRUE(reference.rays.empty());
    EXPECT_FALSE(ray_figures_of(square(), reference).has_value());
}

TEST(ViewRays, HitBackFacesThroughAMissingFace)
{
    const Reference reference = reference_above_cube();
    EXPECT_EQ(ray_figures_of(cube(), reference)->back_faces_seen, 0.0);
    // The opening is 50 of 100 px wide: 20 of 40 rays.
    EXPECT_EQ(ray_figures_of(without_top(cube()), reference)->back_faces_seen, 0.25);
    EXPECT_EQ(ray_figures_of(testing::flipped(cube()), reference)->back_faces_seen, 0.25);
}

TEST(ViewRays, CountMissesOfTheClosedSurface)
{
    Reference reference = reference_above_cube();
    EXPECT_FALSE(ray_figures_of(cube(), reference)->nothing_seen.has_value());
    TriMesh closed = testing::moved(cube(), {0.0, 0.0, -7.0});
    closed.offset = {0.0, 0.0, 7.0};
    use_closed_surface(reference, closed);
    EXPECT_EQ(ray_figures_of(cube(), reference)->nothing_seen, 0.0);
    EXPECT_EQ(ray_figures_of(without_top(cube()), reference)->nothing_seen, 0.0);
    // 14 of 40 rays pass through the bottom, 33.3 px wide; the others hit the sides from inside.
    const auto tube = ray_figures_of(without_top_and_bottom(cube()), reference);
    EXPECT_DOUBLE_EQ(tube->nothing_seen.value(), 14.0 * 14.0 / 1600.0);
    EXPECT_DOUBLE_EQ(tube->back_faces_seen, 0.25 - 14.0 * 14.0 / 1600.0);
    // Faces beside the closed surface have no effect.
    const TriMesh beside = testing::moved(square(), {1.0, 0.0, 1.0});
    EXPECT_EQ(ray_figures_of(testing::together(cube(), beside), reference)->nothing_seen, 0.0);
    EXPECT_EQ(ray_figures_of(beside, reference)->nothing_seen, 0.25);
    EXPECT_EQ(ray_figures_of(square(1.0), reference)->nothing_seen, 0.0);
}

TEST(ViewRays, AgreeWithTestingEveryFace)
{
    // Two oblique views of a cube without its top and a side.
    Scene scene = testing::scene_above_square(11, {{2.5, 1.9, 2.7}, {-0.7, -1.3, 1.6}});
    scene.cameras[0] = square_camera(200, 0.4);
    for (View& view : scene.views) {
        testing::aim(view, {0.45, 0.55, 0.4});
    }
    Reference reference = make_reference(scene, nullptr, with_samples(4 * 2 * 2500));
    use_closed_surface(reference, cube());
    TriMesh open = without_top(cube());
    open.faces.erase(open.faces.end() - 2, open.faces.end());

    int backs = 0;
    int missing = 0;
    for (int i = 0; i < 5000; ++i) {
        const View& view = scene.views[static_cast<std::size_t>(i / 2500)];
        const double u = 0.4 * ((i % 50 + 0.5) / 25.0 - 1.0);
        const double v = 0.4 * ((i % 2500 / 50 + 0.5) / 25.0 - 1.0);
        const Eigen::Vector3d line = view.cam_from_world.conjugate() * Eigen::Vector3d(u, v, 1.0);
        const Eigen::Vector3d towards = view.center + line;
        const auto hit = testing::first_hit_of_all(open, view.center, towards);
        const bool has_face = testing::first_hit_of_all(cube(), view.center, towards).has_value();
        backs += hit && !hit->front ? 1 : 0;
        missing += !hit && has_face ? 1 : 0;
    }
    EXPECT_GT(backs, 200);
    EXPECT_GT(missing, 20);
    const std::optional<RayFigures> figures = ray_figures_of(open, reference);
    EXPECT_DOUBLE_EQ(figures->back_faces_seen, backs / 5000.0);
    EXPECT_DOUBLE_EQ(figures->nothing_seen.value(), missing / 5000.0);
}

TEST(ViewRays, DoNotDependOnScaleOrOffset)
{
    Scene scene = testing::scene_above_square(11, {{0.5, 0.5, 3.0}, {0.5, 0.5, 3.0}});
    scene.cameras[0] = square_camera(100, 0.5);
    for (const double factor : {1e-6, 1e6}) {
        Scene other = scene;
        const Eigen::Vector3d shift = factor * Eigen::Vector3d(500, -40, 100);
        for (Eigen::Vector3d& position : other.positions) {
            position = position * factor + shift;
        }
        for (View& view : other.views) {
            view.center = view.center * factor + shift;
        }
        const auto there = [&](const TriMesh& mesh) {
            return testing::moved(testing::scaled(mesh, factor), shift);
        };
        Reference reference = make_reference(other, nullptr, with_samples(4 * 2 * 1600));
        use_closed_surface(reference, there(cube()));
        const auto tube = ray_figures_of(there(without_top_and_bottom(cube())), reference);
        EXPECT_DOUBLE_EQ(tube->nothing_seen.value(), 14.0 * 14.0 / 1600.0);
        EXPECT_DOUBLE_EQ(tube->back_faces_seen, 0.25 - 14.0 * 14.0 / 1600.0);
    }
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Records stages and notes.
class KeptLog : public Log {
  public:
    void stage_ends(std::string_view name, const Counts& /*counts*/) override
    {
        stages.emplace_back(name);
    }
    void note(std::string_view sentence) override { notes.emplace_back(sentence); }

    std::vector<std::string> stages;
    std::vector<std::string> notes;
};

/// A bumpy ball and four views side by side that look at it. No view sees its far side.
Scene ball_seen_from_one_side()
{
    Scene scene = bumpy_sphere(1500, 3);
    scene.views.resize(4);
    for (View& view : scene.views) {
        testing::aim(view, Eigen::Vector3d::Zero());
    }
    Tracks tracks;
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        std::vector<std::uint32_t> left;
        std::ranges::copy_if(scene.tracks[point], std::back_inserter(left),
                             [](std::uint32_t view) { return view < 4; });
        tracks.push_back(left);
    }
    scene.tracks = tracks;
    return scene;
}

double nothing_seen(const TriMesh& mesh, const Reference& reference)
{
    const MeasuredMesh measured = place_mesh({"a.ply", mesh}, reference);
    return measure_view_rays(measured, reference).value().nothing_seen.value();
}

TEST(ClosedSurface, AgreesWithTheOptionClosed)
{
    const Scene scene = ball_seen_from_one_side();
    Reference reference = make_reference(scene, nullptr, testing::few_samples());
    KeptLog log;
    add_closed_surface(reference, scene, log);
    EXPECT_THAT(log.stages, ElementsAre("closed"));
    EXPECT_THAT(log.notes, IsEmpty());
    const auto met = std::ranges::count(*reference.closed_hits, 1);
    EXPECT_GT(met, std::ssize(reference.rays) / 10);
    EXPECT_LT(met, std::ssize(reference.rays));

    Options options;
    Log silent;
    EXPECT_GT(nothing_seen(reconstruct(scene, options, silent).mesh, reference), 0.0);
    options.surface.closed = true;
    EXPECT_EQ(nothing_seen(reconstruct(scene, options, silent).mesh, reference), 0.0);
}

TEST(ClosedSurface, IsMissingIfAllPointsAreCoplanar)
{
    // All points are in a plane.
    Scene scene = testing::scene_above_square(3, testing::high_centers());
    scene.cameras[0] = testing::square_camera(100, 0.2);
    scene.colors.resize(scene.num_points());
    scene.errors_px.resize(scene.num_points());
    scene.point_ids.resize(scene.num_points());
    Reference reference = make_reference(scene, nullptr, testing::few_samples());
    KeptLog log;
    add_closed_surface(reference, scene, log);
    EXPECT_FALSE(reference.closed_hits.has_value());
    EXPECT_THAT(log.notes, ElementsAre(StartsWith("no closed surface to measure against: ")));
    const MeasuredMesh mesh = place_mesh({"a.ply", testing::square()}, reference);
    const RayFigures figures = measure_view_rays(mesh, reference).value();
    EXPECT_EQ(figures.back_faces_seen, 0.0);
    EXPECT_FALSE(figures.nothing_seen.has_value());
}

TEST(ClosedSurface, IsNotMadeIfNoViewHasARay)
{
    const Scene scene = testing::scene_above_square(3, testing::high_centers());
    Reference reference = make_reference(scene, nullptr, testing::few_samples());
    KeptLog log;
    add_closed_surface(reference, scene, log);
    EXPECT_FALSE(reference.closed_hits.has_value());
    EXPECT_THAT(log.stages, IsEmpty());
}

} // namespace
} // namespace vcarve::evidence_test
