#include "support/photographed_wall.h"
#include "texture/left_out.h"

#include <gtest/gtest.h>

namespace vcarve::left_out_test {
namespace {

/// The wall in its true colours at so many vertices a side.
TriMesh coloured_wall(std::uint32_t squares)
{
    TriMesh mesh = wall_mesh(squares);
    for (const Eigen::Vector3d& at : mesh.positions) {
        const Eigen::Array3d color = wall_color(at.x(), at.y());
        mesh.colors.push_back({static_cast<std::uint8_t>(std::lround(color[0])),
                               static_cast<std::uint8_t>(std::lround(color[1])),
                               static_cast<std::uint8_t>(std::lround(color[2]))});
    }
    return mesh;
}

/// A texture of one page that is the wall from (-1, -1) to (1, 1), on the faces of a mesh.
Texture whole_texture(const TriMesh& mesh, double shifted)
{
    Texture texture;
    Photograph& page = texture.pages.emplace_back(Photograph{200, 200, {}});
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 200; ++x) {
            const Eigen::Array3d color =
                wall_color((x + 0.5) / 100.0 - 1.0 + shifted, (y + 0.5) / 100.0 - 1.0);
            for (const double channel : color) {
                page.rgb.push_back(static_cast<std::uint8_t>(std::lround(channel)));
            }
        }
    }
    texture.page_of_face.resize(mesh.faces.size());
    for (const Face& face : mesh.faces) {
        auto& places = texture.places.emplace_back();
        for (int i = 0; i < 3; ++i) {
            places[i] = (0.5 * (mesh.positions[face[i]].head<2>().array() + 1.0)).cast<float>();
        }
    }
    return texture;
}

struct Left {
    TemporaryFolder folder;
    std::vector<CalibratedPhoto> photos = {photo_from({0.2, 0.1, -1.2})};

    Left()
    {
        photos[0].file = folder / "left.png";
        write_photograph(photos[0].file, photograph_of_wall(photos[0]));
    }
};

TEST(CompareWithPhotos, FindsATrueTextureAlmostTheSame)
{
    const Left left;
    const TriMesh mesh = wall_mesh(2);
    const PhotoLikeness same = compare_with_photos(mesh, whole_texture(mesh, 0.0), left.photos, {});
    EXPECT_GT(same.psnr_db, 45.0);
    EXPECT_GT(same.structure, 0.98);
    EXPECT_EQ(same.photos, 1U);
}

TEST(CompareWithPhotos, FindsAShiftedTextureLessAlike)
{
    const Left left;
    const TriMesh mesh = wall_mesh(2);
    const double same =
        compare_with_photos(mesh, whole_texture(mesh, 0.0), left.photos, {}).psnr_db;
    const double near =
        compare_with_photos(mesh, whole_texture(mesh, 0.05), left.photos, {}).psnr_db;
    const double far = compare_with_photos(mesh, whole_texture(mesh, 0.2), left.photos, {}).psnr_db;
    EXPECT_GT(same, near + 5.0);
    EXPECT_GT(near, far + 5.0);
}

TEST(CompareWithPhotos, TellsHowMuchOfThePhotographTheFrontOfTheSurfaceFills)
{
    const Left left;
    const TriMesh mesh = coloured_wall(4);
    const PhotoLikeness likeness = compare_with_photos(mesh, {}, left.photos, {});
    // From -0.76 to 1 of 1.92 across, from -0.62 to 0.82 of 1.44 down.
    EXPECT_NEAR(likeness.covered, 1.76 / 1.92, 0.02);
    TriMesh turned = mesh;
    for (Face& face : turned.faces) {
        std::swap(face[0], face[1]);
    }
    EXPECT_EQ(compare_with_photos(turned, {}, left.photos, {}).covered, 0.0);
}

TEST(SplitPhotos, LeavesOutEveryFourth)
{
    std::vector<CalibratedPhoto> photos(11, photo_from({0, 0, -1}));
    for (std::uint32_t i = 0; i < photos.size(); ++i) {
        photos[i].view = i;
    }
    const SplitPhotos split = split_photos(photos);
    ASSERT_EQ(split.left_out.size(), 3U);
    EXPECT_EQ(split.left_out[0].view, 2U);
    EXPECT_EQ(split.left_out[2].view, 10U);
    EXPECT_EQ(split.kept.size(), 8U);
}

} // namespace
} // namespace vcarve::left_out_test
