#include "io/formats/textured_files.h"
#include "io/images/read_photograph.h"
#include "model/photograph.h"
#include "support/read_back.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

namespace vcarve::textured_files_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A sheet on two even pages, red and green.
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

TEST(FilesBeside, AreThePagesAndTheMaterialsOfObj)
{
    EXPECT_THAT(files_beside("a/b.obj", 2), ElementsAre("a/b.mtl", "a/b_0.jpg", "a/b_1.jpg"));
    EXPECT_THAT(files_beside("b.PLY", 1), ElementsAre("b_0.jpg"));
    EXPECT_TRUE(files_beside("b.glb", 3).empty());
}

TEST(TexturedObj, IsReadByAnotherProgram)
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

TEST(TexturedFiles, HoldThePages)
{
    const Textured made;
    write_mesh(made.folder / "sheet.obj", made.mesh, made.format);
    const Photograph page = read_photograph(made.folder / "sheet_1.jpg");
    EXPECT_EQ(page.width_px, 16);
    EXPECT_EQ(page.height_px, 8);
    EXPECT_NEAR(page.rgb[1], 200, 3);
    EXPECT_NEAR(page.rgb[0], 0, 3);
}

TEST(TexturedPly, SaysWhereCornersLie)
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

TEST(TexturedPly, IsReadAgain)
{
    const Textured made;
    write_mesh(made.folder / "sheet.ply", made.mesh, made.format);
    const TriMesh read = read_ply(made.folder / "sheet.ply");
    EXPECT_EQ(read.faces, made.mesh.faces);
    EXPECT_EQ(read.colors, made.mesh.colors);
}

TEST(TexturedGlb, HoldsItsPages)
{
    const Textured made;
    write_mesh(made.folder / "sheet.glb", made.mesh, made.format);
    tinygltf::TinyGLTF loader;
    // Pages are looked at as bytes: the loader here decodes no images.
    loader.SetImageLoader(
        [](tinygltf::Image* image, int, std::string*, std::string*, int, int,
           const unsigned char* bytes, int size, void*) {
            image->image.assign(bytes, bytes + size);
            return true;
        },
        nullptr);
    tinygltf::Model model;
    std::string error;
    std::string warning;
    ASSERT_TRUE(
        loader.LoadBinaryFromFile(&model, &error, &warning, (made.folder / "sheet.glb").string()))
        << error;
    ASSERT_EQ(model.images.size(), 2U);
    EXPECT_EQ(model.images[1].mimeType, "image/jpeg");
    ASSERT_EQ(model.meshes[0].primitives.size(), 2U);
    for (int page = 0; page < 2; ++page) {
        const tinygltf::Primitive& faces = model.meshes[0].primitives[page];
        EXPECT_EQ(faces.material, page);
        EXPECT_EQ(model.materials[page].pbrMetallicRoughness.baseColorTexture.index, page);
        EXPECT_EQ(faces.attributes.count("TEXCOORD_0"), 1U);
        EXPECT_EQ(faces.attributes.count("COLOR_0"), 0U); // would darken the texture
    }
    const std::size_t faces = model.accessors[model.meshes[0].primitives[0].indices].count +
                              model.accessors[model.meshes[0].primitives[1].indices].count;
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
} // namespace vcarve::textured_files_test
