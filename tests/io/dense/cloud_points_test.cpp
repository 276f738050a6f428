#include "io/dense/cloud_points.h"
#include "io/dense/dense_scene.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vcarve::cloud_points_test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

/// One point per Gaussian, on a line.
PointCloud cloud_of(std::vector<Splat> splats)
{
    PointCloud cloud;
    for (std::size_t i = 0; i < splats.size(); ++i) {
        cloud.positions.emplace_back(static_cast<double>(i), 0, 0);
        cloud.colors.push_back({static_cast<std::uint8_t>(i), 0, 0});
    }
    cloud.splats = std::move(splats);
    return cloud;
}

TEST(Splats, AreAllKeptIfNoneIsFaintOrHuge)
{
    PointCloud cloud = cloud_of({{0.0F, -4.0F}, {3.0F, -1.8F}, {9.0F, -4.0F}});
    const KeptSplats kept = keep_solid_splats(cloud);
    EXPECT_THAT(kept.places, ElementsAre(0, 1, 2));
    EXPECT_EQ(kept.note, "");
    EXPECT_EQ(cloud.positions.size(), 3U);
}

TEST(Splats, AreDroppedIfFaintOrHuge)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    PointCloud cloud = cloud_of({{-0.1F, -4.0F}, // below half opacity
                                 {1.0F, -4.0F},
                                 {1.0F, -4.0F + std::log(9.9F)},
                                 {1.0F, -4.0F + std::log(10.1F)},
                                 {1.0F, nan},
                                 {nan, -4.0F},
                                 {1.0F, -4.0F},
                                 {1.0F, -9.0F}});
    const KeptSplats kept = keep_solid_splats(cloud);
    EXPECT_THAT(kept.places, ElementsAre(1, 2, 6, 7));
    EXPECT_EQ(kept.note,
              "of 8 Gaussians, 2 are dropped because their opacity is below one half, and 2 "
              "because they are over 10 times as large as the median");
    EXPECT_THAT(cloud.positions, ElementsAre(Vector3d(1, 0, 0), Vector3d(2, 0, 0),
                                             Vector3d(6, 0, 0), Vector3d(7, 0, 0)));
    EXPECT_THAT(cloud.colors,
                ElementsAre(Color{1, 0, 0}, Color{2, 0, 0}, Color{6, 0, 0}, Color{7, 0, 0}));
    EXPECT_THAT(cloud.normals, IsEmpty());
}

TEST(Splats, AreOnlyDroppedInCloudsOfGaussians)
{
    PointCloud cloud = cloud_of({{1.0F, 0.0F}});
    cloud.splats.clear();
    EXPECT_EQ(keep_solid_splats(cloud).note, "");
    EXPECT_EQ(cloud.positions.size(), 1U);
}

/// A cloud as 3DGS writes it, of anisotropic Gaussians. The second one is faint.
std::string splat_file(const std::string& more = "", const std::string& values = "")
{
    std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n";
    for (const char* const name : {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "f_rest_0",
                                   "opacity", "scale_0", "scale_1", "scale_2", "rot_0"}) {
        text += fmt::format("property float {}\n", name);
    }
    text += more + "end_header\n";
    text += "0 0 4 1.7724538 -1.7724538 0 7 2 -3 -9 -5 1 " + values + "\n";
    text += "1 0 4 9 0 0.5 7 -2 -3 -9 -5 1 " + values + "\n";
    text += "0 1 4 0.8862269 9 -9 7 0 -9 -9 -3 1 " + values + "\n";
    return text;
}

DenseFiles files_with(const std::filesystem::path& cloud)
{
    return {fixtures_folder() / "formats/rich_bin", ModelFormat::binary, cloud, {}};
}

TEST(Splats, HaveColorsOfTheirHarmonicsAndIdsOfTheFile)
{
    const TemporaryFolder folder;
    const auto file = folder.write("a.ply", splat_file());
    std::vector<std::string> notes;
    const Scene scene = read_dense_scene(files_with(file), {}, &notes);
    EXPECT_THAT(scene.positions, ElementsAre(Vector3d(0, 0, 4), Vector3d(0, 1, 4)));
    EXPECT_THAT(scene.colors, ElementsAre(Color{255, 0, 128}, Color{191, 255, 0}));
    EXPECT_THAT(scene.point_ids, ElementsAre(0, 2));
    EXPECT_EQ(scene.tracks.size(), 2U);
    EXPECT_THAT(notes, ElementsAre(file.string() + ": of 3 Gaussians, 1 are dropped because their "
                                                   "opacity is below one half, and 0 because they "
                                                   "are over 10 times as large as the median"));
}

TEST(Splats, KeepExplicitColors)
{
    const TemporaryFolder folder;
    const std::string more = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const auto file = folder.write("a.ply", splat_file(more, "1 2 3"));
    EXPECT_THAT(read_dense_scene(files_with(file)).colors,
                ElementsAre(Color{1, 2, 3}, Color{1, 2, 3}));
}

TEST(Splats, AreRefusedIfNoneRemains)
{
    const TemporaryFolder folder;
    std::string faint = splat_file();
    for (const auto& [from, to] : {std::pair{"7 2 ", "7 -1 "}, std::pair{"7 0 ", "7 -1 "}}) {
        faint.replace(faint.find(from), 4, to);
    }
    const auto file = folder.write("a.ply", faint);
    EXPECT_EQ(refusal<InputError>([&] { read_dense_scene(files_with(file)); }),
              file.string() + ": of 3 Gaussians, 3 are dropped because their opacity is below one "
                              "half, and 0 because they are over 10 times as large as the median, "
                              "so none remains");
}

} // namespace

} // namespace
} // namespace vcarve::cloud_points_test
