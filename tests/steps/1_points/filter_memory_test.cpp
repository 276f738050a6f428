// What reading, filtering and sorting take beside the points themselves: models of which a machine
// can just hold the points must get through.

#include "io/colmap/colmap_model.h"
#include "sample_scene.h"
#include "steps/1_points/center.h"
#include "steps/1_points/crop.h"
#include "steps/1_points/filter.h"
#include "steps/1_points/spatial_sort.h"
#include "support/many_points.h"
#include "support/region_checks.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace vcarve::filter_memory_test {
namespace {

#ifndef VCARVE_SANITIZED // sanitizers need memory of their own

constexpr std::size_t kPoints = 1'000'000;
constexpr double kPerPoint = static_cast<double>(kPoints);

double memory_of_reading(const Scene& scene)
{
    const TemporaryFolder folder;
    bench::write_colmap_model(folder / "model", scene);
    Scene read;
    const double taken =
        memory_taken([&] { read = read_colmap_model(folder / "model", ModelFormat::binary); });
    EXPECT_EQ(read.num_points(), scene.num_points());
    return taken;
}

TEST(PointsMemory, OfReadingIsThatOfTheSceneAndAFifth)
{
    // As many sights as an array that grew by three at first would just have been doubled for
    Scene scene = many_points(1'050'000);
    EXPECT_LT(memory_of_reading(scene), 1.1 * bytes_of_points(scene))
        << "the file is given back, tracks do not grow, ids that ascend are not sorted";
    std::ranges::reverse(scene.point_ids);
    EXPECT_LT(memory_of_reading(scene), 1.2 * bytes_of_points(scene));
}

TEST(PointsMemory, OfCenteringIsOneCoordinate)
{
    Scene scene = many_points(kPoints);
    EXPECT_LT(memory_taken([&] { scene = center_points(std::move(scene)); }), 10.0 * kPerPoint);
}

TEST(PointsMemory, OfFilteringIsNotASecondScene)
{
    Scene scene = many_points(kPoints);
    FilteredPoints filtered;
    EXPECT_LT(memory_taken([&] { filtered = filter_points(std::move(scene), {}); }),
              44.0 * kPerPoint);
    EXPECT_EQ(filtered.scene.num_points(), kPoints);
}

TEST(PointsMemory, OfSortingIsNotASecondScene)
{
    Scene scene = many_points(kPoints);
    EXPECT_LT(memory_taken([&] { scene = spatial_sort(std::move(scene)); }), 44.0 * kPerPoint);
    EXPECT_EQ(scene.num_points(), kPoints);
}

TEST(PointsMemory, OfCroppingIsNotASecondScene)
{
    Scene scene = many_points(kPoints);
    const auto region = box_region({-9, -9, -9}, {9, 9, 9});
    CroppedPoints cropped;
    EXPECT_LT(memory_taken([&] { cropped = crop_points(std::move(scene), *region); }),
              44.0 * kPerPoint);
    EXPECT_EQ(cropped.inside, static_cast<std::int64_t>(kPoints));
}

#endif

} // namespace
} // namespace vcarve::filter_memory_test
