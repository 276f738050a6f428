#include "support/photographed_wall.h"
#include "texture/paint.h"

#include <gtest/gtest.h>

namespace vcarve::paint_test {
namespace {

/// Two faces in one photograph, and a third without a photograph.
struct Painted {
    TemporaryFolder folder;
    TriMesh mesh = wall_mesh(1);
    std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -2})};
    std::vector<std::uint32_t> photo_of_face = {0, 0, kNoPhoto};
    Atlas atlas;
    Gains gains = {Eigen::Array3f::Ones()};
    CornerLevels levels;
    std::vector<std::vector<Blend>> blends{1};

    Painted()
    {
        mesh.positions.insert(mesh.positions.end(), {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}});
        mesh.faces.push_back({4, 5, 6});
        mesh.colors.assign(7, {10, 200, 30});
        photos[0].file = folder / "0.png";
        write_photograph(photos[0].file, photograph_of_wall(photos[0]));
        atlas = lay_out_charts(mesh, photos, photo_of_face, find_faces_beside(mesh), {});
        levels.assign(3, {Eigen::Array3f::Zero(), Eigen::Array3f::Zero(), Eigen::Array3f::Zero()});
    }

    std::vector<Photograph> pages() const
    {
        return paint_pages({mesh, photos, photo_of_face, atlas, gains, levels, blends, 4}, {});
    }
};

Eigen::Array3d texel(const Photograph& page, const Eigen::Vector2d& place)
{
    const auto x = static_cast<std::size_t>(place.x());
    const auto y = static_cast<std::size_t>(place.y());
    const std::uint8_t* rgb =
        page.rgb.data() + 3 * (y * static_cast<std::size_t>(page.width_px) + x);
    return {rgb[0] * 1.0, rgb[1] * 1.0, rgb[2] * 1.0};
}

TEST(PaintPages, ShowsThePhotographOnItsFaces)
{
    const Painted painted;
    const Photograph page = painted.pages()[0];
    const auto& corners = painted.atlas.corners[0];
    const Eigen::Vector2d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    // 50 texels per unit; the wall is sampled at the texel's center.
    const Eigen::Vector2d off = (middle.array().floor() + 0.5 - middle.array()).matrix() / 50.0;
    const double third = -1.0 / 3.0;
    EXPECT_LT((texel(page, middle) - wall_color(third + off.x(), third + off.y())).abs().maxCoeff(),
              2.0);
}

TEST(PaintPages, PaintsUnseenFacesWithVertexColors)
{
    const Painted painted;
    const auto& corners = painted.atlas.corners[2];
    EXPECT_TRUE(texel(painted.pages()[0], (corners[0] + corners[1] + corners[2]) / 3.0)
                    .isApprox(Eigen::Array3d(10, 200, 30)));
}

TEST(PaintPages, AddsTheLevelsAtCorners)
{
    Painted painted;
    const auto& corners = painted.atlas.corners[0];
    const Eigen::Vector2d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Eigen::Array3d before = texel(painted.pages()[0], middle);
    painted.levels[0].fill(Eigen::Array3f(12, 0, -12));
    EXPECT_TRUE((texel(painted.pages()[0], middle) - before).isApprox(Eigen::Array3d(12, 0, -12)));
}

TEST(PaintPages, BlendsBothPhotographsEquallyAtASeam)
{
    Painted painted;
    const auto& corners = painted.atlas.corners[0];
    const Eigen::Vector2d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Eigen::Array3d before = texel(painted.pages()[0], middle);
    // The photograph itself, 20 levels brighter.
    const Eigen::Array3f brighter = Eigen::Array3f::Constant(20.0F);
    painted.blends[0] = {{0, 0, {0.0F, 0.0F, 0.0F}, {brighter, brighter, brighter}}};
    EXPECT_NEAR((texel(painted.pages()[0], middle) - before).mean(), 10.0, 0.6);
    painted.blends[0][0].far = {1.0F, 1.0F, 1.0F};
    EXPECT_NEAR((texel(painted.pages()[0], middle) - before).mean(), 0.0, 0.1);
}

TEST(PaintPages, ExtendsColorsAroundCharts)
{
    const Painted painted;
    const Photograph page = painted.pages()[0];
    const auto& corners = painted.atlas.corners[0]; // its first corner is the chart's
    const Eigen::Array3d inside = texel(page, corners[0] + Eigen::Vector2d(1.0, 1.0));
    const Eigen::Array3d outside = texel(page, corners[0] - Eigen::Vector2d(2.0, -1.0));
    EXPECT_LT((inside - outside).abs().maxCoeff(), 12.0);
}

} // namespace
} // namespace vcarve::paint_test
