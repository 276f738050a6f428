#include "io/colmap/colmap_model.h"
#include "support/places.h"
#include "support/scene_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace vcarve::colmap_model_refusal_test {
namespace {

namespace fs = std::filesystem;

const fs::path kFixtures = fixtures_folder();
constexpr const char* kStems[] = {"cameras", "images", "points3D"};

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
    {"bin_point_twice", "/points3D.bin: point 5 occurs twice"},
    {"bin_points_empty_file", "/points3D.bin: the file is empty"},
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
    {"txt_point_track_odd", "/points3D.txt: line 2: the line ends where the index of a 2D point in "
                            "the track should stand"},
    {"txt_point_twice", "/points3D.txt: point 1 occurs twice"},
};

void expect_refusals(const std::vector<Refusal>& refusals, ModelFormat format)
{
    for (const auto& [name, sentence] : refusals) {
        const fs::path folder = kFixtures / "broken" / name;
        EXPECT_EQ(refusal<InputError>([&] { read_colmap_model(folder, format); }),
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

struct FileBytes {
    std::string name;
    std::string bytes;
};

std::vector<FileBytes> files_of(const std::string& fixture, const std::string& extension)
{
    std::vector<FileBytes> files;
    for (const char* stem : kStems) {
        const std::string name = stem + extension;
        files.push_back({name, bytes_of(kFixtures / fixture / name)});
        EXPECT_FALSE(files.back().bytes.empty()) << name;
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

/// How many of 1000 models with one to three bytes changed can be read.
int count_readable_flips(const std::vector<FileBytes>& files, ModelFormat format)
{
    const TemporaryFolder folder;
    std::mt19937 random(20160);
    int readable = 0;
    write_all(folder, files);
    for (int round = 0; round < 1000; ++round) {
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
        EXPECT_LT(readable, 1000);
    }
}

} // namespace
} // namespace vcarve::colmap_model_refusal_test
