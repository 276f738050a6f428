#include "mesh/check.h"
#include "support/photographed_wall.h"
#include "support/recording_log.h"
#include "texture/masked_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace vcarve::masked_faces_test {
namespace {

using ::testing::Each;

/// Masks of cameras in front of the wall.
class MaskedWall : public ::testing::Test {
  public:
    /// By default the wall fills the central 80 x 80 of 160 x 120 pixels.
    void add(const IsBlack& is_black, const Eigen::Vector3d& center = {0, 0, -2.5})
    {
        CalibratedPhoto mask = photo_from(center);
        mask.file = folder / (std::to_string(masks.size()) + ".png");
        write_photograph(mask.file, mask_image(160, 120, is_black));
        masks.push_back(mask);
    }

    TriMesh kept_of(const TriMesh& mesh) { return without_masked_faces(mesh, masks, Progress()); }

    TemporaryFolder folder;
    std::vector<CalibratedPhoto> masks;
    TriMesh wall = wall_mesh(6);
};

bool is_right_half(int x, int /*y*/)
{
    return x >= 80;
}

TEST_F(MaskedWall, LosesFacesInMaskedPixels)
{
    add(is_right_half);
    const TriMesh kept = kept_of(wall);
    EXPECT_EQ(kept.faces.size(), wall.faces.size() / 2);
    for (const Eigen::Vector3d& position : kept.positions) {
        EXPECT_LE(position.x(), 1e-9);
    }
    EXPECT_EQ(kept.normals.size(), kept.positions.size());
}

TEST_F(MaskedWall, KeepsFacesInATieOfMaskedAndUnmaskedViews)
{
    add(is_right_half);
    add([](int, int) { return false; }, {0.2, 0, -2.5});
    EXPECT_EQ(kept_of(wall).faces.size(), wall.faces.size());
    add(is_right_half, {0, 0.1, -2.5});
    EXPECT_EQ(kept_of(wall).faces.size(), wall.faces.size() / 2);
}

TEST_F(MaskedWall, KeepsFacesPartlyOutsideTheMask)
{
    // A square of the wall is 13 pixels wide, so the edge of the mask crosses a column of squares.
    add([](int x, int) { return x >= 87; });
    EXPECT_EQ(kept_of(wall).faces.size(), 4U * 12U);
}

TEST_F(MaskedWall, LosesComponentsThatNoViewSeesUnmasked)
{
    TriMesh both = wall;
    for (const Face& face : wall.faces) {
        const auto shift = static_cast<std::uint32_t>(wall.positions.size());
        both.faces.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
    }
    for (const Eigen::Vector3d& position : wall.positions) {
        both.positions.emplace_back(0.5 * position.x(), 0.5 * position.y(), 1.0); // hidden
    }
    add([](int, int) { return false; });
    const TriMesh kept = kept_of(both);
    EXPECT_EQ(kept.faces.size(), wall.faces.size());
    EXPECT_THAT(kept.positions,
                Each(testing::Property(&Eigen::Vector3d::z, testing::DoubleEq(0.0))));
}

TEST_F(MaskedWall, StaysManifoldIfKeptFacesTouchInVertices)
{
    wall = wall_mesh(8); // the checkerboard has 4 x 4 squares of eight faces
    add([](int x, int y) { return ((x / 20) + (y / 20)) % 2 == 0; });
    const TriMesh kept = kept_of(wall);
    EXPECT_EQ(kept.faces.size(), wall.faces.size() / 2);
    const MeshCheck check = check_mesh(kept);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.components, 8);
}

TEST_F(MaskedWall, IsByteIdenticalForAnyThreadCount)
{
    add(is_right_half);
    add([](int x, int y) { return (x * y) % 7 < 4; }, {0.2, 0, -2.5});
    add([](int x, int y) { return x + y > 150; }, {-0.3, 0, -2.0});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const TriMesh kept = kept_of(wall);
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 3);
    EXPECT_EQ(kept_of(wall).faces, kept.faces);
    EXPECT_EQ(kept_of(wall).positions, kept.positions);
}

TEST_F(MaskedWall, IgnoresAnUnreadableMask)
{
    add(is_right_half);
    add([](int, int) { return false; });
    std::filesystem::remove(masks[1].file);
    EXPECT_EQ(kept_of(wall).faces.size(), wall.faces.size() / 2);
}

} // namespace
} // namespace vcarve::masked_faces_test
