#include "model/scene_points.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace vcarve::scene_points_test {
namespace {

TEST(PointSample, HasEveryNthPointForPartsOfAnySize)
{
    const Scene scene = bumpy_sphere(900, 1);
    for (const std::size_t size : {1U, 50U, 1000U}) {
        PointSample sample = {.scene = without_points(scene), .most = 100};
        PartsOfScene parts(scene);
        for (Scene part = parts.next(size, {}); part.num_points() > 0;
             part = parts.next(size, {})) {
            sample.add(part);
        }
        EXPECT_EQ(sample.points, scene.num_points());
        EXPECT_EQ(sample.rays, scene.num_rays());
        EXPECT_EQ(sample.one_in, 16U) << "the least power of two that leaves 100 points";
        ASSERT_EQ(sample.scene.num_points(), (scene.num_points() + 15) / 16);
        for (std::size_t i = 0; i < sample.scene.num_points(); ++i) {
            EXPECT_EQ(sample.scene.positions[i], scene.positions[16 * i]);
            EXPECT_EQ(sample.scene.tracks[i].size(), scene.tracks[16 * i].size());
        }
    }
}

} // namespace
} // namespace vcarve::scene_points_test
