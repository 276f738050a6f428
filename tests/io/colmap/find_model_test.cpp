#include "io/colmap/find_model.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace vcarve::find_model_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const fs::path kFixtures = fixtures_folder();
const fs::path kBinary = kFixtures / "formats/rich_bin";    // 3 points
const fs::path kText = kFixtures / "formats/rich_txt";      // the same
const fs::path kLattice = kFixtures / "degenerate/lattice"; // 64 points, text
const fs::path kCube = kFixtures / "degenerate/one_view";   // 8 points, text

TEST(FindModel, FindsTheFolderItself)
{
    const FoundModel binary = find_model(kBinary);
    EXPECT_EQ(binary.folder, kBinary);
    EXPECT_EQ(binary.format, ModelFormat::binary);
    EXPECT_THAT(binary.notes, IsEmpty());
    const FoundModel text = find_model(kText);
    EXPECT_EQ(text.folder, kText);
    EXPECT_EQ(text.format, ModelFormat::text);
    EXPECT_THAT(text.notes, IsEmpty());
}

TEST(FindModel, PrefersBinaryToTextWithANote)
{
    const TemporaryFolder folder;
    folder.copy(kBinary, "m");
    fs::copy_file(kText / "points3D.txt", folder.path() / "m/points3D.txt");
    const FoundModel found = find_model(folder.path() / "m");
    EXPECT_EQ(found.format, ModelFormat::binary);
    EXPECT_THAT(found.notes, ElementsAre((folder.path() / "m").string() +
                                         " has .bin and .txt files; reading the .bin files"));
}

TEST(FindModel, ReadsTextIfBinaryIsIncompleteWithANote)
{
    const TemporaryFolder folder;
    folder.copy(kText, "m");
    fs::copy_file(kBinary / "cameras.bin", folder.path() / "m/cameras.bin");
    const FoundModel found = find_model(folder.path() / "m");
    EXPECT_EQ(found.format, ModelFormat::text);
    EXPECT_THAT(found.notes,
                ElementsAre((folder.path() / "m").string() +
                            " has .bin and .txt files; reading the .txt files, because it "
                            "has no images.bin and no points3D.bin"));
}

TEST(FindModel, SelectsTheComponentWithMostPointsAndNamesTheOthers)
{
    const TemporaryFolder folder;
    folder.copy(kBinary, "sparse/0");
    folder.copy(kCube, "sparse/2");
    folder.copy(kLattice, "sparse/10");
    folder.copy(kFixtures / "broken/bin_points_missing", "sparse/11");
    const std::string sparse = (folder.path() / "sparse").string();
    const std::string note =
        "the model has 3 components; using the first one with the most points, " + sparse +
        "/10 (64 points); ignored: " + sparse + "/0 (3 points), " + sparse + "/2 (8 points)";
    for (const fs::path& input : {folder.path(), folder.path() / "sparse"}) {
        const FoundModel found = find_model(input);
        EXPECT_EQ(found.folder, folder.path() / "sparse/10");
        EXPECT_EQ(found.format, ModelFormat::text);
        EXPECT_THAT(found.notes, ElementsAre(note));
    }
}

TEST(FindModel, SelectsTheFirstOfComponentsThatTie)
{
    const TemporaryFolder folder;
    folder.copy(kBinary, "sparse/10");
    folder.copy(kText, "sparse/9");
    const std::string sparse = (folder.path() / "sparse").string();
    const FoundModel found = find_model(folder.path());
    EXPECT_EQ(found.folder, folder.path() / "sparse/9");
    EXPECT_THAT(found.notes,
                ElementsAre("the model has 2 components; using the first one with the "
                            "most points, " +
                            sparse + "/9 (3 points); ignored: " + sparse + "/10 (3 points)"));
}

TEST(FindModel, IgnoresACountThatExceedsTheFile)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "broken/bin_point_count_huge", "sparse/0");
    folder.copy(kBinary, "sparse/1");
    EXPECT_EQ(find_model(folder.path()).folder, folder.path() / "sparse/1");
}

TEST(FindModel, FindsTheOnlyModelOfAWorkspaceWithoutANote)
{
    const TemporaryFolder folder;
    folder.copy(kBinary, "one/sparse/0");
    folder.copy(kText, "two/sparse");
    const FoundModel one = find_model(folder.path() / "one");
    EXPECT_EQ(one.folder, folder.path() / "one/sparse/0");
    EXPECT_THAT(one.notes, IsEmpty());
    const FoundModel two = find_model(folder.path() / "two");
    EXPECT_EQ(two.folder, folder.path() / "two/sparse");
    EXPECT_THAT(two.notes, IsEmpty());
}

TEST(FindModel, SearchesAFewLevelsDownAndNamesOtherModels)
{
    const TemporaryFolder folder;
    folder.copy(kText, "a/colmap/sparse/0");
    EXPECT_EQ(find_model(folder / "a").folder, folder / "a/colmap/sparse/0");
    EXPECT_THAT(find_model(folder / "a").notes, IsEmpty());
    EXPECT_EQ(find_model(folder.path()).folder, folder / "a/colmap/sparse/0");

    folder.copy(kLattice, "a/colmap/sparse/1");
    const FoundModel found = find_model(folder / "a");
    EXPECT_EQ(found.folder, folder / "a/colmap/sparse/1");
    EXPECT_THAT(found.notes,
                ElementsAre("the model has 2 components; using the first one with the "
                            "most points, " +
                            (folder / "a/colmap/sparse/1").string() + " (64 points); ignored: " +
                            (folder / "a/colmap/sparse/0").string() + " (3 points)"));
    folder.copy(kText, "b/1/2/3/4/5");
    EXPECT_THAT(refusal<InputError>([&] { find_model(folder / "b"); }),
                ::testing::HasSubstr("no COLMAP model"));
}

TEST(FindModel, MentionsALargerComponentBesideTheGivenOne)
{
    const TemporaryFolder folder;
    folder.copy(kText, "sparse/0");
    folder.copy(kLattice, "sparse/1");
    folder.copy(kFixtures / "scene/sparse_txt", "sparse/other"); // larger, but no component
    for (const char* const name : {"sparse/0", "sparse/0/"}) {
        const FoundModel found = find_model(folder / name);
        EXPECT_EQ(found.folder, folder / name);
        EXPECT_THAT(found.notes, ElementsAre((folder / name).string() +
                                             " has 3 points; the largest component of the "
                                             "model is " +
                                             (folder / "sparse/1").string() + " (64 points)"));
    }
    EXPECT_THAT(find_model(folder / "sparse/1").notes, IsEmpty());
    EXPECT_THAT(find_model(folder / "sparse/other").notes, IsEmpty());
}

TEST(FindModel, FindsTheModelOfAFileInItWithANote)
{
    const TemporaryFolder folder;
    folder.copy(kBinary, "m");
    for (const char* const name : {"cameras.bin", "images.bin", "points3D.bin"}) {
        const FoundModel found = find_model(folder / "m" / name);
        EXPECT_EQ(found.folder, folder / "m");
        EXPECT_EQ(found.format, ModelFormat::binary);
        EXPECT_THAT(found.notes,
                    ElementsAre((folder / "m" / name).string() + " is a file of the model in " +
                                (folder / "m").string() + "; reading that model"));
    }
    for (const char* const name : {"cameras.txt", "images.txt", "points3D.txt"}) {
        fs::copy_file(kText / name, folder / "m" / name);
    }
    EXPECT_EQ(find_model(folder / "m/images.txt").format, ModelFormat::text);
    EXPECT_EQ(find_model(folder / "m/images.bin").format, ModelFormat::binary);
    EXPECT_EQ(find_model(folder.write("m/rigs.bin", "")).folder, folder / "m");
}

TEST(FindModel, RefusesOtherFilesAndFilesOfIncompleteModels)
{
    const TemporaryFolder folder;
    folder.copy(kBinary, "m");
    EXPECT_THAT(refusal<InputError>([&] { find_model(folder.write("m/notes.txt", "a")); }),
                ::testing::HasSubstr("is not a folder"));
    fs::remove(folder / "m/cameras.bin");
    EXPECT_THAT(refusal<InputError>([&] { find_model(folder / "m/images.bin"); }),
                ::testing::EndsWith("found a model in " + (folder / "m").string() +
                                    " without cameras.bin"));
}

TEST(FindModel, ListsWhatItFoundIfThereIsNoModel)
{
    const TemporaryFolder folder;
    const std::string path = folder.path().string();
    const std::string looked_for =
        ": no COLMAP model found; searched this folder, sparse and their subfolders for cameras, "
        "images and points3D (all .bin or all .txt); found ";
    EXPECT_EQ(refusal<InputError>([&] { find_model(folder.path()); }),
              path + looked_for + "none of these files");

    folder.write("database.db", "");
    folder.write("a.ply", "");
    EXPECT_EQ(refusal<InputError>([&] { find_model(folder.path()); }),
              path + looked_for + "database.db, a.ply");

    folder.write("b.ply", "");
    folder.copy(kFixtures / "broken/bin_points_missing", "sparse/0");
    EXPECT_EQ(refusal<InputError>([&] { find_model(folder.path()); }),
              path + looked_for + "a model in " + path +
                  "/sparse/0 without points3D.bin, database.db, 2 .ply files; run colmap "
                  "point_triangulator to compute points from the poses, or give a cloud with "
                  "--points FILE --rays nearest");
}

TEST(FindModel, RefusesAFolderOfImagesAndNamesTheModelBesideIt)
{
    const TemporaryFolder folder;
    const std::string path = folder.path().string();
    folder.write("images/a.JPG", "");
    folder.write("images/b.png", "");
    EXPECT_EQ(refusal<InputError>([&] { find_model(folder.path() / "images"); }),
              path + "/images is a folder of images; give the model that COLMAP's mapper made of "
                     "them, often sparse/0");
    folder.copy(kBinary, "sparse/0");
    for (const char* name : {"images", "images/"}) {
        EXPECT_EQ(refusal<InputError>([&] { find_model(folder.path() / name); }),
                  (folder.path() / name).string() + " is a folder of images; the model is in " +
                      path + "/sparse/0");
    }
}

TEST(FindModel, RecognizesOtherFilesInsteadOfAModel)
{
    const TemporaryFolder folder;
    const fs::path page = folder.write("model", "<!doctype html><html>");
    EXPECT_EQ(refusal<InputError>([&] { find_model(page); }),
              page.string() + " is a web page, not the file: download it again");
    const fs::path zip = folder.write("model.zip", "PK\x03\x04...");
    EXPECT_EQ(refusal<InputError>([&] { find_model(zip); }),
              zip.string() + " is a zip archive: unpack it first");
}

TEST(FindModel, RefusesAPathThatIsNotAFolder)
{
    const TemporaryFolder folder;
    const fs::path file = folder.write("points.bin", "");
    const std::string what =
        "; a COLMAP model is a folder with cameras, images and points3D as .bin or .txt";
    EXPECT_EQ(refusal<InputError>([&] { find_model(file); }),
              file.string() + ": is not a folder" + what);
    EXPECT_EQ(refusal<InputError>([&] { find_model(folder.path() / "none"); }),
              folder.path().string() + "/none: does not exist" + what);
    fs::create_symlink("loop", folder / "loop");
    EXPECT_EQ(refusal<InputError>([&] { find_model(folder / "loop"); }),
              folder.path().string() + "/loop: cannot be read (Too many levels of symbolic links)" +
                  what);
}

} // namespace
} // namespace vcarve::find_model_test
