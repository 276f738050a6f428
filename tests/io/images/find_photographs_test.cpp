#include "io/images/encode_image.h"
#include "io/images/find_photographs.h"
#include "support/image_files.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::find_photographs_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene scene_of(const std::vector<std::string>& names)
{
    Scene scene;
    scene.cameras.emplace_back();
    for (const std::string& name : names) {
        scene.views.emplace_back().name = name;
    }
    return scene;
}

std::filesystem::path put_photo(const TemporaryFolder& folder, const std::string& name,
                                int width_px)
{
    return folder.write(name, text_of(encode_jpeg(gradient(width_px, 2), 90)));
}

TEST(FindPhotographs, FindsFilesByViewName)
{
    const TemporaryFolder folder;
    const auto first = put_photo(folder, "a.jpg", 3);
    const auto second = put_photo(folder, "left/b.jpg", 5);
    const Photographs found =
        find_photographs(scene_of({"left/b.jpg", "c.jpg", "a.jpg"}), folder.path());
    EXPECT_EQ(found.folder, folder.path());
    EXPECT_THAT(found.of_view, ElementsAre(second, "", first));
    EXPECT_EQ(found.sizes[0].width_px, 5);
    EXPECT_EQ(found.sizes[1].width_px, 0);
    EXPECT_EQ(found.sizes[2].width_px, 3);
    EXPECT_EQ(found.sizes[2].height_px, 2);
    EXPECT_EQ(found.missing, 1U);
    EXPECT_THAT(found.unusable, IsEmpty());
}

TEST(FindPhotographs, IgnoresCaseAndExtensionIfNoFileMatches)
{
    const TemporaryFolder folder;
    const auto first = put_photo(folder, "A.JPG", 3);
    const auto second = put_photo(folder, "Left/b.c.tif", 3);
    const auto third = put_photo(folder, "e.jpg", 3);
    const auto fourth = put_photo(folder, "r_0.png", 3);
    const Photographs found = find_photographs(
        scene_of({"a.png", "left/b.c.png", "d.png", "e.jpg", "e.png", "./r_0"}), folder.path());
    EXPECT_THAT(found.of_view, ElementsAre(first, second, "", third, "", fourth))
        << "e.jpg belongs only to the view of this name";
    EXPECT_EQ(found.missing, 2U);
}

TEST(FindPhotographs, AcceptsBackslashesAsSeparators)
{
    const TemporaryFolder folder;
    const auto photo = put_photo(folder, "left/a.jpg", 3);
    EXPECT_THAT(find_photographs(scene_of({"left\\a.jpg"}), folder.path()).of_view,
                ElementsAre(photo));
}

TEST(FindPhotographs, AcceptsNamesThatBeginWithTheFolder)
{
    const TemporaryFolder folder;
    const auto photo = put_photo(folder, "images/a.jpg", 3);
    const Scene scene = scene_of({"images/a.jpg"});
    EXPECT_THAT(find_photographs(scene, folder.path()).of_view, ElementsAre(photo));
    EXPECT_THAT(find_photographs(scene, folder / "images").of_view, ElementsAre(photo));
}

TEST(FindPhotographs, RejectsOtherAspectRatios)
{
    const TemporaryFolder folder;
    Scene scene = scene_of({"whole.png", "half.png", "turned.png", "cropped.png"});
    scene.cameras[0].width_px = 401;
    scene.cameras[0].height_px = 301;
    const auto put = [&](const std::string& name, int width_px, int height_px) {
        return folder.write(name, text_of(encode_png(gradient(width_px, height_px))));
    };
    const auto whole = put("whole.png", 401, 301);
    const auto half = put("half.png", 200, 150);
    const auto turned = put("turned.png", 301, 401);
    const auto cropped = put("cropped.png", 401, 280);
    const Photographs found = find_photographs(scene, folder.path());
    EXPECT_THAT(found.of_view, ElementsAre(whole, half, "", ""));
    EXPECT_THAT(found.unusable,
                ElementsAre(turned.string() +
                                ": found 301 x 401 pixels, but the camera's images have 401 x 301; "
                                "a photograph may be scaled, but not cropped or rotated",
                            HasSubstr("found 401 x 280 pixels")));
}

TEST(FindPhotographs, NeverLeavesTheFolder)
{
    const TemporaryFolder folder;
    const auto outside = put_photo(folder, "outside.jpg", 3);
    const auto inside = put_photo(folder, "images/inside.jpg", 3);
    const Photographs found = find_photographs(
        scene_of({"../outside.jpg", outside, "x/../../outside.jpg", "", "inside.jpg"}),
        folder / "images");
    EXPECT_THAT(found.of_view, ElementsAre("", "", "", "", inside));
    EXPECT_EQ(found.missing, 4U);
}

TEST(FindPhotographs, ReportsUnusableFiles)
{
    const TemporaryFolder folder;
    const auto good = put_photo(folder, "good.jpg", 3);
    const auto text = folder.write("text.jpg", "no photograph");
    const Photographs found =
        find_photographs(scene_of({"text.jpg", "good.jpg", "gone.jpg"}), folder.path());
    EXPECT_THAT(found.of_view, ElementsAre("", good, ""));
    EXPECT_EQ(found.missing, 1U);
    EXPECT_THAT(found.unusable,
                ElementsAre(HasSubstr(text.string() + ": found an unknown format")));
    EXPECT_THAT(refusal<InputError>([&] {
                    find_photographs(scene_of({"text.jpg", "gone.jpg"}), folder.path());
                }),
                HasSubstr(text.string() + ": found an unknown format"));
}

TEST(FindMasks, AppendsPngToTheNameOrReplacesItsExtension)
{
    const TemporaryFolder folder;
    const auto first = put_photo(folder, "left/a.jpg.png", 3);
    const auto second = put_photo(folder, "b.png", 3);
    const Photographs found =
        find_masks(scene_of({"left/a.jpg", "images/b.jpg", "c.jpg"}), folder.path());
    EXPECT_THAT(found.of_view, ElementsAre(first, second, ""));
    EXPECT_EQ(found.missing, 1U);
    EXPECT_THAT(refusal<InputError>([&] { find_masks(scene_of({"d.jpg"}), folder.path()); }),
                HasSubstr(": found no mask of the 1 views, such as d.jpg"));
}

TEST(FindPhotographs, RefusesFoldersWithoutPhotographs)
{
    const TemporaryFolder folder;
    const std::string path = folder.path().string();
    const auto refused = [&](const std::string& name) {
        return refusal<InputError>([&] {
            find_photographs(scene_of({"left/a.jpg", "b.jpg"}), folder / name);
        });
    };
    EXPECT_EQ(refused("."), path + "/.: found no photograph of the 2 views, such as left/a.jpg; "
                                   "expected the folder that the names of the views are relative "
                                   "to");
    EXPECT_EQ(refused("gone"), path + "/gone: the folder does not exist or cannot be opened; "
                                      "expected the folder of the photographs");
    folder.write("file", "");
    EXPECT_EQ(refused("file"),
              path + "/file: found a file; expected the folder of the photographs");
    EXPECT_THAT(refusal<InputError>([&] { find_photographs(scene_of({}), folder.path()); }),
                HasSubstr("no photograph of the 0 views"));
}

TEST(PhotographsBeside, FindsTheUsualFolders)
{
    const TemporaryFolder folder;
    put_photo(folder, "images/a.jpg", 3);
    folder.write("sparse/0/cameras.bin", "");
    folder.write("other/0/cameras.bin", "");
    const auto canonical = std::filesystem::canonical(folder.path());
    EXPECT_EQ(photographs_beside(folder / "sparse/0"), canonical / "images");
    EXPECT_EQ(photographs_beside(folder / "sparse/0/"), canonical / "images");
    EXPECT_EQ(photographs_beside(folder / "sparse"), canonical / "images");
    EXPECT_EQ(photographs_beside(folder.path()), folder / "images");
    EXPECT_EQ(photographs_beside(folder / "other/0"), std::nullopt);
    EXPECT_EQ(photographs_beside(folder / "other"), std::nullopt);
    EXPECT_EQ(photographs_beside(folder / "gone"), std::nullopt);
    folder.write("nerf/transforms.json", "{}");
    EXPECT_EQ(photographs_beside(folder / "nerf"), canonical / "nerf");
    EXPECT_EQ(photographs_beside(folder / "nerf/transforms.json"), canonical / "nerf");
    put_photo(folder, "studio/images/a.jpg", 3);
    folder.write("studio/colmap/sparse/0/cameras.bin", "");
    EXPECT_EQ(photographs_beside(folder / "studio/colmap/sparse/0"), canonical / "studio/images");
    put_photo(folder, "studio/colmap/images/a.jpg", 3);
    EXPECT_EQ(photographs_beside(folder / "studio/colmap/sparse/0"),
              canonical / "studio/colmap/images");
}

TEST(FindImages, RejectsPhotographsThatNeedMoreThanHalfOfTheMemory)
{
    const TemporaryFolder folder;
    put_photo(folder, "images/a.jpg", 3);
    const Scene scene = scene_of({"a.jpg"});
    Options options;
    options.images = folder / "images";
    Log log;
    const PhotographSize size = find_images(scene, options, {}, log).photographs->sizes[0];
    const std::int64_t needed = std::int64_t{8} * size.width_px * size.height_px;
    options.memory.limit = 2 * needed;
    EXPECT_NO_THROW(find_images(scene, options, {}, log));
    options.memory.limit = 2 * needed - 1;
    EXPECT_THAT(refusal<InputError>([&] { find_images(scene, options, {}, log); }),
                HasSubstr("images: the largest photograph needs "));
}

TEST(FindImages, NeedsAFolderOnlyIfAnOptionReadsPhotographs)
{
    Log log;
    EXPECT_FALSE(find_images(scene_of({"a.jpg"}), {}, {}, log).photographs);
    for (const bool is_dense : {false, true}) {
        Options options;
        options.dense.dense = is_dense;
        options.texture.texture = !is_dense;
        EXPECT_EQ(refusal<UsageError>([&] { find_images(scene_of({"a.jpg"}), options, {}, log); }),
                  "found no folder `images` beside the points; name the folder of the photographs "
                  "with --images");
    }
}

} // namespace
} // namespace vcarve::find_photographs_test
