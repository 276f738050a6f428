#include "render/photo_scene.h"
#include "render/photograph.h"
#include "support/subprocess.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace vcarve::render::photo_scene_test {

namespace {

using ::testing::HasSubstr;

bool are_equal(const Picture& a, const Picture& b)
{
    return std::ranges::equal(a.pixels, b.pixels, [](const auto& one, const auto& other) {
        return (one == other).all();
    });
}

/// A small rendering of the first view of a scene.
Picture small_picture(const PhotoScene& scene)
{
    Pinhole view = scene.views.front();
    view.focal_px /= 20.0;
    view.principal_px /= 20.0;
    view.width_px /= 20;
    view.height_px /= 20;
    return photograph(scene.parts, view);
}

/// The area vectors of a closed surface add up to zero, even if faces of different sizes share an
/// edge. The volume is positive if the faces are oriented outward.
struct PartSums {
    Eigen::Vector3d area_vector = Eigen::Vector3d::Zero();
    double area = 0.0;
    double volume = 0.0;
};

std::vector<PartSums> sums_of_parts(const Parts& parts)
{
    std::vector<PartSums> sums(parts.paint_of_part.size());
    for (std::size_t i = 0; i < parts.mesh.faces.size(); ++i) {
        const auto& [a, b, c] = parts.mesh.faces[i];
        const Eigen::Vector3d& p = parts.mesh.positions[a];
        const Eigen::Vector3d twice_area =
            (parts.mesh.positions[b] - p).cross(parts.mesh.positions[c] - p);
        PartSums& sum = sums[parts.part_of_face[i]];
        sum.area_vector += twice_area;
        sum.area += twice_area.norm();
        sum.volume += p.dot(twice_area);
    }
    return sums;
}

class EveryPhotoScene : public ::testing::TestWithParam<std::string> {};

} // namespace

TEST_P(EveryPhotoScene, ConsistsOfClosedPartsOrientedOutward)
{
    const PhotoScene scene = photo_scene(GetParam());
    ASSERT_EQ(scene.parts.part_of_face.size(), scene.parts.mesh.faces.size());
    ASSERT_LT(std::ranges::max(scene.parts.part_of_face), scene.parts.paint_of_part.size());
    const std::vector<PartSums> sums = sums_of_parts(scene.parts);
    for (std::size_t part = 0; part < sums.size(); ++part) {
        EXPECT_LT(sums[part].area_vector.norm(), 1e-9 * sums[part].area) << "part " << part;
        EXPECT_GT(sums[part].volume, 0.0) << "part " << part;
    }
}

TEST_P(EveryPhotoScene, IsReproducible)
{
    const PhotoScene first = photo_scene(GetParam());
    const PhotoScene second = photo_scene(GetParam());
    EXPECT_EQ(first.parts.mesh.positions, second.parts.mesh.positions);
    EXPECT_EQ(first.parts.mesh.faces, second.parts.mesh.faces);
    ASSERT_EQ(first.views.size(), second.views.size());
    for (std::size_t i = 0; i < first.views.size(); ++i) {
        EXPECT_EQ(first.views[i].center, second.views[i].center);
        EXPECT_EQ(first.views[i].cam_from_world, second.views[i].cam_from_world);
    }
    EXPECT_TRUE(are_equal(small_picture(first), small_picture(second)));
}

INSTANTIATE_TEST_SUITE_P(All, EveryPhotoScene, ::testing::ValuesIn(photo_scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(PhotoScene, RejectsUnknownNames)
{
    EXPECT_THAT(refusal<UsageError>([] { photo_scene("nowhere"); }), HasSubstr("nowhere"));
}

TEST(Photograph, ShowsTextureOnSurfacesAndGrayBackground)
{
    PartBuilder builder;
    builder.begin_part({});
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(-1, -1, 2), Eigen::Vector3d(0, -1, 2),
                                          Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(-1, 1, 2)}) {
        builder.vertex(corner);
    }
    builder.quad({0, 3, 2, 1});
    Pinhole view;
    view.focal_px = {20.0, 20.0};
    view.principal_px = {10.0, 10.0};
    view.width_px = 20;
    view.height_px = 20;
    const Picture picture = photograph(builder.take(), view);
    float low = 255.0F;
    float high = 0.0F;
    for (int i = 0; i < 400; ++i) {
        const Eigen::Array3f& pixel = picture.pixels[i];
        if (i % 20 >= 10) {
            EXPECT_TRUE((pixel == 128.0F).all()) << "pixel " << i % 20 << ", " << i / 20;
        } else {
            low = std::min(low, pixel[0]);
            high = std::max(high, pixel[0]);
        }
    }
    EXPECT_GT(high - low, 20.0F);
}

TEST(Photograph, GrainDependsOnTheSeedOnly)
{
    const Picture plain{4, 4, std::vector<Eigen::Array3f>(16, Eigen::Array3f::Constant(100.0F))};
    const Grain grain{.blur_px = 0.7, .noise = 3.0};
    EXPECT_TRUE(are_equal(grainy(plain, grain, 1), grainy(plain, grain, 1)));
    EXPECT_FALSE(are_equal(grainy(plain, grain, 1), grainy(plain, grain, 2)));
    EXPECT_TRUE(are_equal(grainy(plain, {}, 1), plain));
}

TEST(RenderViews, ListsTheScenesAndRejectsUnknownNames)
{
    Subprocess list({VCARVE_RENDER_VIEWS, "--list"});
    std::string expected;
    for (const std::string& name : photo_scene_names()) {
        expected += name + "\n";
    }
    EXPECT_EQ(list.wait().out, expected);

    const TemporaryFolder folder;
    Subprocess unknown({VCARVE_RENDER_VIEWS, folder / "out", "nowhere"});
    const Outcome outcome = unknown.wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("render_views: "));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

} // namespace vcarve::render::photo_scene_test
