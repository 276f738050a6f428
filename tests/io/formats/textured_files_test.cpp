#include "io/formats/mesh_file.h"
#include "io/formats/textured_files.h"
#include "io/images/encode_image.h"
#include "io/images/read_photograph.h"
#include "model/photograph.h"
#include "support/read_back.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace vcarve::textured_files_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

/// Two faces that share an edge. They are on two pages, or on one page, shifted by `shift`.
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

TEST(Unwrap, KeepsVerticesWithOneTextureCoordinate)
{
    const Sheet sheet(0, 0.0F);
    const UnwrappedMesh unwrapped = unwrap(sheet.mesh, sheet.texture);
    EXPECT_EQ(unwrapped.mesh.positions.size(), 4U);
    EXPECT_EQ(unwrapped.begins, (std::vector<std::size_t>{0, 2}));
}

TEST(Unwrap, DuplicatesVerticesOnSeams)
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

TEST(Unwrap, GroupsFacesByPage)
{
    Sheet sheet(1, 0.0F);
    sheet.texture.page_of_face = {1, 0};
    const UnwrappedMesh unwrapped = unwrap(sheet.mesh, sheet.texture);
    EXPECT_EQ(unwrapped.begins, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(unwrapped.mesh.positions.size(), 6U);
    EXPECT_EQ(unwrapped.mesh.positions[unwrapped.mesh.faces[0][1]], Eigen::Vector3d(1, 1, 0));
}

} // namespace

namespace {

/// A sheet on two single-colored pages, red and green.
struct Textured {
    TemporaryFolder folder;
    TriMesh mesh = sample_sheet();
    Texture texture;
    MeshFormat format;

    Textured()
    {
        for (const Color& color : {Color{200, 0, 0}, Color{0, 200, 0}}) {
            Photograph& page = texture.pages.emplace_back(Photograph{16, 8, {}});
            for (int i = 0; i < 16 * 8; ++i) {
                page.rgb.insert(page.rgb.end(), color.begin(), color.end());
            }
        }
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            texture.page_of_face.push_back(static_cast<std::uint32_t>(face % 2));
            texture.places.push_back({{{0.25F, 0.0F}, {1.0F, 0.125F}, {0.5F, 1.0F}}});
        }
        format.texture = &texture;
    }
};

TEST(FilesBeside, ListsPagesAndObjMaterials)
{
    EXPECT_THAT(files_beside("a/b.obj", 2), ElementsAre("a/b.mtl", "a/b_0.jpg", "a/b_1.jpg"));
    EXPECT_THAT(files_beside("b.PLY", 1), ElementsAre("b_0.jpg"));
    EXPECT_TRUE(files_beside("b.glb", 3).empty());
}

TEST(TexturedObj, IsReadByAssimp)
{
    const Textured made;
    write_mesh(made.folder / "sheet.obj", made.mesh, made.format);
    const TriMesh read = read_by_assimp(made.folder / "sheet.obj");
    EXPECT_EQ(read.faces.size(), made.mesh.faces.size());
    const std::string text = bytes_of(made.folder / "sheet.obj");
    EXPECT_THAT(text, HasSubstr("mtllib sheet.mtl\n"));
    EXPECT_THAT(text, HasSubstr("vt 0.25 1\nvt 1 0.875\nvt 0.5 0\n"));
    EXPECT_THAT(text, HasSubstr("usemtl page_1\nf "));
    EXPECT_THAT(bytes_of(made.folder / "sheet.mtl"), HasSubstr("newmtl page_1"));
    EXPECT_THAT(bytes_of(made.folder / "sheet.mtl"), HasSubstr("map_Kd sheet_1.jpg"));
}

TEST(TexturedFiles, ContainThePages)
{
    const Textured made;
    write_mesh(made.folder / "sheet.obj", made.mesh, made.format);
    const Photograph page = read_photograph(made.folder / "sheet_1.jpg");
    EXPECT_EQ(page.width_px, 16);
    EXPECT_EQ(page.height_px, 8);
    EXPECT_NEAR(page.rgb[1], 200, 3);
    EXPECT_NEAR(page.rgb[0], 0, 3);
}

TEST(TexturedPly, HasTextureCoordinatesOfCorners)
{
    Textured made;
    made.format.ascii = true;
    write_mesh(made.folder / "sheet.ply", made.mesh, made.format);
    const std::string text = bytes_of(made.folder / "sheet.ply");
    EXPECT_THAT(text,
                HasSubstr("comment TextureFile sheet_0.jpg\ncomment TextureFile sheet_1.jpg"));
    EXPECT_THAT(text, HasSubstr("property list uchar float texcoord\nproperty int texnumber\n"));
    EXPECT_THAT(text, HasSubstr(" 6 0.25 1 1 0.875 0.5 0 1\n"));
}

TEST(TexturedPly, RoundTrips)
{
    const Textured made;
    write_mesh(made.folder / "sheet.ply", made.mesh, made.format);
    const TriMesh read = read_ply(made.folder / "sheet.ply");
    EXPECT_EQ(read.faces, made.mesh.faces);
    EXPECT_EQ(read.colors, made.mesh.colors);
}

TEST(TexturedGlb, EmbedsItsPages)
{
    const Textured made;
    write_mesh(made.folder / "sheet.glb", made.mesh, made.format);
    const std::string bytes = bytes_of(made.folder / "sheet.glb");
    std::uint32_t text_bytes = 0;
    std::memcpy(&text_bytes, bytes.data() + 12, sizeof(text_bytes));
    const auto json = nlohmann::json::parse(bytes.substr(20, text_bytes));
    ASSERT_EQ(json["images"].size(), 2U);
    EXPECT_EQ(json["images"][1]["mimeType"], "image/jpeg");
    const auto jpeg = encode_jpeg(made.format.texture->pages[1], kTextureQuality);
    const auto& view = json["bufferViews"][json["images"][1]["bufferView"].get<std::size_t>()];
    EXPECT_EQ(bytes.substr(28 + text_bytes + view["byteOffset"].get<std::size_t>(),
                           view["byteLength"].get<std::size_t>()),
              std::string(jpeg.begin(), jpeg.end()));
    const auto& primitives = json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2U);
    std::size_t faces = 0;
    for (std::size_t page = 0; page < 2; ++page) {
        const auto& drawn = primitives[page];
        EXPECT_EQ(drawn["material"], page);
        EXPECT_EQ(json["materials"][page]["pbrMetallicRoughness"]["baseColorTexture"]["index"],
                  page);
        EXPECT_TRUE(drawn["attributes"].contains("TEXCOORD_0"));
        EXPECT_FALSE(drawn["attributes"].contains("COLOR_0")); // they would darken the texture
        faces += json["accessors"][drawn["indices"].get<std::size_t>()]["count"].get<std::size_t>();
    }
    EXPECT_EQ(faces, 3 * made.mesh.faces.size());
    EXPECT_EQ(read_by_assimp(made.folder / "sheet.glb").faces.size(), made.mesh.faces.size());
}

TEST(TexturedFiles, AppearAllOrNone)
{
    const Textured made;
    std::filesystem::create_directory(made.folder / "sheet.mtl");
    EXPECT_THROW(write_mesh(made.folder / "sheet.obj", made.mesh, made.format), UsageError);
    EXPECT_FALSE(std::filesystem::exists(made.folder / "sheet.obj"));
    EXPECT_FALSE(std::filesystem::exists(made.folder / "sheet_0.jpg"));
}

} // namespace

} // namespace
} // namespace vcarve::textured_files_test
