#include "support/temporary_folder.h"
#include "tiles/tile_size.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::tile_size_test {
namespace {

constexpr SceneSize kModel = {.points = 20'000'000, .rays = 74'000'000, .views = 300};
constexpr std::int64_t kGiB = std::int64_t{1} << 30;

TEST(TileSize, DoublesWithMemory)
{
    const std::size_t points = points_of_tile(kModel, {}, 2 * kGiB);
    EXPECT_GE(points, 500'000U);
    EXPECT_LE(points, 4'000'000U);
    EXPECT_EQ(points % 1000, 0U);
    EXPECT_GT(points_of_tile(kModel, {}, 6 * kGiB), points);
}

TEST(TileSize, RejectsMemoryBelowThatOfTheMesh)
{
    EXPECT_THAT(refusal<InputError>([] { points_of_tile(kModel, {}, kGiB); }),
                ::testing::MatchesRegex("20000000 points with 74000000 rays need about [0-9.]+G of "
                                        "memory even in tiles, and --max-memory allows 1G"));
}

TEST(TileSize, LeavesEnoughWitnesses)
{
    EXPECT_EQ(points_of_witness(10'000), 1U);
    EXPECT_EQ(points_of_witness(400'000), 8U);
    EXPECT_EQ(points_of_witness(100'000'000), 16U);
}

} // namespace
} // namespace vcarve::tile_size_test
