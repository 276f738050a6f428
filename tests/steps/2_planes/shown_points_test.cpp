#include "steps/2_planes/shown_points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// A place before a view that looks along z: so far above and to the right of the origin in its
/// image, which has y downwards, and so far behind it.
Vector3d shown(double right, double above, double behind)
{
    const double depth = 6.0 + behind;
    return {right * depth / 6.0, -above * depth / 6.0, behind};
}

/// Whether the view looks at the origin, on a floor that goes up away from it at 45 degrees. The
/// first point is the floor's, the others are not.
bool looks_at_floor(const std::vector<Vector3d>& points)
{
    std::vector<MadePoint> made(points.size());
    std::ranges::transform(points, made.begin(), [](const Vector3d& point) {
        return MadePoint{point, {0}};
    });
    const Scene scene = make_scene({{0, 0, -6}}, made);
    FlatParts parts;
    const double half = std::sqrt(0.5);
    parts.planes.regions.push_back(
        {.plane = {Vector3d::Zero(), {0, -half, -half}}, .spacing = 0.1, .points = {0}});
    parts.patches.emplace_back(parts.planes.regions.front(), scene.positions);
    parts.region_of.assign(points.size(), FlatParts::kNone);
    parts.region_of.front() = 0;
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    return ShownPoints(scene, 0, all).looks_at(Vector3d::Zero(), parts, 0);
}

TEST(ShownPoints, LookAtAFloorThatAloneIsShownThere)
{
    EXPECT_TRUE(looks_at_floor({shown(0.1, 0, 0)}));
    EXPECT_TRUE(looks_at_floor({shown(0, -0.1, 0)}));
    EXPECT_TRUE(looks_at_floor({shown(0, 0.1, 0)}));
}

TEST(ShownPoints, DoNotLookAtAFloorBesideWhichSomethingElseIsShownNext)
{
    EXPECT_FALSE(looks_at_floor({shown(0.1, 0, 0), shown(-0.05, 0, -1)}));
    EXPECT_FALSE(looks_at_floor({shown(0.1, 0, 0), shown(0, -0.05, -1)}));
    EXPECT_FALSE(looks_at_floor({shown(0.1, 0, 0), shown(-0.05, 0, 1)}));
}

TEST(ShownPoints, DoNotLookAtAFloorThatWhatIsShownOnwardHides)
{
    EXPECT_FALSE(looks_at_floor({shown(0.1, 0, 0), shown(0, 0.2, -1)}));
    EXPECT_FALSE(looks_at_floor({shown(0.1, 0, 0), shown(0.15, 0.2, -1)})) << "up to 45 degrees";
    EXPECT_TRUE(looks_at_floor({shown(0.1, 0, 0), shown(0, 0.2, 1)})) << "farther";
    EXPECT_TRUE(looks_at_floor({shown(0.1, 0, 0), shown(0.25, 0.2, -1)})) << "aside";
    EXPECT_TRUE(looks_at_floor({shown(0.1, 0, 0), shown(0, -0.2, -1)})) << "below";
    EXPECT_TRUE(looks_at_floor({shown(0, 0.1, 0), shown(0, 0.2, -1)})) << "the floor comes first";
}

TEST(ShownPoints, HideNothingBehind40NearerOnes)
{
    std::vector<Vector3d> points = {shown(0.1, 0, 0)};
    for (int i = 0; i < 39; ++i) {
        EXPECT_FALSE([&] {
            std::vector<Vector3d> more = points;
            more.push_back(shown(0, 0.5, -1));
            return looks_at_floor(more);
        }()) << points.size();
        points.push_back(shown(-0.2 - 0.001 * i, 0, 0));
    }
    points.push_back(shown(0, 0.5, -1));
    EXPECT_TRUE(looks_at_floor(points));
}

} // namespace
} // namespace vcarve
