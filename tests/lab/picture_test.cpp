#include "render/picture.h"
#include "render/shade.h"
#include "support/subprocess.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <vector>

namespace vcarve::render {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Picture picture_of(int width_px, int height_px, std::vector<Eigen::Array3f> pixels)
{
    return {width_px, height_px, std::move(pixels)};
}

/// Three bytes a pixel, and the size.
struct Bytes {
    unsigned width = 0;
    unsigned height = 0;
    std::vector<std::uint8_t> bytes;
};

Bytes read_png(const std::filesystem::path& path)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
    image.format = PNG_FORMAT_RGB;
    Bytes result{image.width, image.height, {}};
    result.bytes.resize(PNG_IMAGE_SIZE(image));
    png_image_finish_read(&image, nullptr, result.bytes.data(), 0, nullptr);
    return result;
}

} // namespace

TEST(Picture, ShrunkHoldsTheMeanOfEachSquareAndLeavesOutTheRest)
{
    std::vector<Eigen::Array3f> pixels;
    for (int i = 0; i < 15; ++i) {
        pixels.emplace_back(static_cast<float>(i), static_cast<float>(2 * i), 4.0F);
    }
    const Picture half = shrunk(picture_of(5, 3, pixels), 2);
    EXPECT_EQ(half.width_px, 2);
    EXPECT_EQ(half.height_px, 1);
    ASSERT_EQ(half.pixels.size(), 2U);
    EXPECT_TRUE((half.pixels[0] == Eigen::Array3f(3.0F, 6.0F, 4.0F)).all());
    EXPECT_TRUE((half.pixels[1] == Eigen::Array3f(5.0F, 10.0F, 4.0F)).all());
}

TEST(Picture, WritesEightBitsAChannelRoundedAndClamped)
{
    const TemporaryFolder folder;
    const auto path = folder / "two.png";
    write_png(path, picture_of(2, 1, {{0.4F, 0.5F, 254.5F}, {-7.0F, 300.0F, 128.0F}}));
    const Bytes read = read_png(path);
    EXPECT_EQ(read.width, 2U);
    EXPECT_EQ(read.height, 1U);
    EXPECT_THAT(read.bytes, ElementsAre(0, 1, 255, 0, 255, 128));
}

TEST(Picture, RefusesAPlaceItCannotWriteTo)
{
    const TemporaryFolder folder;
    const auto path = folder / "no_folder/one.png";
    EXPECT_THAT(refusal<UsageError>([&] {
                    write_png(path, picture_of(1, 1, {{0, 0, 0}}));
                }),
                HasSubstr(path.string() + ": cannot write the picture: "));
}

TEST(RenderMesh, WritesWhatShadeShowsOfTheWholeMesh)
{
    const TemporaryFolder folder;
    const std::string solid = VCARVE_FIXTURES "/paper/cube_with_cavity/solid.ply";
    Subprocess program({VCARVE_RENDER_MESH, solid, folder / "solid.png", "--width", "60"});
    const Outcome outcome = program.wait();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

    const TriMesh mesh = read_ply(solid);
    const Pinhole view = view_of_whole(mesh, {{-1.0, -2.0, 1.5}, {0.0, 0.0, 1.0}}, 60);
    write_png(folder / "expected.png", shade(mesh, view, {}));
    const Bytes expected = read_png(folder / "expected.png");
    EXPECT_EQ(expected.bytes.size(), 3U * 60U * 45U);
    EXPECT_EQ(read_png(folder / "solid.png").bytes, expected.bytes);
}

TEST(RenderMesh, RefusesAnImageTheModelDoesNotHave)
{
    const TemporaryFolder folder;
    const std::string object = VCARVE_FIXTURES "/paper/cube_with_cavity";
    Subprocess program({VCARVE_RENDER_MESH, object + "/solid.ply", folder / "solid.png", "--model",
                        object, "--image", "nobody"});
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.err, "render_mesh: the model has no image with the id or name nobody\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "solid.png"));
}

} // namespace vcarve::render
