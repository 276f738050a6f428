#include "mesh/check.h"
#include "support/photographed_wall.h"
#include "support/recording_log.h"
#include "texture/masked_faces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <utility>

namespace vcarve::masked_faces_test {
namespace {

/// Masks of cameras in front of the wall.
class MaskedWall : public ::testing::Test {
  public:
    /// By default the wall fills the central 80 x 80 of 160 x 120 pixels.
    void add(const IsBlack& is_black, const Eigen::Vector3d& center = {0, 0, -2.5})
    {
        CalibratedPhoto mask = photo_from(center);
        mask.file = folder / (std::to_string(views.size()) + ".png");
        write_photograph(mask.file, mask_image(160, 120, is_black));
        views.push_back(mask);
    }

    void add_without_mask(const Eigen::Vector3d& center) { views.push_back(photo_from(center)); }

    TriMesh kept_of(const TriMesh& mesh)
    {
        return without_masked_faces(mesh, views, 6, Progress());
    }

    TemporaryFolder folder;
    std::vector<CalibratedPhoto> views;
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

TEST_F(MaskedWall, KeepsFacesThatAsManyViewsWithoutAMaskSee)
{
    add(is_right_half);
    add_without_mask({0.2, 0, -2.5});
    EXPECT_EQ(kept_of(wall).faces.size(), wall.faces.size());
    add(is_right_half, {0, 0.1, -2.5});
    EXPECT_EQ(kept_of(wall).faces.size(), wall.faces.size() / 2);
    for (const double x : {0.3, -0.2, -0.3}) {
        add_without_mask({x, 0, -2.5});
    }
    EXPECT_EQ(kept_of(wall).faces, wall.faces);
}

/// Two walls: the second is smaller, and hidden behind the first.
TriMesh with_hidden_wall(const TriMesh& wall)
{
    TriMesh both = wall;
    for (const Face& face : wall.faces) {
        const auto shift = static_cast<std::uint32_t>(wall.positions.size());
        both.faces.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
    }
    for (const Eigen::Vector3d& position : wall.positions) {
        both.positions.emplace_back(0.5 * position.x(), 0.5 * position.y(), 1.0);
    }
    return both;
}

TEST_F(MaskedWall, KeepsComponentsThatNoViewSees)
{
    add(is_right_half);
    const TriMesh kept = kept_of(with_hidden_wall(wall));
    EXPECT_EQ(kept.faces.size(), wall.faces.size() / 2 + wall.faces.size());
}

TEST_F(MaskedWall, LosesWhatMaskedFacesLeaveIfNoViewSeesIt)
{
    const std::size_t half = wall.faces.size() / 2;
    // A hidden sheet of eight faces behind the wall begins at its lower edge, in the right half.
    for (const double row : {1.0, 2.0}) {
        for (const std::uint32_t corner : {4U, 5U, 6U}) {
            const double x = wall.positions[corner].x();
            wall.positions.emplace_back(0.9 * x, -1.0 + 0.05 * row, 0.3 * row);
        }
    }
    for (const auto& [upper, lower] : {std::pair{4U, 49U}, {49U, 52U}}) {
        for (std::uint32_t i = 0; i < 2; ++i) {
            wall.faces.push_back({upper + i, upper + i + 1, lower + i});
            wall.faces.push_back({upper + i + 1, lower + i + 1, lower + i});
        }
    }
    add([](int x, int) { return x < 80; });
    EXPECT_EQ(kept_of(wall).faces.size(), half + 8) << "faces beside it stay";
    views.clear();
    add(is_right_half);
    EXPECT_EQ(kept_of(wall).faces.size(), half);
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
    add_without_mask({0.7, 0.3, -1.0});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const TriMesh kept = kept_of(wall);
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 3);
    EXPECT_EQ(kept_of(wall).faces, kept.faces);
    EXPECT_EQ(kept_of(wall).positions, kept.positions);
}

TEST_F(MaskedWall, CountsAnUnreadableMaskAsNone)
{
    add(is_right_half);
    add([](int, int) { return true; }, {0.2, 0, -2.5});
    std::filesystem::remove(views[1].file);
    EXPECT_EQ(kept_of(wall).faces.size(), wall.faces.size());
}

TEST(ViewsWithMasks, HaveNoFileWithoutAMask)
{
    Scene scene;
    scene.cameras = {photo_from({0, 0, 0}).camera};
    scene.views = {photo_from({1, 0, 0}).pose, photo_from({2, 0, 0}).pose};
    Photographs masks;
    masks.of_view = {"", "a.png"};
    masks.sizes = {{0, 0}, {80, 60}};
    const std::vector<CalibratedPhoto> views = views_with_masks(scene, masks, {0, 0, 5});
    ASSERT_EQ(views.size(), 2U);
    EXPECT_EQ(views[0].file, "");
    EXPECT_EQ(views[0].size.width_px, 160);
    EXPECT_EQ(views[0].scale.x(), 1.0);
    EXPECT_EQ(views[0].pose.center, Eigen::Vector3d(1, 0, -5));
    EXPECT_EQ(views[1].file, "a.png");
    EXPECT_EQ(views[1].scale.x(), 0.5);
}

} // namespace
} // namespace vcarve::masked_faces_test
