#include "support/photographed_wall.h"
#include "texture/seam_levels.h"

#include <gtest/gtest.h>

#include <map>

namespace vcarve::seam_levels_test {
namespace {

/// The wall, left of the middle covered with photograph 0, right of it with photograph 1, which
/// shows everything brighter by so many levels.
struct HalfAndHalf {
    TriMesh mesh = wall_mesh(8);
    std::vector<PhotosOfFace> photos;
    FaceColors colors;
    std::vector<std::uint32_t> photo_of_face;

    explicit HalfAndHalf(std::uint8_t brighter)
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

TEST(SeamLevels, LeaveNoStepAtASeam)
{
    const HalfAndHalf wall(30);
    const CornerLevels levels = level_seams(wall.mesh, wall.photos, wall.colors,
                                            Gains(2, Eigen::Array3f::Ones()), wall.photo_of_face);
    std::map<std::uint32_t, std::array<double, 2>> at_vertex; // of each photograph, 0 for none
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

TEST(SeamLevels, AreNothingWherePhotographsAgree)
{
    const HalfAndHalf wall(0);
    const CornerLevels levels = level_seams(wall.mesh, wall.photos, wall.colors,
                                            Gains(2, Eigen::Array3f::Ones()), wall.photo_of_face);
    for (const auto& corners : levels) {
        EXPECT_NEAR(corners[0].abs().maxCoeff(), 0.0, 1e-6);
    }
}

TEST(SeamLevels, TakeExposuresAsTheyAreAfterTheGains)
{
    const HalfAndHalf wall(25);
    const Gains gains = {Eigen::Array3f::Constant(1.25F), Eigen::Array3f::Ones()};
    const CornerLevels levels =
        level_seams(wall.mesh, wall.photos, wall.colors, gains, wall.photo_of_face);
    for (const auto& corners : levels) {
        EXPECT_NEAR(corners[0].abs().maxCoeff(), 0.0, 1e-4);
    }
}

} // namespace
} // namespace vcarve::seam_levels_test
