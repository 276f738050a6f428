#include "io/colmap/colmap_model.h"
#include "model/keypoints.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>
#include <string>

namespace vcarve {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera pinhole()
{
    Camera camera;
    camera.model = 1;
    camera.width_px = 480;
    camera.height_px = 240;
    camera.params = {100.0, 100.0, 240.0, 120.0};
    return camera;
}

TEST(Keypoints, CountInTheCellThatShowsThem)
{
    View view;
    for (int i = 0; i < 3; ++i) {
        count_keypoint(view, pinhole(), {479.0, 5.0}); // the last column of the first row
    }
    ASSERT_EQ(view.keypoints.size(), kKeypointCells * kKeypointCells);
    EXPECT_EQ(view.keypoints[kKeypointCells - 1], 3);
    EXPECT_EQ(std::accumulate(view.keypoints.begin(), view.keypoints.end(), 0), 3);
}

TEST(Keypoints, OutsideTheImageDoNotCount)
{
    View view;
    for (const double bad : {-1.0, 480.0, 1e300, std::nan("")}) {
        count_keypoint(view, pinhole(), {bad, 5.0});
    }
    EXPECT_TRUE(view.keypoints.empty());
    EXPECT_FALSE(keypoint_density(view, pinhole(), {0.0, 0.0, 1.0}));
}

TEST(Keypoints, AreAsDenseAsAnywhereWhereTheyAreEven)
{
    View view;
    for (int u = 0; u < 480; u += 5) {
        for (int v = 0; v < 240; v += 5) {
            count_keypoint(view, pinhole(), {u + 0.5, v + 0.5});
        }
    }
    EXPECT_DOUBLE_EQ(keypoint_density(view, pinhole(), {0.3, 0.2, 1.0}).value(), 1.0);
    EXPECT_FALSE(keypoint_density(view, pinhole(), {0.0, 2.0, 1.0})) << "below the image";
}

TEST(Keypoints, AreNoneBeforeTheSky)
{
    View view;
    for (int u = 0; u < 480; u += 5) {
        for (int v = 120; v < 240; v += 5) {
            count_keypoint(view, pinhole(), {u + 0.5, v + 0.5});
        }
    }
    EXPECT_EQ(keypoint_density(view, pinhole(), {0.0, -0.5, 1.0}).value(), 0.0);
    EXPECT_DOUBLE_EQ(keypoint_density(view, pinhole(), {0.0, 0.5, 1.0}).value(), 2.0);
}

/// A model as text with these 2D points of its only image.
ColmapViews views_with(const std::string& points2d)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "cameras.txt") << "1 PINHOLE 480 240 100 100 240 120\n";
    std::ofstream(folder / "images.txt") << "1 1 0 0 0 0 0 0 1 a.jpg\n" << points2d << "\n";
    return read_colmap_views(folder.path(), ModelFormat::text);
}

TEST(Keypoints, OfATextModelAreSpreadOverAllOfALine)
{
    std::string line;
    for (int i = 0; i < 48000; ++i) {
        line += std::to_string(i % 480) + " " + std::to_string(i / 200) + ".5 -1 ";
    }
    const View view = views_with(line).views.at(0);
    const auto in_row = [&](std::size_t row) {
        const auto begin =
            view.keypoints.begin() + static_cast<std::ptrdiff_t>(row * kKeypointCells);
        return std::accumulate(begin, begin + kKeypointCells, 0);
    };
    EXPECT_GT(in_row(0), 20);
    EXPECT_NEAR(in_row(0), in_row(kKeypointCells - 1), 2);
}

TEST(Keypoints, ThatAreNoNumbersAreRefused)
{
    EXPECT_EQ(views_with("5 5 -1").views.at(0).keypoints.size(), kKeypointCells * kKeypointCells);
    EXPECT_THROW(views_with("5 x -1"), InputError);
    EXPECT_THROW(views_with("5 5 -1 7 3"), InputError);
}

} // namespace
} // namespace vcarve
