#include "io/ply/ply_file.h"
#include "support/dense_workspace.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace vcarve::ply_cloud_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3f;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const fs::path kFormats = fixtures_folder() / "formats";

void expect_points_of_the_fixtures(const PointCloud& cloud)
{
    EXPECT_THAT(cloud.positions, ElementsAre(Vector3d(0.5, 0.25, 4.0), Vector3d(-0.125, 3.0, 5.0),
                                             Vector3d(1.5, -2.0, 6.0)));
}

TEST(PlyCloud, IsEqualInAllEncodingsAndLayouts)
{
    for (const char* name : {"dense_little", "dense_ascii", "dense_big_lists"}) {
        SCOPED_TRACE(name);
        const PointCloud cloud = read_ply_cloud(kFormats / name / "fused.ply");
        expect_points_of_the_fixtures(cloud);
        EXPECT_THAT(cloud.normals,
                    ElementsAre(Vector3f(0, 0, -1), Vector3f(0, 3, -4), Vector3f(0, 0, 0)));
        EXPECT_THAT(cloud.colors,
                    ElementsAre(Color{200, 150, 100}, Color{0, 128, 255}, Color{1, 2, 3}));
    }
}

TEST(PlyCloud, IsReadInParts)
{
    for (const char* name : {"dense_little", "dense_ascii", "dense_big_lists"}) {
        SCOPED_TRACE(name);
        PlyReader reader(kFormats / name / "fused.ply");
        EXPECT_EQ(reader.num_points(), 3U);
        const PointCloud first = reader.next(2);
        EXPECT_THAT(first.positions, ElementsAre(Vector3d(0.5, 0.25, 4.0), Vector3d(-0.125, 3, 5)));
        const PointCloud second = reader.next(2);
        EXPECT_THAT(second.positions, ElementsAre(Vector3d(1.5, -2.0, 6.0)));
        EXPECT_THAT(second.colors, ElementsAre(Color{1, 2, 3}));
        EXPECT_THAT(reader.next(2).positions, IsEmpty());
    }
}

TEST(PlyCloud, ReportsTheVertexNumberInTheFile)
{
    const fs::path path = fixtures_folder() / "broken_dense/ply_ascii_ends/fused.ply";
    PlyReader reader(path);
    reader.next(1);
    reader.next(1);
    EXPECT_EQ(refusal<InputError>([&] { reader.next(1); }),
              path.string() + ": vertex 2 of 3: the file ends there");
}

TEST(PlyCloud, NeedsNoNormalsOrColors)
{
    const PointCloud cloud = read_ply_cloud(kFormats / "dense_bare/fused.ply");
    expect_points_of_the_fixtures(cloud);
    EXPECT_THAT(cloud.normals, IsEmpty());
    EXPECT_THAT(cloud.colors, IsEmpty());
}

TEST(PlyCloud, KeepsPointsThatAreNotFinite)
{
    const TemporaryFolder folder;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const CloudEncoding encoding : {CloudEncoding::binary, CloudEncoding::ascii}) {
        Scene scene;
        scene.positions = {{nan, 0, 1}, {2, 3, 4}};
        scene.colors.resize(2);
        const fs::path path = folder.write("cloud.ply", cloud_bytes(scene, encoding));
        const PointCloud cloud = read_ply_cloud(path);
        ASSERT_EQ(cloud.positions.size(), 2U);
        EXPECT_TRUE(std::isnan(cloud.positions[0].x()));
        EXPECT_EQ(cloud.positions[1], Vector3d(2, 3, 4));
    }
}

TEST(PlyCloud, KeepsFileOrderWhenReadInParallel)
{
    constexpr std::size_t kPoints = 100'000; // several ranges of points
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-1.0F, 1.0F);
    Scene scene;
    for (std::size_t i = 0; i < kPoints; ++i) {
        scene.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
        scene.normals.push_back({coordinate(random), coordinate(random), coordinate(random)});
        scene.colors.push_back({static_cast<std::uint8_t>(random()), 7, 9});
    }
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.ply", cloud_bytes(scene, CloudEncoding::binary));
    const PointCloud cloud = read_ply_cloud(path);
    EXPECT_EQ(cloud.positions, scene.positions);
    EXPECT_EQ(cloud.normals, scene.normals);
    EXPECT_EQ(cloud.colors, scene.colors);
}

TEST(PlyCloud, AddsTheOffsetOfAComment)
{
    Scene scene;
    scene.positions = {{0.5, 1, 2}};
    scene.colors.resize(1);
    std::string bytes = cloud_bytes(scene, CloudEncoding::binary);
    bytes.insert(bytes.find("element"), "comment offset 500000 4600000 -3\n");
    const TemporaryFolder folder;
    EXPECT_THAT(read_ply_cloud(folder.write("a.ply", bytes)).positions,
                ElementsAre(Vector3d(500000.5, 4600001, -1)));
}

TEST(PlyCloud, MayBeEmpty)
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.ply", cloud_bytes({}, CloudEncoding::binary));
    EXPECT_THAT(read_ply_cloud(path).positions, IsEmpty());
}

TEST(PlyCloud, IsRefusedIfTruncatedAnywhere)
{
    const TemporaryFolder folder;
    for (const char* name : {"dense_little", "dense_big_lists"}) {
        const std::string bytes = bytes_of(kFormats / name / "fused.ply");
        ASSERT_GT(bytes.size(), 300U);
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            const fs::path path = folder.write("a.ply", bytes.substr(0, length));
            EXPECT_THROW(read_ply_cloud(path), InputError) << name << " " << length;
        }
    }
}

} // namespace
} // namespace vcarve::ply_cloud_test
