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

/// A folder in fixtures/broken, and the error message after its path.
using Refusal = std::pair<const char*, const char*>;

const std::vector<Refusal> kBinaryRefusals{
    {"bin_camera_count_huge", "/cameras.bin: byte 0: found a count of 1152921504606846976 cameras, "
                              "but the rest of the file can hold 2 at most"},
    {"bin_camera_model_99",
     "/cameras.bin: camera 1 has the unknown model 99, so its number of parameters is unknown; "
     "convert the COLMAP model to text"},
    {"bin_camera_twice", "/cameras.bin: camera 1 occurs twice"},
    {"bin_cameras_trailing", "/cameras.bin: byte 64: expected the end of the file after the last "
                             "camera, found more bytes: 3"},
    {"bin_cameras_truncated", "/cameras.bin: byte 56: the file ends inside the parameters of a "
                              "camera (bytes expected: 8, found: 3)"},
    {"bin_image_camera_unknown",
     "/images.bin: image 1 (a.jpg) uses camera 7, which is missing in cameras.bin"},
    {"bin_image_count_huge",
     "/images.bin: byte 0: found a count of 1152921504606846976 images, but "
     "the rest of the file can hold 3 at most"},
    {"bin_image_name_open",
     "/images.bin: byte 72: the file ends inside the name of an image (no terminating zero byte)"},
    {"bin_image_rotation_nan", "/images.bin: image 1 (a.jpg) has a pose that is not finite"},
    {"bin_image_rotation_zero",
     "/images.bin: image 1 (a.jpg) has a rotation quaternion of length zero"},
    {"bin_image_translation_nan", "/images.bin: image 1 (a.jpg) has a pose that is not finite"},
    {"bin_image_twice", "/images.bin: image 1 (b.jpg) has the same id as image 1 (a.jpg)"},
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
     "/cameras.txt: line 2: found 3 parameters, but a PINHOLE camera has 4"},
    {"txt_camera_size_missing",
     "/cameras.txt: line 2: the line ends, expected the height of the camera"},
    {"txt_camera_width_word",
     "/cameras.txt: line 2: found 'wide', expected the width of the camera "
     "(an unsigned 64-bit integer)"},
    {"txt_image_camera_unknown",
     "/images.txt: image 1 (a.jpg) uses camera 7, which is missing in cameras.txt"},
    {"txt_image_id_negative", "/images.txt: line 4: found '-2', expected the id of an image (an "
                              "unsigned 32-bit integer)"},
    {"txt_image_name_missing",
     "/images.txt: line 2: the line ends, expected the name of the image"},
    {"txt_image_rotation_nan", "/images.txt: image 1 (a.jpg) has a pose that is not finite"},
    {"txt_image_rotation_zero",
     "/images.txt: image 1 (a.jpg) has a rotation quaternion of length zero"},
    {"txt_image_twice", "/images.txt: image 1 (b.jpg) has the same id as image 1 (a.jpg)"},
    {"txt_images_points2d_left_out",
     "/images.txt: line 3: found 'b.jpg' at the end of the line, expected the 2D points of the "
     "image on the previous line (x, y and point id each), or an empty line"},
    {"txt_images_pose_cut",
     "/images.txt: line 2: the line ends, expected the translation of the image"},
    {"txt_point_color_300",
     "/points3D.txt: line 2: found '300', expected the color of the point (an "
     "integer from 0 to 255)"},
    {"txt_point_coordinate_1e999",
     "/points3D.txt: line 2: found '1e999', expected the position of the "
     "point (a number)"},
    {"txt_point_coordinate_word",
     "/points3D.txt: line 2: found '5,0', expected the position of the "
     "point (a number)"},
    {"txt_point_error_missing",
     "/points3D.txt: line 2: the line ends, expected the error of the point"},
    {"txt_point_track_odd",
     "/points3D.txt: line 2: the line ends, expected the index of a 2D point in "
     "the track"},
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

TEST(ColmapModel, RefusesBrokenBinaryFilesWithOneSentence)
{
    expect_refusals(kBinaryRefusals, ModelFormat::binary);
}

TEST(ColmapModel, RefusesBrokenTextFilesWithOneSentence)
{
    expect_refusals(kTextRefusals, ModelFormat::text);
}

TEST(ColmapModel, TestsCoverEveryBrokenFixture)
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

/// Whether the model can be read; the scene must be well-formed. Other errors than InputError pass.
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

/// Truncates every file at every byte. Returns how many of these models can be read.
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

/// Changes one to three bytes in 1000 models. Returns how many of them can be read.
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

TEST(ColmapModel, RefusesEveryTruncatedBinaryFile)
{
    EXPECT_EQ(count_readable_cuts(files_of("formats/rich_bin", ".bin"), ModelFormat::binary), 0);
}

TEST(ColmapModel, ReadsOrRefusesTruncatedTextFiles)
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

TEST(ColmapModel, ReadsOrRefusesChangedBytes)
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
