#include "support/photographed_wall.h"
#include "texture/seam_blends.h"

#include <gtest/gtest.h>

namespace vcarve::seam_blends_test {
namespace {

/// The wall of 16 squares a side, 12.5 texels each, halves covered with two photographs.
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

TEST(SeamBlends, LieWithinSixteenTexelsOfASeam)
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

TEST(SeamBlends, AreWholeAtTheSeamAndEndWhereItIsSixteenTexelsAway)
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
            // 40 pixels a unit, times what the photograph is larger.
            if (x > 16.0 / 100.0) {
                EXPECT_GE(blend.far[i], 1.0F);
            }
        }
    }
}

TEST(SeamBlends, BringTheLevelsOfThePhotographFromBeyond)
{
    const auto blends = HalfAndHalf().blends();
    for (const Blend& blend : blends[1]) {
        EXPECT_EQ(blend.levels[0][0], -5.0F);
    }
}

TEST(SeamBlends, AreNoneOfAPhotographThatDoesNotShowTheFace)
{
    HalfAndHalf wall;
    for (PhotosOfFace& photos : wall.photos_of_faces) {
        photos.count = 1; // only photograph 0 is left in the lists
    }
    EXPECT_TRUE(wall.blends()[1].empty());
    EXPECT_FALSE(wall.blends()[0].empty());
}

} // namespace
} // namespace vcarve::seam_blends_test
