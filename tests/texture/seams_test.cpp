#include "support/photographed_wall.h"
#include "texture/seams.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

namespace vcarve::seams_test {
namespace {

/// The wall with 16 x 16 squares of 12.5 texels. Each half has a photograph.
struct HalfAndHalf {
    TriMesh mesh = wall_mesh(16);
    std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -1}), photo_from({0, 0, -1})};
    std::vector<PhotosOfFace> photos_of_faces;
    std::vector<std::uint32_t> photo_of_face;
    Atlas atlas;
    CornerLevels levels;

    HalfAndHalf() : photos_of_faces(mesh.faces.size())
    {
        for (CalibratedPhoto& photo : photos) {
            photo.size = {400, 400};
            photo.scale = {2.5, 400.0 / 120.0};
            photo.camera.params = {40, 80, 60};
        }
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            photo_of_face.push_back(middle(face).x() < 0.0 ? 0 : 1);
            photos_of_faces[face].count = 2;
            photos_of_faces[face].best[0] = {0, 100.0F};
            photos_of_faces[face].best[1] = {1, 100.0F};
            const float level = photo_of_face.back() == 0 ? 5.0F : -5.0F;
            levels.push_back({Eigen::Array3f::Constant(level), Eigen::Array3f::Constant(level),
                              Eigen::Array3f::Constant(level)});
        }
        atlas = lay_out_charts(mesh, photos, photo_of_face, find_faces_beside(mesh), {});
    }

    Eigen::Vector3d middle(std::size_t face) const
    {
        return (mesh.positions[mesh.faces[face][0]] + mesh.positions[mesh.faces[face][1]] +
                mesh.positions[mesh.faces[face][2]]) /
               3.0;
    }

    std::vector<std::vector<Blend>> blends() const
    {
        auto blends = find_blends(mesh, photos_of_faces, photo_of_face, atlas, levels);
        blends.resize(2);
        return blends;
    }
};

TEST(SeamBlends, ReachSixteenTexelsFromASeam)
{
    const HalfAndHalf wall;
    const auto blends = wall.blends();
    for (std::uint32_t photo : {0U, 1U}) {
        EXPECT_FALSE(blends[photo].empty());
        for (const Blend& blend : blends[photo]) {
            EXPECT_EQ(wall.photo_of_face[blend.face], 1 - photo);
            EXPECT_LT(std::abs(wall.middle(blend.face).x()), 2.0 * 2.0 / 16.0);
        }
    }
}

TEST(SeamBlends, FadeWithTheDistanceToTheSeam)
{
    const HalfAndHalf wall;
    const auto blends = wall.blends();
    for (const Blend& blend : blends[1]) {
        const Face& face = wall.mesh.faces[blend.face];
        for (int i = 0; i < 3; ++i) {
            const double x = std::abs(wall.mesh.positions[face[i]].x());
            if (x < 1e-9) {
                EXPECT_EQ(blend.far[i], 0.0F);
            } else {
                EXPECT_GT(blend.far[i], 0.5F);
            }
            // 40 camera pixels per unit, 2.5 photograph pixels per camera pixel.
            if (x > 16.0 / 100.0) {
                EXPECT_GE(blend.far[i], 1.0F);
            }
        }
    }
}

TEST(SeamBlends, UseTheLevelsOfThePhotographFromBeyond)
{
    const auto blends = HalfAndHalf().blends();
    for (const Blend& blend : blends[1]) {
        EXPECT_EQ(blend.levels[0][0], -5.0F);
    }
}

TEST(SeamBlends, SkipPhotographsThatDoNotShowTheFace)
{
    HalfAndHalf wall;
    for (PhotosOfFace& photos : wall.photos_of_faces) {
        photos.count = 1; // only photograph 0 remains in the lists
    }
    EXPECT_TRUE(wall.blends()[1].empty());
    EXPECT_FALSE(wall.blends()[0].empty());
}

/// The wall with photograph 0 on the left half and photograph 1 on the right half. Photograph 1 is
/// brighter by `brighter` levels.
struct BrighterHalf {
    TriMesh mesh = wall_mesh(8);
    std::vector<PhotosOfFace> photos;
    FaceColors colors;
    std::vector<std::uint32_t> photo_of_face;

    explicit BrighterHalf(std::uint8_t brighter)
        : photos(mesh.faces.size()), colors(mesh.faces.size())
    {
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            const Face& corners = mesh.faces[face];
            const double x = mesh.positions[corners[0]].x() + mesh.positions[corners[1]].x() +
                             mesh.positions[corners[2]].x();
            photo_of_face.push_back(x < 0.0 ? 0 : 1);
            photos[face].count = 2;
            photos[face].best[0] = {0, 100.0F};
            photos[face].best[1] = {1, 100.0F};
            colors[face][0].fill({100, 100, 100});
            const auto bright = static_cast<std::uint8_t>(100 + brighter);
            colors[face][1].fill({bright, bright, bright});
        }
    }
};

TEST(SeamLevels, RemoveTheStepAtASeam)
{
    const BrighterHalf wall(30);
    const CornerLevels levels = level_seams(wall.mesh, wall.photos, wall.colors,
                                            Gains(2, Eigen::Array3f::Ones()), wall.photo_of_face);
    std::map<std::uint32_t, std::array<double, 2>> at_vertex; // levels; 0: not shown
    for (std::size_t face = 0; face < wall.mesh.faces.size(); ++face) {
        const std::uint32_t photo = wall.photo_of_face[face];
        for (int i = 0; i < 3; ++i) {
            at_vertex[wall.mesh.faces[face][i]][photo] =
                100.0 + 30.0 * photo + static_cast<double>(levels[face][i][0]);
        }
    }
    int seams = 0;
    for (const auto& [vertex, shown] : at_vertex) {
        if (shown[0] == 0.0 || shown[1] == 0.0) continue;
        EXPECT_NEAR(shown[0], shown[1], 1.5) << vertex;
        ++seams;
    }
    EXPECT_EQ(seams, 9);
}

TEST(SeamLevels, AreZeroIfPhotographsAgree)
{
    const BrighterHalf wall(0);
    const CornerLevels levels = level_seams(wall.mesh, wall.photos, wall.colors,
                                            Gains(2, Eigen::Array3f::Ones()), wall.photo_of_face);
    for (const auto& corners : levels) {
        EXPECT_NEAR(corners[0].abs().maxCoeff(), 0.0, 1e-6);
    }
}

TEST(SeamLevels, CompareColorsAfterTheGains)
{
    const BrighterHalf wall(25);
    const Gains gains = {Eigen::Array3f::Constant(1.25F), Eigen::Array3f::Ones()};
    const CornerLevels levels =
        level_seams(wall.mesh, wall.photos, wall.colors, gains, wall.photo_of_face);
    for (const auto& corners : levels) {
        EXPECT_NEAR(corners[0].abs().maxCoeff(), 0.0, 1e-4);
    }
}

TEST(SeamLevels, AreZeroIfTheEquationsHaveNoFiniteSolution)
{
    const BrighterHalf wall(25);
    const float infinity = std::numeric_limits<float>::infinity();
    const Gains gains = {Eigen::Array3f::Constant(infinity), Eigen::Array3f::Ones()};
    const CornerLevels levels =
        level_seams(wall.mesh, wall.photos, wall.colors, gains, wall.photo_of_face);
    for (const auto& corners : levels) {
        EXPECT_EQ(corners[0].abs().maxCoeff(), 0.0F);
    }
}

} // namespace
} // namespace vcarve::seams_test
