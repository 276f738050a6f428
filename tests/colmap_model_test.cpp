#include "io/colmap_model.h"
#include "io/find_model.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::ElementsAre;

const fs::path kFixtures = VCARVE_FIXTURES;
constexpr const char* kStems[] = {"cameras", "images", "points3D"};

Scene read_fixture(const std::string& name)
{
    const FoundModel found = find_model(kFixtures / name);
    return read_colmap_model(found.folder, found.format);
}

template <typename T>
std::vector<T> row(std::span<const T> values)
{
    return {values.begin(), values.end()};
}

void expect_equal_scenes(const Scene& a, const Scene& b)
{
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(a.cameras[i].id, b.cameras[i].id);
        EXPECT_EQ(a.cameras[i].model, b.cameras[i].model);
        EXPECT_EQ(a.cameras[i].width_px, b.cameras[i].width_px);
        EXPECT_EQ(a.cameras[i].height_px, b.cameras[i].height_px);
        EXPECT_EQ(a.cameras[i].params, b.cameras[i].params);
    }
    ASSERT_EQ(a.views.size(), b.views.size());
    for (std::size_t i = 0; i < a.views.size(); ++i) {
        EXPECT_EQ(a.views[i].id, b.views[i].id);
        EXPECT_EQ(a.views[i].camera, b.views[i].camera);
        EXPECT_EQ(a.views[i].name, b.views[i].name);
        EXPECT_EQ(a.views[i].cam_from_world.coeffs(), b.views[i].cam_from_world.coeffs());
        EXPECT_EQ(a.views[i].center, b.views[i].center);
    }
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.errors_px, b.errors_px);
    EXPECT_EQ(a.point_ids, b.point_ids);
    EXPECT_EQ(a.tracks.begins, b.tracks.begins);
    EXPECT_EQ(a.tracks.views, b.tracks.views);
    EXPECT_EQ(a.offset, b.offset);
}

void expect_well_formed(const Scene& scene)
{
    for (const View& view : scene.views) {
        EXPECT_LT(view.camera, scene.cameras.size());
        EXPECT_NEAR(view.cam_from_world.norm(), 1.0, 1e-15);
        EXPECT_TRUE(view.center.allFinite());
    }
    ASSERT_EQ(scene.colors.size(), scene.num_points());
    ASSERT_EQ(scene.errors_px.size(), scene.num_points());
    ASSERT_EQ(scene.point_ids.size(), scene.num_points());
    ASSERT_EQ(scene.tracks.size(), scene.num_points());
    ASSERT_EQ(scene.tracks.begins.back(), scene.tracks.views.size());
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        const auto track = row(scene.tracks[i]);
        EXPECT_TRUE(std::is_sorted(track.begin(), track.end(), std::less_equal<>()));
        EXPECT_TRUE(track.empty() || track.back() < scene.views.size());
    }
}

TEST(ColmapModel, HoldsWhatTheFilesSay)
{
    const Scene scene = read_fixture("formats/rich_bin");
    expect_well_formed(scene);

    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.cameras[0].id, 3U);
    EXPECT_EQ(scene.cameras[0].model, 1);
    EXPECT_EQ(scene.cameras[1].id, 12U);
    EXPECT_EQ(scene.cameras[1].model, 2);
    EXPECT_EQ(scene.cameras[1].width_px, 640U);
    EXPECT_EQ(scene.cameras[1].height_px, 480U);
    EXPECT_THAT(scene.cameras[1].params, ElementsAre(700.0, 320.5, 240.25, -0.0125));

    ASSERT_EQ(scene.views.size(), 3U);
    EXPECT_EQ(scene.views[0].id, 7U);
    EXPECT_EQ(scene.views[0].camera, 0U);
    EXPECT_EQ(scene.views[0].name, "K\xC3\xB6ln \xE5\xAF\xBA 7.png");
    EXPECT_EQ(scene.views[1].id, 40U);
    EXPECT_EQ(scene.views[1].camera, 1U);
    EXPECT_EQ(scene.views[1].name, "left room/IMG 0001.jpg");
    EXPECT_EQ(scene.views[2].id, 100000U);
    EXPECT_EQ(scene.views[2].camera, 1U);
    EXPECT_EQ(scene.views[2].name, "c.jpg");

    EXPECT_THAT(scene.positions,
                ElementsAre(Vector3d(0.1, 1.0 / 3.0, -2e-7),
                            Vector3d(1e6 + 0.1, std::numeric_limits<double>::denorm_min(), 4.6e6),
                            Vector3d(1, 2, 3)));
    EXPECT_THAT(scene.colors,
                ElementsAre(Color{0, 128, 255}, Color{255, 255, 255}, Color{1, 2, 3}));
    EXPECT_THAT(scene.errors_px, ElementsAre(0.5, -1.0, 0.0));
    EXPECT_THAT(scene.point_ids, ElementsAre(900U, 2U, 18446744073709551614U));
    // The first track is images 100000, 7, 40 and 7 once more
    EXPECT_THAT(scene.tracks.begins, ElementsAre(0U, 3U, 4U, 4U));
    EXPECT_THAT(scene.tracks.views, ElementsAre(0U, 1U, 2U, 1U));
    EXPECT_EQ(scene.offset, Vector3d::Zero());
}

TEST(ColmapModel, KeepsPosesWhole)
{
    const Scene scene = read_fixture("formats/rich_bin");
    ASSERT_EQ(scene.views.size(), 3U);
    // A quaternion of length 2 is the identity all the same
    EXPECT_EQ(scene.views[0].cam_from_world.coeffs(), Eigen::Vector4d(0, 0, 0, 1));
    EXPECT_EQ(scene.views[0].center, Vector3d(-1, -2, -3));
    // 120 degrees about (1, -1, 1): x goes to z, y to -x, z to -y
    Eigen::Matrix3d rotation;
    rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    EXPECT_TRUE(scene.views[1].cam_from_world.toRotationMatrix().isApprox(rotation, 1e-15));
    EXPECT_TRUE(scene.views[1].center.isApprox(Vector3d(-3, 0.1, -2.5), 1e-15));
    // Cosine -0.28 and sine 0.96 about y
    EXPECT_TRUE(scene.views[2].center.isApprox(Vector3d(4.8e6, 0, 1.4e6), 1e-15));
}

TEST(ColmapModel, IsTheSameInEitherFormat)
{
    const Scene binary = read_fixture("formats/rich_bin");
    expect_equal_scenes(binary, read_fixture("formats/rich_txt"));
    expect_equal_scenes(binary, read_fixture("formats/rich_txt_by_hand"));
}

TEST(ColmapModel, KnowsEveryCameraModelOfColmap)
{
    const std::vector<std::size_t> num_params{3, 4,  4,  5, 8, 8, 12, 5, 4,
                                              5, 12, 16, 4, 5, 3, 4,  6, 2};
    const Scene scene = read_fixture("formats/cameras_bin");
    ASSERT_EQ(scene.cameras.size(), num_params.size());
    for (std::size_t i = 0; i < num_params.size(); ++i) {
        EXPECT_EQ(scene.cameras[i].model, static_cast<int>(i));
        ASSERT_EQ(scene.cameras[i].params.size(), num_params[i]);
        EXPECT_EQ(scene.cameras[i].params[1], 100.0 * static_cast<double>(i) + 1.5);
    }
    expect_equal_scenes(scene, read_fixture("formats/cameras_txt"));
}

TEST(ColmapModel, KeepsACameraOfUnknownModelInText)
{
    const Scene scene = read_fixture("formats/camera_unknown_txt");
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].model, -1);
    EXPECT_THAT(scene.cameras[0].params, ElementsAre(1, 2, 3, 4, 5, 6, 7));
}

TEST(ColmapModel, ReadsLinesOfMegabytes)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "formats/rich_txt", "model");
    std::string points2d;
    for (int i = 0; i < 200'000; ++i) {
        points2d += "123.456 654.321 -1 ";
    }
    std::string track;
    for (int i = 0; i < 200'000; ++i) {
        track += i % 2 == 0 ? " 1 0" : " 2 7";
    }
    folder.write("model/images.txt",
                 "1 1 0 0 0 0 0 0 3 a\n" + points2d + "\n2 1 0 0 0 0 0 0 3 b\n");
    folder.write("model/points3D.txt", "1 0 0 0 0 0 0 1" + track + "\n");
    const Scene scene = read_colmap_model(folder.path() / "model", ModelFormat::text);
    EXPECT_EQ(scene.views.size(), 2U);
    EXPECT_THAT(scene.tracks.views, ElementsAre(0U, 1U));
}

TEST(ColmapModel, TakesAnErrorThatIsNotANumberForUnknown)
{
    const TemporaryFolder folder;
    folder.copy(kFixtures / "formats/rich_txt", "model");
    folder.write("model/points3D.txt", "1 0 0 0 0 0 0 nan\n2 0 0 0 0 0 0 inf\n");
    const Scene scene = read_colmap_model(folder.path() / "model", ModelFormat::text);
    EXPECT_THAT(scene.errors_px, ElementsAre(-1.0, std::numeric_limits<double>::infinity()));
}

/// What is said of fixtures/broken/NAME, after the path of that folder.
using Refusal = std::pair<const char*, const char*>;

const std::vector<Refusal> kBinaryRefusals{
    {"bin_camera_count_huge", "/cameras.bin: byte 0: found a count of 1152921504606846976 cameras, "
                              "but the rest of the file can hold 2 at most"},
    {"bin_camera_model_99",
     "/cameras.bin: camera 1 is of model 99, which is not known, and neither "
     "is the number of its parameters (a model as text can be read)"},
    {"bin_camera_twice", "/cameras.bin: camera 1 occurs twice"},
    {"bin_cameras_trailing", "/cameras.bin: byte 64: expected the end of the file after the last "
                             "camera, found more bytes: 3"},
    {"bin_cameras_truncated", "/cameras.bin: byte 56: the file ends inside the parameters of a "
                              "camera (bytes expected: 8, found: 3)"},
    {"bin_image_camera_unknown",
     "/images.bin: image 1 (a.jpg) uses camera 7, which cameras.bin does not have"},
    {"bin_image_count_huge",
     "/images.bin: byte 0: found a count of 1152921504606846976 images, but "
     "the rest of the file can hold 3 at most"},
    {"bin_image_name_open",
     "/images.bin: byte 72: the file ends inside the name of an image (no zero byte closes it)"},
    {"bin_image_rotation_nan", "/images.bin: image 1 (a.jpg) has a pose that is not finite"},
    {"bin_image_rotation_zero",
     "/images.bin: image 1 (a.jpg) has a rotation quaternion of length zero"},
    {"bin_image_translation_nan", "/images.bin: image 1 (a.jpg) has a pose that is not finite"},
    {"bin_image_twice", "/images.bin: image 1 (b.jpg) has the id of image 1 (a.jpg)"},
    {"bin_images_points2d_huge", "/images.bin: byte 78: found a count of 1152921504606846976 2D "
                                 "points, but the rest of the file can hold 6 at most"},
    {"bin_images_trailing", "/images.bin: byte 236: expected the end of the file after the last "
                            "image, found more bytes: 1"},
    {"bin_images_truncated", "/images.bin: byte 204: found a count of 1 2D points, but the rest of "
                             "the file can hold 0 at most"},
    {"bin_point_count_huge", "/points3D.bin: byte 0: found a count of 1152921504606846976 points, "
                             "but the rest of the file can hold 2 at most"},
    {"bin_point_image_unknown",
     "/points3D.bin: point 5 was seen in image 9, which images.bin does not have"},
    {"bin_point_twice", "/points3D.bin: point 5 occurs twice"},
    {"bin_points_empty_file", "/points3D.bin: byte 0: the file ends inside the number of points "
                              "(bytes expected: 8, found: 0)"},
    {"bin_points_missing", "/points3D.bin: the file does not exist"},
    {"bin_points_track_huge",
     "/points3D.bin: byte 51: found a count of 1152921504606846976 views in "
     "a track, but the rest of the file can hold 9 at most"},
    {"bin_points_trailing", "/points3D.bin: byte 134: expected the end of the file after the last "
                            "point, found more bytes: 4"},
    {"bin_points_truncated",
     "/points3D.bin: byte 118: found a count of 1 views in a track, but the "
     "rest of the file can hold 0 at most"},
};

const std::vector<Refusal> kTextRefusals{
    {"txt_camera_params_few",
     "/cameras.txt: line 2: found 3 parameters of a PINHOLE camera, which has 4"},
    {"txt_camera_size_missing",
     "/cameras.txt: line 2: the line ends where the height of the camera should stand"},
    {"txt_camera_width_word", "/cameras.txt: line 2: found 'wide' where the width of the camera, a "
                              "whole number of 64 bits, should stand"},
    {"txt_image_camera_unknown",
     "/images.txt: image 1 (a.jpg) uses camera 7, which cameras.txt does not have"},
    {"txt_image_id_negative", "/images.txt: line 4: found '-2' where the id of an image, a whole "
                              "number of 32 bits, should stand"},
    {"txt_image_name_missing",
     "/images.txt: line 2: the line ends where the name of the image should stand"},
    {"txt_image_rotation_nan", "/images.txt: image 1 (a.jpg) has a pose that is not finite"},
    {"txt_image_rotation_zero",
     "/images.txt: image 1 (a.jpg) has a rotation quaternion of length zero"},
    {"txt_image_twice", "/images.txt: image 1 (b.jpg) has the id of image 1 (a.jpg)"},
    {"txt_images_points2d_left_out",
     "/images.txt: line 3: found 'b.jpg' at the end of the line, which should hold the 2D points "
     "of "
     "the image on the line before, as x, y and point id, or nothing"},
    {"txt_images_pose_cut",
     "/images.txt: line 2: the line ends where the translation of the image should stand"},
    {"txt_point_color_300", "/points3D.txt: line 2: found '300' where the colour of the point, a "
                            "whole number from 0 to 255, should stand"},
    {"txt_point_coordinate_1e999", "/points3D.txt: line 2: found '1e999' where the position of the "
                                   "point, a number, should stand"},
    {"txt_point_coordinate_word", "/points3D.txt: line 2: found '5,0' where the position of the "
                                  "point, a number, should stand"},
    {"txt_point_error_missing",
     "/points3D.txt: line 2: the line ends where the error of the point should stand"},
    {"txt_point_image_unknown",
     "/points3D.txt: point 1 was seen in image 9, which images.txt does not have"},
    {"txt_point_track_odd", "/points3D.txt: line 2: the line ends where the index of a 2D point in "
                            "the track should stand"},
    {"txt_point_twice", "/points3D.txt: point 1 occurs twice"},
};

void expect_refusals(const std::vector<Refusal>& refusals, ModelFormat format)
{
    for (const auto& [name, sentence] : refusals) {
        const fs::path folder = kFixtures / "broken" / name;
        EXPECT_EQ(input_error([&] { read_colmap_model(folder, format); }),
                  folder.string() + sentence);
    }
}

TEST(ColmapModel, RefusesBrokenBinaryFilesWithASentence)
{
    expect_refusals(kBinaryRefusals, ModelFormat::binary);
}

TEST(ColmapModel, RefusesBrokenTextFilesWithASentence)
{
    expect_refusals(kTextRefusals, ModelFormat::text);
}

TEST(ColmapModel, HasASentenceForEveryBrokenFixture)
{
    const auto folders = std::distance(fs::directory_iterator(kFixtures / "broken"), {});
    EXPECT_EQ(static_cast<std::size_t>(folders), kBinaryRefusals.size() + kTextRefusals.size());
}

TEST(ColmapModel, ReadsEveryDegenerateFixture)
{
    struct Sizes {
        const char* name;
        std::size_t views, points, sights;
    };
    const std::vector<Sizes> expected{
        {"collinear_points", 4, 8, 32},
        {"coplanar_points", 4, 16, 64},
        {"duplicated_positions", 4, 16, 40},
        {"four_points", 4, 4, 16},
        {"huge_position", 4, 9, 36},
        {"identical_points", 4, 8, 32},
        {"infinite_position", 4, 9, 36},
        {"lattice", 4, 64, 256},
        {"nan_position", 4, 9, 36},
        {"no_points", 4, 0, 0},
        {"no_tracks", 4, 8, 0},
        {"no_views", 0, 0, 0},
        {"one_view", 1, 8, 8},
        {"point_behind_camera", 4, 9, 34},
        {"point_seen_from_where_it_is", 5, 8, 40},
        {"three_points", 4, 3, 12},
        {"view_on_point", 5, 8, 39},
    };
    for (const Sizes& sizes : expected) {
        SCOPED_TRACE(sizes.name);
        const Scene scene = read_fixture(std::string("degenerate/") + sizes.name);
        expect_well_formed(scene);
        EXPECT_EQ(scene.views.size(), sizes.views);
        EXPECT_EQ(scene.num_points(), sizes.points);
        EXPECT_EQ(scene.num_sights(), sizes.sights);
    }
    const auto folders = std::distance(fs::directory_iterator(kFixtures / "degenerate"), {});
    EXPECT_EQ(static_cast<std::size_t>(folders), expected.size());
}

TEST(ColmapModel, PutsTheViewExactlyOnThePointItCoincidesWith)
{
    const Scene scene = read_fixture("degenerate/view_on_point");
    EXPECT_EQ(scene.views[4].center, scene.positions[0]);
}

// ---- files cut and bytes flipped
// -----------------------------------------------------------------

struct FileBytes {
    std::string name;
    std::string bytes;
};

std::vector<FileBytes> files_of(const std::string& fixture, const std::string& extension)
{
    std::vector<FileBytes> files;
    for (const char* stem : kStems) {
        const std::string name = stem + extension;
        std::ifstream stream(kFixtures / fixture / name, std::ios::binary);
        EXPECT_TRUE(stream) << name;
        files.push_back({name, {std::istreambuf_iterator<char>(stream), {}}});
    }
    return files;
}

/// Whether there is a scene, which must be well-formed; anything thrown but InputError gets
/// through.
bool reads(const fs::path& folder, ModelFormat format)
{
    try {
        expect_well_formed(read_colmap_model(folder, format));
        return true;
    } catch (const InputError&) {
        return false;
    }
}

void write_all(const TemporaryFolder& folder, const std::vector<FileBytes>& files)
{
    for (const FileBytes& file : files) {
        folder.write(file.name, file.bytes);
    }
}

/// How many of the cuts, at every byte of every file, leave a model that can be read.
int count_readable_cuts(const std::vector<FileBytes>& files, ModelFormat format)
{
    const TemporaryFolder folder;
    int readable = 0;
    for (const FileBytes& file : files) {
        write_all(folder, files);
        for (std::size_t length = 0; length < file.bytes.size(); ++length) {
            folder.write(file.name, std::string_view(file.bytes).substr(0, length));
            readable += reads(folder.path(), format) ? 1 : 0;
        }
    }
    return readable;
}

/// How many of 3000 models with one to three bytes changed can be read.
int count_readable_flips(const std::vector<FileBytes>& files, ModelFormat format)
{
    const TemporaryFolder folder;
    std::mt19937 random(20160);
    int readable = 0;
    write_all(folder, files);
    for (int round = 0; round < 3000; ++round) {
        const FileBytes& file = files[random() % files.size()];
        std::string bytes = file.bytes;
        for (std::uint32_t i = random() % 3 + 1; i > 0; --i) {
            bytes[random() % bytes.size()] ^= static_cast<char>(random() % 255 + 1);
        }
        folder.write(file.name, bytes);
        readable += reads(folder.path(), format) ? 1 : 0;
        folder.write(file.name, file.bytes);
    }
    return readable;
}

TEST(ColmapModel, RefusesEveryCutBinaryFile)
{
    EXPECT_EQ(count_readable_cuts(files_of("formats/rich_bin", ".bin"), ModelFormat::binary), 0);
}

TEST(ColmapModel, ReadsOrRefusesCutTextFiles)
{
    const auto files = files_of("formats/rich_txt", ".txt");
    std::size_t cuts = 0;
    for (const FileBytes& file : files) {
        cuts += file.bytes.size();
    }
    const int readable = count_readable_cuts(files, ModelFormat::text);
    EXPECT_GT(readable, 0);
    EXPECT_LT(static_cast<std::size_t>(readable), cuts);
}

TEST(ColmapModel, ReadsOrRefusesFlippedBytes)
{
    for (const auto& [fixture, extension, format] :
         {std::tuple{"formats/rich_bin", ".bin", ModelFormat::binary},
          std::tuple{"formats/rich_txt", ".txt", ModelFormat::text},
          std::tuple{"formats/rich_txt_by_hand", ".txt", ModelFormat::text}}) {
        SCOPED_TRACE(fixture);
        const int readable = count_readable_flips(files_of(fixture, extension), format);
        EXPECT_GT(readable, 0);
        EXPECT_LT(readable, 3000);
    }
}

} // namespace
} // namespace vcarve
