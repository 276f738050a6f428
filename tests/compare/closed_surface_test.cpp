#include "compare/closed_surface.h"
#include "compare/view_rays.h"
#include "support/made_cells.h"
#include "support/measured_scenes.h"
#include "support/scenes.h"
#include "vcarve/reconstruct.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>

namespace vcarve::closed_surface_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Keeps what it is told.
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

/// A bumpy ball and four views side by side that look at it: nobody sees its far side.
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

TEST(ClosedSurface, IsWhatTheProgramMakesWithClosed)
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

TEST(ClosedSurface, IsNoneWhereThePointsLeaveNone)
{
    // All points lie in a plane.
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

TEST(ClosedSurface, IsNotMadeWhereNoViewHasARay)
{
    const Scene scene = testing::scene_above_square(3, testing::high_centers());
    Reference reference = make_reference(scene, nullptr, testing::few_samples());
    KeptLog log;
    add_closed_surface(reference, scene, log);
    EXPECT_FALSE(reference.closed_hits.has_value());
    EXPECT_THAT(log.stages, IsEmpty());
}

} // namespace
} // namespace vcarve::closed_surface_test
