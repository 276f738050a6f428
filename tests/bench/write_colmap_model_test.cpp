#include "io/colmap/byte_reader.h"
#include "io/colmap/colmap_model.h"
#include "io/files/mapped_file.h"
#include "sample_scene.h"
#include "sample_shapes.h"
#include "support/many_points.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace vcarve::bench::write_colmap_model_test {
namespace {

/// A scene in parts of at most `most` points.
class SmallParts final : public SceneParts {
  public:
    SmallParts(const Scene& scene, std::size_t most) : parts_(scene), most_(most) {}

    std::size_t num_points() const override { return parts_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override
    {
        return parts_.next(std::min(most, most_), progress);
    }

  private:
    PartsOfScene parts_;
    std::size_t most_;
};

TEST(SampleParts, EqualTheWholeSceneForAnyPartSizeAndThreadCount)
{
    const SampleKind kind = {.shape = Shape::terrain, .views = 50};
    constexpr std::size_t kPoints = 3 * kSampleBlock + 1000;
    const Scene all = make_sample_scene(kind, kPoints);
    ASSERT_EQ(all.num_points(), kPoints);
    expect_well_formed(all);
    for (const std::size_t most : {kSampleBlock, 2 * kSampleBlock + 1}) {
        const auto parts = sample_parts(kind, kPoints);
        EXPECT_EQ(parts->num_points(), kPoints);
        std::size_t first = 0;
        for (Scene part = parts->next(most, {}); part.num_points() > 0;
             part = parts->next(most, {})) {
            const std::size_t count = part.num_points();
            ASSERT_LE(count, most);
            Scene expected = PartsOfScene(all).next(first, {});
            PartsOfScene same(all);
            same.next(first, {});
            expected = same.next(count, {});
            expect_equal_scenes(part, expected);
            first += count;
        }
        EXPECT_EQ(first, kPoints);
    }
}

/// A scene with more rays than one write contains.
Scene some_scene()
{
    return make_sample_scene({.shape = Shape::surface, .views = 40}, 50'000);
}

TEST(WriteColmapModel, WritesPartsLikeTheWholeScene)
{
    const TemporaryFolder folder;
    const Scene scene = some_scene();
    write_colmap_model(folder / "whole", scene);
    SmallParts parts(scene, 777);
    write_colmap_model(folder / "parts", parts);
    for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
        EXPECT_TRUE(bytes_of(folder / "whole" / name) == bytes_of(folder / "parts" / name)) << name;
    }
}

TEST(WriteColmapModel, RoundTripsEveryPoint)
{
    const TemporaryFolder folder;
    const Scene scene = some_scene();
    SmallParts parts(scene, 10'000);
    write_colmap_model(folder / "model", parts);
    Scene read = read_colmap_model(folder / "model", ModelFormat::binary);
    ASSERT_EQ(read.views.size(), scene.views.size());
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        EXPECT_TRUE(read.views[i].center.isApprox(scene.views[i].center, 1e-12));
        EXPECT_TRUE(read.views[i].cam_from_world.isApprox(scene.views[i].cam_from_world, 1e-12));
        read.views[i].center = scene.views[i].center;
        read.views[i].cam_from_world = scene.views[i].cam_from_world;
    }
    expect_equal_scenes(read, scene);
}

/// A 2D point of an image in COLMAP's format.
struct Seen {
    double x;
    double y;
    std::uint64_t point_id;
};

/// The 2D points of every image, by image id.
std::map<std::uint32_t, std::vector<Seen>> seen_in_images(const std::filesystem::path& path)
{
    const MappedFile file(path);
    ByteReader reader(file.bytes(), path.string());
    std::map<std::uint32_t, std::vector<Seen>> seen;
    const auto count = reader.read<std::uint64_t>("count");
    for (std::uint64_t i = 0; i < count; ++i) {
        std::vector<Seen>& points = seen[reader.read<std::uint32_t>("id")];
        reader.skip(1, 7 * sizeof(double) + sizeof(std::uint32_t));
        reader.read_zero_terminated("name");
        points.resize(reader.read_count(sizeof(Seen), "2D points"));
        for (Seen& point : points) {
            point = reader.read<Seen>("2D point");
        }
    }
    reader.expect_end("the last image");
    return seen;
}

TEST(WriteColmapModel, ListsInEveryImageThePointsOfItsTracksAndTheirPixels)
{
    const TemporaryFolder folder;
    const Scene scene = some_scene();
    write_colmap_model(folder / "model", scene);
    const auto seen = seen_in_images(folder / "model/images.bin");
    const MappedFile file(folder / "model/points3D.bin");
    ByteReader reader(file.bytes(), "points3D.bin");
    ASSERT_EQ(reader.read<std::uint64_t>("count"), scene.num_points());
    std::size_t rays = 0;
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const auto id = reader.read<std::uint64_t>("id");
        reader.skip(1, 3 * 8 + 3 + 8);
        const auto length = reader.read<std::uint64_t>("track");
        for (std::uint64_t ray = 0; ray < length; ++ray, ++rays) {
            const auto image = reader.read<std::uint32_t>("image");
            const Seen& point = seen.at(image).at(reader.read<std::uint32_t>("2D point"));
            ASSERT_EQ(point.point_id, id);
            const View& view = scene.views[image - 1];
            const Eigen::Vector2d expected = in_image(in_camera(view, scene.positions[i]));
            ASSERT_EQ(Eigen::Vector2d(point.x, point.y), expected);
        }
    }
    std::size_t listed = 0;
    for (const auto& [image, points] : seen) {
        listed += points.size();
    }
    EXPECT_EQ(listed, rays);
    EXPECT_EQ(rays, scene.num_rays());
}

#ifndef VCARVE_SANITIZED // sanitizers use extra memory
/// More points than fit into memory: the same few, repeated.
class ManyParts final : public SceneParts {
  public:
    explicit ManyParts(std::size_t count) : left_(count), count_(count) {}

    std::size_t num_points() const override { return count_; }
    Scene next(std::size_t most, const Progress& /*progress*/) override
    {
        const std::size_t count = std::min({most, left_, std::size_t{100'000}});
        left_ -= count;
        return many_points(count);
    }

  private:
    std::size_t left_;
    std::size_t count_;
};

TEST(WriteColmapModel, UsesNoMoreMemoryForMorePoints)
{
    const TemporaryFolder folder;
    ManyParts parts(2'000'000); // 130 MB as a scene, 144 MB of 2D points
    EXPECT_LT(memory_taken([&] { write_colmap_model(folder / "model", parts); }), 50e6);
    EXPECT_EQ(std::filesystem::file_size(folder / "model/points3D.bin"),
              8 + 2'000'000 * (51 + 3 * 8));
}

TEST(SampleParts, UseNoMoreMemoryForMorePoints)
{
    const auto parts = sample_parts({.shape = Shape::terrain}, 1'000'000'000);
    EXPECT_LT(
        memory_taken([&] { EXPECT_EQ(parts->next(kSampleBlock, {}).num_points(), kSampleBlock); }),
        20e6);
}
#endif

} // namespace
} // namespace vcarve::bench::write_colmap_model_test
