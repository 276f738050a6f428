#include "model/seen_places.h"
#include "support/scenes.h"

#include <gmock/gmock.h>

#include <limits>

namespace vcarve::seen_places_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;

/// Two points at either end of a line, each seen by both views, which make a ball of radius 1
/// around the origin.
Scene ends_of_line()
{
    return make_scene({{0, 0, 9}, {0, 9, 0}}, {{{-1, 0, 0}, {0, 1}}, {{1, 0, 0}, {0, 1}}});
}

void add_point(Scene& scene, const Vector3d& position, const std::vector<std::uint32_t>& track)
{
    scene.positions.push_back(position);
    scene.colors.push_back({});
    scene.errors_px.push_back(1.0);
    scene.point_ids.push_back(scene.positions.size());
    scene.tracks.push_back(track);
}

TEST(SeenPlaces, CountsCubesAndNotPoints)
{
    Scene scene = ends_of_line();
    // Ten points at one place for the first view, two at two places for the second. 32 cubes lie
    // along the diameter.
    for (int i = 0; i < 10; ++i) {
        add_point(scene, {0.01, 0.01, 0.01}, {0});
    }
    add_point(scene, {0.01, 0.2, 0.01}, {1});
    add_point(scene, {0.01, -0.2, 0.01}, {1});
    EXPECT_THAT(seen_places(scene), ElementsAre(3U, 4U));
}

TEST(SeenPlaces, LeavesOutWhatLiesFarBehindOrNowhere)
{
    Scene scene = ends_of_line();
    for (int i = 0; i < 40; ++i) {
        add_point(scene, {0.01, 0.01, 0.01}, {0, 1});
    }
    add_point(scene, {0, 0, -100}, {1});
    add_point(scene, {0, std::numeric_limits<double>::quiet_NaN(), 0}, {});
    const std::vector<std::size_t> places = seen_places(scene);
    EXPECT_EQ(places[1], places[0]);
}

TEST(SeenPlaces, AreNoneWhereNothingWasSeen)
{
    EXPECT_THAT(seen_places(make_scene({{0, 0, 9}, {0, 9, 0}}, {})), ElementsAre(0U, 0U));
    EXPECT_TRUE(seen_places({}).empty());
}

TEST(SeenPlaces, OfPointsAtOnePlaceAreOne)
{
    const Scene scene = make_scene({{0, 0, 9}}, {{{1, 2, 3}, {0}}, {{1, 2, 3}, {0}}});
    EXPECT_THAT(seen_places(scene), ElementsAre(1U));
}

} // namespace
} // namespace vcarve::seen_places_test
