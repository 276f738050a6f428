#include "io/formats/unwrap.h"

#include <gtest/gtest.h>

namespace vcarve::unwrap_test {
namespace {

/// Two faces that share an edge: on two pages, or on one with the same places there or others.
struct Sheet {
    TriMesh mesh;
    Texture texture;

    Sheet(std::uint32_t second_page, float shift)
    {
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
        mesh.faces = {{0, 1, 2}, {1, 3, 2}};
        mesh.normals.assign(4, {0, 0, 1});
        mesh.colors.assign(4, {1, 2, 3});
        mesh.offset = {5, 6, 7};
        texture.pages.resize(second_page + 1, Photograph{1, 1, {9, 9, 9}});
        texture.page_of_face = {0, second_page};
        texture.places = {{{{0, 0}, {1, 0}, {0, 1}}},
                          {{{1 + shift, 0}, {1 + shift, 1}, {shift, 1}}}};
    }
};

TEST(Unwrap, LeavesVerticesTogetherThatLieTogetherInThePage)
{
    const Sheet sheet(0, 0.0F);
    const UnwrappedMesh unwrapped = unwrap(sheet.mesh, sheet.texture);
    EXPECT_EQ(unwrapped.mesh.positions.size(), 4U);
    EXPECT_EQ(unwrapped.begins, (std::vector<std::size_t>{0, 2}));
}

TEST(Unwrap, TakesVerticesApartWhereChartsMeet)
{
    const Sheet sheet(0, -0.5F);
    const UnwrappedMesh unwrapped = unwrap(sheet.mesh, sheet.texture);
    EXPECT_EQ(unwrapped.mesh.positions.size(), 6U);
    EXPECT_EQ(unwrapped.mesh.normals.size(), 6U);
    EXPECT_TRUE(unwrapped.mesh.colors.empty());
    EXPECT_EQ(unwrapped.mesh.offset, sheet.mesh.offset);
    for (std::size_t face = 0; face < 2; ++face) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t vertex = unwrapped.mesh.faces[face][i];
            EXPECT_EQ(unwrapped.mesh.positions[vertex],
                      sheet.mesh.positions[sheet.mesh.faces[face][i]]);
            EXPECT_EQ(unwrapped.places[vertex], sheet.texture.places[face][i]);
        }
    }
}

TEST(Unwrap, PutsTheFacesOfAPageTogether)
{
    Sheet sheet(1, 0.0F);
    sheet.texture.page_of_face = {1, 0};
    const UnwrappedMesh unwrapped = unwrap(sheet.mesh, sheet.texture);
    EXPECT_EQ(unwrapped.begins, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(unwrapped.mesh.positions.size(), 6U);
    EXPECT_EQ(unwrapped.mesh.positions[unwrapped.mesh.faces[0][1]], Eigen::Vector3d(1, 1, 0));
}

} // namespace
} // namespace vcarve::unwrap_test
