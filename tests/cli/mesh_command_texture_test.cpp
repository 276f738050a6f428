// colmap-vcarve --images and --texture, as their users meet them.
#include "io/images/encode_image.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::mesh_command_texture_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A model with photographs beside it that are all of one colour.
class TextureOfProgram : public ::testing::Test {
  protected:
    TextureOfProgram()
    {
        fs::create_directories(folder / "sparse");
        fs::copy(fixtures_folder() / "scene/sparse/0", folder / "sparse/0");
        Log log;
        scene = read_model(folder / "sparse/0", log);
        for (const View& view : scene.views) {
            write_photo(view.name);
        }
    }

    void write_photo(const std::string& name) const
    {
        const int width_px = 64;
        const int height_px = 48;
        Photograph photo{width_px, height_px, {}};
        for (int i = 0; i < width_px * height_px; ++i) {
            photo.rgb.insert(photo.rgb.end(), {120, 60, 30});
        }
        const auto bytes = encode_jpeg(photo, 95);
        folder.write("images/" + name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }

    Outcome run(const std::vector<std::string>& more) const
    {
        std::vector<std::string> words = {model};
        words.insert(words.end(), more.begin(), more.end());
        return run_program(words);
    }

    TemporaryFolder folder;
    std::string model = folder / "sparse/0";
    std::string images = folder / "images";
    Scene scene;
};

TEST_F(TextureOfProgram, IsInTheGlb)
{
    const std::string out = folder / "out.glb";
    const Outcome outcome = run({out, "--texture"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("photographs are taken from"));
    EXPECT_THAT(outcome.err, HasSubstr("charts on 1 page"));
    EXPECT_THAT(bytes_of(out), HasSubstr("\"mimeType\":\"image/jpeg\""));
}

TEST_F(TextureOfProgram, IsBesideTheObj)
{
    ASSERT_EQ(run({folder / "out.obj", "--texture", "--quiet"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "out.mtl"));
    EXPECT_TRUE(fs::exists(folder / "out_0.jpg"));
}

TEST_F(TextureOfProgram, GivesVerticesTheColoursOfThePhotographs)
{
    ASSERT_EQ(run({folder / "out.ply", "--images", images, "--quiet"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(folder / "out_0.jpg"));
    const TriMesh mesh = read_ply(folder / "out.ply");
    std::size_t same = 0;
    for (const Color& color : mesh.colors) {
        same += std::abs(color[0] - 120) < 5 && std::abs(color[1] - 60) < 5 &&
                        std::abs(color[2] - 30) < 5
                    ? 1
                    : 0;
    }
    EXPECT_GT(same, mesh.colors.size() * 9 / 10);
}

TEST_F(TextureOfProgram, SaysWhichViewsHaveNoPhotograph)
{
    fs::remove(fs::path(images) / scene.views[0].name);
    folder.write("images/" + scene.views[1].name, "some text");
    const Outcome outcome = run({folder / "out.ply", "--images", images});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("1 of "));
    EXPECT_THAT(outcome.err, HasSubstr("views have no photograph in"));
    EXPECT_THAT(outcome.err, HasSubstr(scene.views[1].name));
}

TEST_F(TextureOfProgram, IsRefusedWithoutPhotographs)
{
    fs::remove_all(images);
    const Outcome outcome = run({folder / "out.glb", "--texture"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("say with --images where they are"));
    EXPECT_FALSE(fs::exists(folder / "out.glb"));
    EXPECT_EQ(run({folder / "out.glb", "--images", folder / "none"}).exit_code, 3);
}

TEST_F(TextureOfProgram, IsRefusedInFormatsThatHoldNone)
{
    const Outcome outcome = run({folder / "out.stl", "--texture"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(".glb, .obj or .ply"));
    EXPECT_EQ(run({folder / "out.glb", "--texture-scale", "2"}).exit_code, 2);
}

TEST_F(TextureOfProgram, ReplacesNoPhotograph)
{
    // Photographs that were converted, one of which is called as the first page of scan.obj would
    // be.
    std::string bytes = bytes_of(model + "/images.bin");
    const std::string name = "view_00.png";
    bytes.replace(bytes.find(name), name.size(), "scanx_0.png");
    folder.write("sparse/0/images.bin", bytes);
    fs::remove_all(images);
    write_photo("scanx_0.jpg");
    const std::string before = bytes_of(images + "/scanx_0.jpg");
    const Outcome outcome = run({images + "/scanx.obj", "--texture"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the texture would replace the"));
    EXPECT_EQ(bytes_of(images + "/scanx_0.jpg"), before);
    const std::string photos = folder / "photos";
    fs::rename(images, photos);
    EXPECT_THAT(run({photos + "/scanx.obj", "--texture", "--images", photos}).err,
                HasSubstr("the texture would replace the photograph"));
    EXPECT_EQ(bytes_of(photos + "/scanx_0.jpg"), before);
}

} // namespace
} // namespace vcarve::mesh_command_texture_test
