#include "geometry/triangle.h"
#include "support/photographed_wall.h"
#include "texture/texture_mesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>

namespace vcarve::texture_mesh_test {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

/// Writes photographs of the wall to a folder.
class PhotographedWall {
  public:
    void add(const Vector3d& center, const Array3d& exposure = {1.0, 1.0, 1.0},
             const std::function<void(int, int, Array3d&)>& paint_over = {})
    {
        CalibratedPhoto photo = photo_from(center);
        photo.view = static_cast<std::uint32_t>(photos.size());
        photo.file = folder / (std::to_string(photos.size()) + ".png");
        write_photograph(photo.file, photograph_of_wall(photo, exposure, paint_over));
        photos.push_back(photo);
    }

    TemporaryFolder folder;
    std::vector<CalibratedPhoto> photos;
};

/// A textured mesh, and what its faces show.
struct TexturedWall : TexturedMesh {
    std::vector<std::int32_t> view_of_face;
    std::vector<std::string> problems;
};

/// All steps of texturing.
TexturedWall textured(TriMesh mesh, const std::vector<CalibratedPhoto>& photos,
                      const TextureLimits& limits = {})
{
    TexturedWall made;
    MeshPhotos shown = {.of_faces = find_photos_of_faces(mesh, photos, {})};
    color_mesh(mesh, photos, limits.photos_at_a_time, shown, {});
    PaintedTexture painted = paint_texture(mesh, photos, shown, limits, {});
    made.mesh = std::move(mesh);
    made.texture = std::move(painted.texture);
    made.view_of_face = std::move(painted.view_of_face);
    made.problems = std::move(shown.problems);
    return made;
}

/// The texel at a position of a page, in texture coordinates.
Array3d texel_at(const Photograph& page, const Eigen::Vector2f& place)
{
    const int x = std::min(static_cast<int>(place.x() * static_cast<float>(page.width_px)),
                           page.width_px - 1);
    const int y = std::min(static_cast<int>(place.y() * static_cast<float>(page.height_px)),
                           page.height_px - 1);
    const std::uint8_t* rgb =
        page.rgb.data() + 3 * (static_cast<std::size_t>(y) * page.width_px + x);
    return {rgb[0] * 1.0, rgb[1] * 1.0, rgb[2] * 1.0};
}

/// The largest difference of a channel between the texture and the wall times `gain`, in levels of
/// 255, over samples of all faces.
double worst_difference(const TexturedWall& made, const Array3d& gain = {1.0, 1.0, 1.0})
{
    double worst = 0.0;
    for (std::size_t face = 0; face < made.mesh.faces.size(); ++face) {
        const Photograph& page = made.texture.pages[made.texture.page_of_face[face]];
        const auto [a, b, c] = corners_of(made.mesh.positions, made.mesh.faces[face]);
        for (const auto& [u, v] :
             {std::pair(0.3F, 0.3F), {0.6F, 0.2F}, {0.1F, 0.1F}, {0.2F, 0.7F}}) {
            const auto& places = made.texture.places[face];
            const Eigen::Vector2f place =
                (1.0F - u - v) * places[0] + u * places[1] + v * places[2];
            const Vector3d at =
                (1.0 - u - v) * a + static_cast<double>(u) * b + static_cast<double>(v) * c;
            const Array3d difference = texel_at(page, place) - gain * wall_color(at.x(), at.y());
            worst = std::max(worst, difference.abs().maxCoeff());
        }
    }
    return worst;
}

TEST(TextureMesh, ReproducesTheColorsOfTheWall)
{
    PhotographedWall wall;
    wall.add({-0.5, 0, -2.5});
    wall.add({0.5, 0, -2.5});
    wall.add({0.0, 0.3, -2.6});
    const TexturedWall made = textured(wall_mesh(6), wall.photos);
    EXPECT_LT(worst_difference(made), 6.0); // half a texel of the steepest color is 3 levels
}

TEST(TextureMesh, EqualizesExposures)
{
    PhotographedWall wall;
    wall.add({-0.5, 0, -2.5}, {0.8, 0.8, 0.85});
    wall.add({0.5, 0, -2.5}, {1.2, 1.2, 1.15});
    wall.add({0.0, 0.3, -2.6});
    const TexturedWall made = textured(wall_mesh(6), wall.photos);
    EXPECT_LT(worst_difference(made), 20.0); // 40 levels without gains
}

TEST(TextureMesh, HidesTheSeamsBetweenCharts)
{
    PhotographedWall wall;
    wall.add({-0.5, 0, -1.2}, {0.8, 0.8, 0.85});
    wall.add({0.5, 0, -1.2}, {1.2, 1.2, 1.15});
    const TexturedWall made = textured(wall_mesh(20), wall.photos);
    std::map<std::array<std::uint32_t, 2>, std::size_t> face_of_edge;
    std::vector<double> steps;
    for (std::size_t face = 0; face < made.mesh.faces.size(); ++face) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = made.mesh.faces[face][i];
            const std::uint32_t to = made.mesh.faces[face][(i + 1) % 3];
            face_of_edge[{from, to}] = 3 * face + i;
            const auto other = face_of_edge.find({to, from});
            if (other == face_of_edge.end()) continue;
            if (made.view_of_face[other->second / 3] == made.view_of_face[face]) continue;
            const auto middle = [&](std::size_t half_edge) {
                const auto& places = made.texture.places[half_edge / 3];
                return texel_at(made.texture.pages[made.texture.page_of_face[half_edge / 3]],
                                0.5F * (places[half_edge % 3] + places[(half_edge + 1) % 3]));
            };
            const Array3d step = middle(3 * face + i) - middle(other->second);
            steps.push_back(step.abs().maxCoeff());
        }
    }
    ASSERT_GT(steps.size(), 10U);
    std::ranges::sort(steps);
    EXPECT_LE(steps[steps.size() / 2], 2.0);
}

TEST(TextureMesh, ReducesTheScaleIfThereAreTooManyTexels)
{
    PhotographedWall wall;
    wall.add({0, 0, -2.2});
    const TexturedWall whole = textured(wall_mesh(4), wall.photos);
    const TexturedWall small = textured(wall_mesh(4), wall.photos, {.most_texels = 2000});
    EXPECT_LT(small.texture.pages[0].rgb.size(), whole.texture.pages[0].rgb.size() / 2);
    EXPECT_LT(worst_difference(small), 25.0);
}

TEST(TextureMesh, IgnoresAnOccluderInOnePhotograph)
{
    const auto passer_by = [](int x, int y, Array3d& color) {
        if (x > 60 && x < 110 && y > 20) color = {255.0, 0.0, 255.0};
    };
    PhotographedWall wall;
    wall.add({0.0, 0.0, -2.4}, {1.0, 1.0, 1.0}, passer_by); // the nearest photograph
    wall.add({-0.3, 0, -2.5});
    wall.add({0.3, 0, -2.5});
    wall.add({0.0, 0.2, -2.5});
    const TexturedWall made = textured(wall_mesh(20), wall.photos);
    std::size_t magenta = 0;
    for (const Photograph& page : made.texture.pages) {
        for (std::size_t i = 0; i + 2 < page.rgb.size(); i += 3) {
            magenta += page.rgb[i] > 200 && page.rgb[i + 1] < 60 && page.rgb[i + 2] > 200 ? 1 : 0;
        }
    }
    EXPECT_LT(magenta, 200U); // the passer-by has 2,200 pixels, and some lie within faces
}

TEST(TextureMesh, FillsUnseenFacesWithTheColorsAroundThem)
{
    PhotographedWall wall;
    wall.add({0.9, 0, -1.0});
    const TexturedWall made = textured(wall_mesh(12), wall.photos);
    std::size_t unseen = 0;
    for (std::size_t face = 0; face < made.mesh.faces.size(); ++face) {
        if (made.view_of_face[face] >= 0) continue;
        ++unseen;
        const auto& places = made.texture.places[face];
        const Array3d color = texel_at(made.texture.pages[made.texture.page_of_face[face]],
                                       (places[0] + places[1] + places[2]) / 3.0F);
        EXPECT_GT(color.minCoeff(), 40.0) << face;
        EXPECT_LT(color.maxCoeff(), 190.0) << face;
    }
    EXPECT_GT(unseen, 0U);
    EXPECT_LT(unseen, made.mesh.faces.size());
}

TEST(TextureMesh, ColorsVerticesFromThePhotographs)
{
    PhotographedWall wall;
    wall.add({-0.2, 0, -2.5});
    wall.add({0.2, 0, -2.5});
    TexturedWall made;
    made.mesh = wall_mesh(16);
    MeshPhotos shown = {.of_faces = find_photos_of_faces(made.mesh, wall.photos, {})};
    color_mesh(made.mesh, wall.photos, 4, shown, {});
    for (std::size_t vertex = 0; vertex < made.mesh.positions.size(); ++vertex) {
        const Vector3d& at = made.mesh.positions[vertex];
        const Color& color = made.mesh.colors[vertex];
        const Array3d difference =
            Array3d(color[0], color[1], color[2]) - wall_color(at.x(), at.y());
        EXPECT_LT(difference.abs().maxCoeff(), 12.0) << at.transpose();
    }
}

TEST(TextureMesh, IsByteIdenticalForAnyThreadCount)
{
    PhotographedWall wall;
    for (int i = 0; i < 7; ++i) {
        wall.add({0.2 * i - 0.6, 0.1 * (i % 3), -2.2 - 0.1 * (i % 2)},
                 {0.8 + 0.05 * i, 1.0, 1.1 - 0.03 * i});
    }
    std::map<int, TexturedWall> made;
    for (const int threads : {1, 2, 5}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        made[threads] = textured(wall_mesh(10), wall.photos);
    }
    for (const int threads : {2, 5}) {
        EXPECT_EQ(made[threads].mesh.positions, made[1].mesh.positions);
        EXPECT_EQ(made[threads].mesh.faces, made[1].mesh.faces);
        EXPECT_EQ(made[threads].mesh.colors, made[1].mesh.colors);
        EXPECT_EQ(made[threads].texture.page_of_face, made[1].texture.page_of_face);
        ASSERT_EQ(made[threads].texture.pages.size(), made[1].texture.pages.size());
        for (std::size_t page = 0; page < made[1].texture.pages.size(); ++page) {
            EXPECT_EQ(made[threads].texture.pages[page].rgb, made[1].texture.pages[page].rgb);
        }
    }
}

TEST(TextureMesh, IsEmptyForASurfaceWithoutFaces)
{
    PhotographedWall wall;
    wall.add({0, 0, -2.5});
    const TexturedWall made = textured({}, wall.photos);
    EXPECT_TRUE(made.mesh.faces.empty());
    EXPECT_TRUE(made.texture.is_empty());
}

TEST(TextureMesh, SkipsAnUnreadablePhotographAndNamesIt)
{
    PhotographedWall wall;
    wall.add({0, 0, -2.5});
    wall.add({0.1, 0, -2.0});
    wall.folder.write("1.png", bytes_of(wall.photos[1].file).substr(0, 900));
    const TexturedWall made = textured(wall_mesh(4), wall.photos);
    EXPECT_LT(worst_difference(made), 12.0) << "the other photograph shows all faces";
    ASSERT_EQ(made.problems.size(), 1U);
    EXPECT_NE(made.problems[0].find("1.png: found a PNG that cannot be read"), std::string::npos);
}

TEST(TextureMesh, IgnoresTransparentPixels)
{
    const auto made_over = [](const Array3d& hidden) {
        PhotographedWall wall;
        wall.add({-0.6, 0, -1.7}); // does not show the right edge
        wall.add({0.1, 0, -2.0});
        const auto cut = [&](int x, int /*y*/, Array3d& color) {
            if (x < 80) color = hidden;
        };
        Photograph image = photograph_of_wall(wall.photos[1], {1.0, 1.0, 1.0}, cut);
        for (int i = 0; i < image.width_px * image.height_px; ++i) {
            image.alpha.push_back(i % image.width_px < 80 ? 0 : 255);
        }
        write_cutout(wall.photos[1].file, image);
        return textured(wall_mesh(8), wall.photos);
    };
    const TexturedWall green = made_over({0, 255, 0});
    const TexturedWall red = made_over({255, 0, 0});
    EXPECT_LT(worst_difference(green), 12.0);
    EXPECT_EQ(green.mesh.colors, red.mesh.colors);
    ASSERT_EQ(green.texture.pages.size(), red.texture.pages.size());
    EXPECT_EQ(green.texture.pages[0].rgb, red.texture.pages[0].rgb);
    EXPECT_EQ(std::ranges::count(green.view_of_face, -1), 0);
    EXPECT_GT(std::ranges::count(green.view_of_face, 1), 0) << "the opaque half is used";
}

TEST(TextureMesh, DoesNotDependOnThePhotographsInMemory)
{
    PhotographedWall wall;
    for (int i = 0; i < 5; ++i) {
        wall.add({0.2 * i - 0.4, 0, -2.5});
    }
    const TexturedWall made = textured(wall_mesh(6), wall.photos);
    const TexturedWall one = textured(wall_mesh(6), wall.photos, {.photos_at_a_time = 1});
    EXPECT_EQ(one.texture.pages[0].rgb, made.texture.pages[0].rgb);
    EXPECT_EQ(one.mesh.colors, made.mesh.colors);
}

} // namespace
} // namespace vcarve::texture_mesh_test
