#include "support/photographed_wall.h"
#include "texture/vertex_colors.h"

#include <gtest/gtest.h>

namespace vcarve::vertex_colors_test {
namespace {

/// A strip of faces. Three photographs show the first `shown` of them.
struct Strip {
    TriMesh mesh;
    std::vector<PhotosOfFace> photos;
    FaceColors colors;

    explicit Strip(std::size_t shown)
    {
        for (std::uint32_t i = 0; i < 10; ++i) {
            mesh.positions.emplace_back(i, i % 2, 0);
            if (i >= 2) mesh.faces.push_back({i - 2, i - 1, i});
        }
        photos.resize(mesh.faces.size());
        colors.resize(mesh.faces.size());
        for (std::size_t face = 0; face < shown; ++face) {
            photos[face].count = 3;
            for (std::uint32_t i = 0; i < 3; ++i) {
                photos[face].best[i] = {i, 100.0F};
            }
            colors[face][0].fill({100, 50, 20});
            colors[face][1].fill({104, 54, 20});
            colors[face][2].fill({250, 250, 250}); // an occluder
        }
    }
};

const Gains kNoGains(3, Eigen::Array3f::Ones());

TEST(ColorVertices, AveragesPhotographsNearTheMedian)
{
    Strip strip(8);
    EXPECT_EQ(color_vertices(strip.photos, strip.colors, kNoGains, strip.mesh), 10U);
    for (const Color& color : strip.mesh.colors) {
        EXPECT_EQ(color, (Color{102, 52, 20}));
    }
}

TEST(ColorVertices, AppliesGains)
{
    Strip strip(8);
    const Gains gains(3, Eigen::Array3f(0.5F, 1.0F, 2.0F));
    color_vertices(strip.photos, strip.colors, gains, strip.mesh);
    EXPECT_EQ(strip.mesh.colors[0], (Color{51, 52, 40}));
}

TEST(ColorVertices, SpreadsColorsToUnseenVertices)
{
    Strip strip(2);
    EXPECT_EQ(color_vertices(strip.photos, strip.colors, kNoGains, strip.mesh), 4U);
    EXPECT_EQ(strip.mesh.colors.back(), (Color{102, 52, 20}));
}

TEST(ColorVertices, KeepsTheColorsOfUnseenComponents)
{
    Strip strip(0);
    strip.mesh.colors.assign(10, {1, 2, 3});
    EXPECT_EQ(color_vertices(strip.photos, strip.colors, kNoGains, strip.mesh), 0U);
    EXPECT_EQ(strip.mesh.colors[4], (Color{1, 2, 3}));
    strip.mesh.colors.clear();
    color_vertices(strip.photos, strip.colors, kNoGains, strip.mesh);
    EXPECT_EQ(strip.mesh.colors[4], (Color{160, 160, 160}));
}

} // namespace
} // namespace vcarve::vertex_colors_test
