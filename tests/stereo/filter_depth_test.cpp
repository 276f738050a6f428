#include "stereo/filter_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vcarve::filter_depth_test {
namespace {

const Pinhole kCamera = {20.0F, {19.0F, 19.0F}};

/// A depth map of the plane z = 2.
DepthMap wall(int width_px = 20)
{
    const auto pixels = static_cast<std::size_t>(width_px) * 20;
    DepthMap map{width_px, 20, std::vector<PixelPlane>(pixels), std::vector<float>(pixels, 0.1F)};
    for (PixelPlane& plane : map.planes) {
        plane.depth = 2.0F;
    }
    return map;
}

void make_plain(DepthMap& map, int from, int to)
{
    for (int y = from; y < to; ++y) {
        for (int x = from; x < to; ++x) {
            map.costs[map.index(x, y)] = DepthMap::kPlain;
            map.planes[map.index(x, y)] = {};
        }
    }
}

TEST(DropSpeckles, DropsRegionsBelowTheMinimumSize)
{
    DepthMap map = wall();
    for (const int x : {4, 5, 6}) {
        map.planes[map.index(x, 7)].depth = 1.0F;
    }
    drop_speckles(map, kCamera, 3);
    EXPECT_EQ(std::ranges::count(map.costs, 0.1F), 400);
    drop_speckles(map, kCamera, 4);
    EXPECT_EQ(std::ranges::count(map.costs, 0.1F), 397);
    EXPECT_EQ(map.costs[map.index(5, 7)], DepthMap::kNoCost);
}

TEST(FillPlainRegions, ContinuesThePlaneAroundARegion)
{
    DepthMap map = wall();
    const std::vector<PixelPlane> surface(400, {2.02F, -Eigen::Vector3f::UnitZ()});
    make_plain(map, 5, 15);
    fill_plain_regions(map, kCamera, surface);
    EXPECT_EQ(std::ranges::count(map.costs, DepthMap::kFilled), 100);
    EXPECT_NEAR(map.planes[map.index(10, 10)].depth, 2.0F, 1e-5F);
    EXPECT_NEAR(map.planes[map.index(10, 10)].normal.z(), -1.0F, 1e-5F);
}

TEST(FillPlainRegions, LeavesTheSkyEmpty)
{
    DepthMap map = wall();
    make_plain(map, 5, 15);
    fill_plain_regions(map, kCamera, std::vector<PixelPlane>(400));
    EXPECT_EQ(std::ranges::count(map.costs, DepthMap::kFilled), 0);
}

TEST(FillPlainRegions, SkipsARegionIfThePixelsAroundItDisagree)
{
    DepthMap map = wall();
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            map.planes[map.index(x, y)].depth =
                2.0F + 0.1F * static_cast<float>((x * x + 3 * y * y) % 7);
        }
    }
    const std::vector<PixelPlane> surface = map.planes;
    make_plain(map, 5, 15);
    fill_plain_regions(map, kCamera, surface);
    EXPECT_EQ(std::ranges::count(map.costs, DepthMap::kFilled), 0);
}

TEST(FillPlainRegions, SkipsARegionMeasuredAlongALine)
{
    DepthMap map = wall();
    std::ranges::fill(map.costs, DepthMap::kPlain);
    for (int x = 0; x < 20; ++x) {
        map.costs[map.index(x, 0)] = 0.1F;
    }
    const std::vector<PixelPlane> surface = map.planes;
    fill_plain_regions(map, kCamera, surface);
    EXPECT_EQ(std::ranges::count(map.costs, DepthMap::kFilled), 0);
}

TEST(FillPlainRegions, StaysBetweenTheMeasuredPixels)
{
    DepthMap map = wall();
    const std::vector<PixelPlane> surface = map.planes;
    for (int i = 0; i < 400; ++i) {
        const int x = i % 20;
        const int y = i / 20;
        if (x >= 8 || y >= 8 || (x > 2 && x < 5 && y > 2 && y < 5)) map.costs[i] = DepthMap::kPlain;
    }
    fill_plain_regions(map, kCamera, surface);
    EXPECT_EQ(map.costs[map.index(19, 19)], DepthMap::kPlain);
    EXPECT_EQ(map.costs[map.index(19, 2)], DepthMap::kPlain);
}

TEST(FillPlainRegions, SkipsARegionMeasuredAlongANarrowBand)
{
    DepthMap map = wall(200);
    const std::vector<PixelPlane> surface = map.planes;
    std::ranges::fill(map.costs, DepthMap::kPlain);
    for (int x = 0; x < 200; ++x) {
        for (int y = 0; y < (x % 20 < 10 ? 1 : 5); ++y) {
            map.costs[map.index(x, y)] = 0.1F;
        }
    }
    fill_plain_regions(map, kCamera, surface);
    EXPECT_EQ(std::ranges::count(map.costs, DepthMap::kFilled), 0);
}

} // namespace
} // namespace vcarve::filter_depth_test
