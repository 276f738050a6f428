#include "support/photographed_wall.h"
#include "texture/charts.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <map>

namespace vcarve::charts_test {
namespace {

/// The wall in two photographs from the same position, assigned in stripes. The last face has no
/// photograph.
struct Laid {
    TriMesh mesh = wall_mesh(8);
    std::vector<CalibratedPhoto> photos = {photo_from({0, 0, -2}), photo_from({0, 0, -2})};
    std::vector<std::uint32_t> photo_of_face;
    FacesBeside beside;

    Laid()
    {
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            photo_of_face.push_back(face % 16 < 6 ? 0 : 1);
        }
        photo_of_face.back() = kNoPhoto;
        beside = find_faces_beside(mesh);
    }

    Atlas atlas(const AtlasOptions& options = {}) const
    {
        return lay_out_charts(mesh, photos, photo_of_face, beside, options);
    }
};

TEST(Charts, JoinConnectedFacesOfAPhotograph)
{
    EXPECT_EQ(Laid().atlas().num_charts, 2U);
}

TEST(Charts, KeepTheLayoutOfThePhotograph)
{
    const Laid laid;
    const Atlas atlas = laid.atlas();
    for (std::size_t face = 0; face + 1 < laid.mesh.faces.size(); ++face) {
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d edge = laid.mesh.positions[laid.mesh.faces[face][(i + 1) % 3]] -
                                         laid.mesh.positions[laid.mesh.faces[face][i]];
            const Eigen::Vector2d texels =
                atlas.corners[face][(i + 1) % 3] - atlas.corners[face][i];
            EXPECT_TRUE(texels.isApprox(50.0 * edge.head<2>(), 1e-9)); // 100 px at distance 1
        }
    }
}

TEST(Charts, ArePaddedOnAllSides)
{
    const Laid laid;
    const Atlas atlas = laid.atlas();
    std::map<std::uint32_t, Eigen::AlignedBox2d> boxes;
    for (std::size_t face = 0; face < laid.mesh.faces.size(); ++face) {
        for (const Eigen::Vector2d& corner : atlas.corners[face]) {
            boxes[laid.photo_of_face[face]].extend(corner);
        }
    }
    ASSERT_EQ(boxes.size(), 3U);
    for (const auto& [photo, box] : boxes) {
        EXPECT_GE(box.min().minCoeff(), Atlas::kPadding);
        EXPECT_TRUE(
            (box.max().array() + Atlas::kPadding <= atlas.page_sizes[0].cast<double>() + 1e-9)
                .all());
        for (const auto& [other, other_box] : boxes) {
            if (other <= photo) continue;
            EXPECT_GE(box.exteriorDistance(other_box), 2.0 * Atlas::kPadding - 1);
        }
    }
}

TEST(Charts, ContinueOnASecondPage)
{
    const Laid laid;
    const Atlas atlas = laid.atlas({.scale = 1.0, .most_page_px = 120});
    EXPECT_GE(atlas.page_sizes.size(), 2U);
    for (const Eigen::Array2i& size : atlas.page_sizes) {
        EXPECT_LE(size.maxCoeff(), 120);
    }
}

TEST(Charts, ShrinkToFitIntoAPage)
{
    const Laid laid;
    const Atlas atlas = laid.atlas({.scale = 10.0, .most_page_px = 256});
    for (const Eigen::Array2i& size : atlas.page_sizes) {
        EXPECT_LE(size.maxCoeff(), 256);
    }
    EXPECT_GT((atlas.corners[0][1] - atlas.corners[0][0]).norm(), 10.0);
}

TEST(Charts, FollowTheScale)
{
    const Laid laid;
    const Eigen::Vector2d whole = laid.atlas().corners[0][1] - laid.atlas().corners[0][0];
    const Atlas half = laid.atlas({.scale = 0.5});
    EXPECT_TRUE((half.corners[0][1] - half.corners[0][0]).isApprox(0.5 * whole, 1e-9));
}

} // namespace
} // namespace vcarve::charts_test
