#include "io/dense/dense_scene.h"
#include "steps/1_points/thin.h"
#include "support/made_cells.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vcarve::thin_parts_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Le;

constexpr ThinOptions kOnePixel = {.merge_px = 1.0};

/// A view 10 above the ground, whose pixels are 0.1 wide there, and one beside it.
Scene views_from_above()
{
    Scene scene;
    scene.cameras = {
        {.id = 1, .model = 0, .width_px = 200, .height_px = 200, .params = {100.0, 100.0, 100.0}}};
    scene.views = {{.id = 1, .camera = 0, .name = "left", .center = {0.0, 0.0, 10.0}},
                   {.id = 2, .camera = 0, .name = "right", .center = {0.1, 0.0, 10.0}}};
    return scene;
}

struct Point {
    Vector3d position;
    std::vector<std::uint32_t> views;
    Color color = {0, 0, 0};
    Vector3f normal = Vector3f::UnitZ();
};

void add(Scene& scene, const Point& point)
{
    scene.positions.push_back(point.position);
    scene.colors.push_back(point.color);
    scene.normals.push_back(point.normal);
    scene.errors_px.push_back(-1.0);
    scene.point_ids.push_back(scene.num_points() - 1);
    scene.tracks.push_back(point.views);
}

/// A wavy surface with many points per pixel.
Scene wavy_sheet(int count)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    Scene scene = views_from_above();
    for (int i = 0; i < count; ++i) {
        const double x = place(random);
        const double y = place(random);
        const std::vector<std::uint32_t> views =
            i % 3 == 0 ? std::vector<std::uint32_t>{0, 1} : std::vector<std::uint32_t>{i % 3 - 1U};
        add(scene, {{x, y, 0.3 * std::sin(x) * y}, views});
    }
    return scene;
}

Scene thin_in_parts(const Scene& scene, std::size_t at_once)
{
    PartsOfScene parts(scene);
    return thin_points(parts, kOnePixel, {}, at_once);
}

TEST(ThinParts, ReturnAboutTheSamePointCountAndKeepAllViews)
{
    const Scene scene = wavy_sheet(20'000);
    const auto whole = static_cast<double>(thin_points(scene, kOnePixel).num_points());
    const Scene thin = thin_in_parts(scene, 700); // fewer than the result
    EXPECT_NEAR(static_cast<double>(thin.num_points()), whole, 0.05 * whole);
    // Twice the diagonal of a cube, since parts are merged before they meet, plus half a side.
    const double reach = 0.1 * std::sqrt(2.0) * (2.0 * std::sqrt(3.0) + 0.5);
    for (std::size_t i = 0; i < scene.num_points(); i += 7) {
        bool found = false;
        for (std::size_t k = 0; k < thin.num_points() && !found; ++k) {
            const Vector3d place = thin.positions[k] + thin.offset;
            found = (place - scene.positions[i]).norm() < reach &&
                    std::ranges::includes(thin.tracks[k], scene.tracks[i]);
        }
        EXPECT_TRUE(found) << "point " << i;
    }
}

TEST(ThinParts, ReturnTheMeanOfAllMergedPoints)
{
    Scene scene = views_from_above();
    add(scene, {{0.010, 0.01, 0.0}, {0}, {10, 0, 200}, Vector3f::UnitZ()});
    add(scene, {{0.020, 0.01, 0.0}, {0}, {20, 0, 200}, Vector3f::UnitX()});
    add(scene, {{0.030, 0.01, 0.0}, {1}, {30, 0, 200}, Vector3f::UnitZ()});
    scene.normals[1] = Vector3f(0.0F, 0.6F, 0.8F);
    add(scene, {{5.0, 5.0, 0.0}, {0}}); // moves the center of the last part
    const Scene thin = thin_in_parts(scene, 2);
    ASSERT_EQ(thin.num_points(), 2U);
    EXPECT_TRUE((thin.positions[0] + thin.offset).isApprox(Vector3d(0.02, 0.01, 0.0)));
    EXPECT_EQ(thin.colors[0], (Color{20, 0, 200}));
    EXPECT_TRUE(thin.normals[0].isApprox(Vector3f(0.0F, 0.6F, 2.8F).normalized(), 0.01F));
    EXPECT_THAT(thin.tracks.views, ElementsAre(0, 1, 0));
    EXPECT_TRUE((thin.positions[1] + thin.offset).isApprox(scene.positions[3]));
}

TEST(ThinParts, AcceptPartsWithoutPointsToMerge)
{
    Scene scene = views_from_above();
    add(scene, {{0.01, 0.01, 0.0}, {}});
    add(scene, {{0.01, 0.01, 0.0}, {}});
    add(scene, {{0.01, 0.01, 0.0}, {0}});
    add(scene, {{0.02, 0.01, 0.0}, {0}});
    EXPECT_EQ(thin_in_parts(scene, 2).num_points(), 3U);
    const Scene none = thin_in_parts(views_from_above(), 2);
    EXPECT_EQ(none.num_points(), 0U);
    EXPECT_EQ(none.views.size(), 2U);
}

TEST(ThinParts, AreReadWithAtMostTheGivenPointCount)
{
    struct Asked final : SceneParts {
        explicit Asked(const Scene& scene) : parts(scene) {}
        std::size_t num_points() const override { return parts.num_points(); }
        Scene next(std::size_t most, const Progress& progress) override
        {
            asked.push_back(most);
            return parts.next(most, progress);
        }
        PartsOfScene parts;
        std::vector<std::size_t> asked;
    };
    const Scene scene = wavy_sheet(1000);
    Asked parts(scene);
    thin_points(parts, kOnePixel, {}, 300);
    EXPECT_EQ(parts.asked.size(), 4U);
    EXPECT_THAT(parts.asked, Each(Le(300U)));
}

TEST(ThinParts, ReturnTheSamePointsForAnyThreadCount)
{
    const Scene scene = wavy_sheet(10'000);
    const auto by = [&](int threads) {
        return ::vcarve::testing::with_threads(threads, [&] { return thin_in_parts(scene, 3000); });
    };
    const Scene one = by(1);
    expect_equal_scenes(by(2), one);
    expect_equal_scenes(by(3), one);
}

TEST(ThinParts, ReturnTheSamePointsFromFilesAndMemory)
{
    const std::filesystem::path folder = fixtures_folder() / "dense_room";
    const DenseFiles files = {folder / "sparse", ModelFormat::text, folder / "fused.ply",
                              folder / "fused.ply.vis"};
    const Scene whole = read_dense_scene(files);
    constexpr std::size_t kAtOnce = 999;
    PartsOfScene parts(whole);
    DenseSceneReader reader(files);
    const Scene thin = thin_points(reader, {}, {}, kAtOnce);
    EXPECT_LT(thin.num_points(), whole.num_points());
    expect_equal_scenes(thin, thin_points(parts, {}, {}, kAtOnce));
}

} // namespace
} // namespace vcarve::thin_parts_test
