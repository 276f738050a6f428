#include "io/colmap/colmap_model.h"
#include "io/colmap/find_model.h"
#include "io/colmap/transforms_json.h"
#include "model/camera.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace vcarve::transforms_json_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::EndsWith;

const Json kPose = {{0, 0, 1, 5}, {1, 0, 0, 6}, {0, 1, 0, 7}, {0, 0, 0, 1}};

/// One image of 640 x 480 at (5, 6, 7).
Json small_file()
{
    return {{"fl_x", 500.0},
            {"fl_y", 510.0},
            {"cx", 321.0},
            {"cy", 239.0},
            {"w", 640},
            {"h", 480},
            {"frames", {{{"file_path", "./images/a.jpg"}, {"transform_matrix", kPose}}}}};
}

class TransformsJson : public ::testing::Test {
  protected:
    ColmapViews read(const std::string& text) const
    {
        return read_colmap_views(folder.write("transforms.json", text), ModelFormat::transforms);
    }
    ColmapViews read(const Json& json) const { return read(json.dump()); }

    /// The error message after the path of the file.
    std::string refused(const std::string& text) const
    {
        const std::string sentence = refusal<InputError>([&] { read(text); });
        const std::string begin = (folder / "transforms.json").string() + ": ";
        EXPECT_TRUE(sentence.starts_with(begin)) << sentence;
        return sentence.substr(std::min(begin.size(), sentence.size()));
    }
    /// The same for small_file() with the value at `pointer` replaced.
    std::string refused_with(const std::string& pointer, const Json& value) const
    {
        Json json = small_file();
        json[Json::json_pointer(pointer)] = value;
        return refused(json.dump());
    }

    TemporaryFolder folder;
};

TEST_F(TransformsJson, ReadsPosesWithTheAxesOfOpenGL)
{
    const ColmapViews views = read(small_file());
    ASSERT_EQ(views.views.size(), 1U);
    const View& view = views.views[0];
    EXPECT_EQ(view.name, "images/a.jpg");
    EXPECT_EQ(view.id, 1U);
    EXPECT_TRUE(view.center.isApprox(Vector3d(5, 6, 7), 1e-15));
    // The camera's x, y, z are the world's y, z, x; it looks along -z, and its y points up
    EXPECT_TRUE((view.cam_from_world * Vector3d(-1, 0, 0)).isApprox(Vector3d(0, 0, 1), 1e-15));
    EXPECT_TRUE((view.cam_from_world * Vector3d(0, 1, 0)).isApprox(Vector3d(1, 0, 0), 1e-15));
    EXPECT_TRUE((view.cam_from_world * Vector3d(0, 0, 1)).isApprox(Vector3d(0, -1, 0), 1e-15));
    ASSERT_EQ(views.cameras.size(), 1U);
    EXPECT_EQ(views.cameras[0].model, 1);
    EXPECT_EQ(views.cameras[0].width_px, 640U);
    EXPECT_EQ(views.cameras[0].height_px, 480U);
    EXPECT_THAT(views.cameras[0].params, ElementsAre(500, 510, 321, 239));
}

TEST_F(TransformsJson, SurvivesARoundTripOfAModel)
{
    const fs::path model = fixtures_folder() / "scene/sparse/0";
    const ColmapViews views = read_colmap_views(model, ModelFormat::binary);
    Json frames = Json::array();
    for (const View& view : views.views) {
        Eigen::Matrix3d axes = view.cam_from_world.conjugate().toRotationMatrix();
        axes.rightCols<2>() *= -1.0;
        Json rows = Json::array();
        for (int r = 0; r < 3; ++r) {
            rows.push_back({axes(r, 0), axes(r, 1), axes(r, 2), view.center[r]});
        }
        frames.push_back({{"file_path", view.name}, {"transform_matrix", rows}});
    }
    Json json = small_file();
    json["frames"] = frames;
    const ColmapViews again = read(json);
    ASSERT_EQ(again.views.size(), views.views.size());
    for (std::size_t i = 0; i < views.views.size(); ++i) {
        EXPECT_LT((again.views[i].center - views.views[i].center).norm(), 1e-12);
        EXPECT_LT(again.views[i].cam_from_world.angularDistance(views.views[i].cam_from_world),
                  1e-7);
        EXPECT_EQ(again.views[i].name, views.views[i].name);
    }
    EXPECT_EQ(again.cameras.size(), 1U);
}

TEST_F(TransformsJson, PrefersLensParametersOfTheImageToSharedOnes)
{
    Json json = small_file();
    Json other = json["frames"][0];
    other["k1"] = 0.1;
    other["p2"] = 0.02;
    other["k3"] = 0.003;
    other["fl_x"] = 400;
    json["frames"].push_back(other);
    json["frames"].push_back(other);
    const ColmapViews views = read(json);
    ASSERT_EQ(views.cameras.size(), 2U);
    EXPECT_EQ(views.views[2].camera, 1U);
    EXPECT_EQ(views.cameras[1].model, 6); // FULL_OPENCV
    EXPECT_THAT(views.cameras[1].params,
                ElementsAre(400, 510, 321, 239, 0.1, 0, 0, 0.02, 0.003, 0, 0, 0));
}

TEST_F(TransformsJson, ReadsFisheyeLenses)
{
    Json json = small_file();
    json["camera_model"] = "OPENCV_FISHEYE";
    json["k1"] = 0.1;
    json["k4"] = 0.4;
    const std::vector<double> params = {500, 510, 321, 239, 0.1, 0, 0, 0.4};
    EXPECT_EQ(read(json).cameras[0].model, 5);
    EXPECT_EQ(read(json).cameras[0].params, params);
    json.erase("camera_model");
    json["is_fisheye"] = true; // instant-ngp
    EXPECT_EQ(read(json).cameras[0].params, params);
}

TEST_F(TransformsJson, DerivesTheFocalLengthFromTheAngleAndCentersTheAxis)
{
    Json json = small_file();
    for (const char* const key : {"fl_x", "fl_y", "cx", "cy"}) {
        json.erase(key);
    }
    json["camera_angle_x"] = 2.0 * std::atan(0.5);
    const Camera camera = read(json).cameras[0];
    EXPECT_NEAR(camera.params[0], 640.0, 1e-9);
    EXPECT_EQ(camera.params[1], camera.params[0]);
    EXPECT_EQ(camera.params[2], 320.0);
    EXPECT_EQ(camera.params[3], 240.0);
}

TEST_F(TransformsJson, NamesThePositionOfInvalidJson)
{
    const std::string end = ", expected a transforms.json as nerfstudio and instant-ngp write it";
    EXPECT_EQ(refused(""), "line 1: invalid JSON after ''" + end);
    EXPECT_EQ(refused("{\n\"w\": 640,\n\"h\": NaN}"),
              "line 3: invalid JSON after '\"h\": N'" + end);
    EXPECT_EQ(refused("{\"w\": 1e999}"), "contains a number that is too large");
    const std::string deep(200, '[');
    EXPECT_EQ(refused(deep), "its values are nested more than 64 levels deep" + end);
    EXPECT_EQ(refused(std::string(20'000'000, '[')),
              "its values are nested more than 64 levels deep" + end);
    EXPECT_THAT(refused("{\"w\": \"\xff\"}"), EndsWith(end));
    const std::string whole = small_file().dump();
    for (std::size_t length = 0; length < whole.size(); ++length) {
        EXPECT_THAT(refused(whole.substr(0, length)), EndsWith(end));
    }
}

TEST_F(TransformsJson, NamesTheFoundAndTheExpectedValue)
{
    const std::string frames = "frames: found ";
    const std::string list = ", expected a list of images with their poses, as nerfstudio and "
                             "instant-ngp write it";
    EXPECT_EQ(refused("{}"), frames + "nothing" + list);
    EXPECT_EQ(refused("[1, 2]"), frames + "nothing" + list);
    EXPECT_EQ(refused("7"), frames + "nothing" + list);
    EXPECT_EQ(refused_with("/frames", "many"), frames + "\"many\"" + list);
    EXPECT_EQ(refused_with("/frames", Json::array()), frames + "an array of size 0" + list);
    EXPECT_EQ(refused_with("/w", "wide"),
              "w: found \"wide\", expected the size of the images in pixels");
    EXPECT_EQ(refused_with("/h", 480.5),
              "h: found 480.5, expected the size of the images in pixels");
    EXPECT_EQ(refused_with("/fl_x", -3),
              "fl_x: found -3, expected the focal length in pixels, above 0, or else "
              "camera_angle_x");
    EXPECT_EQ(refused_with("/frames/0/cx", nullptr), "frames[0].cx: found null, expected a number");
    EXPECT_EQ(refused_with("/camera_model", "EQUIRECTANGULAR"),
              "camera_model: found \"EQUIRECTANGULAR\", expected PINHOLE, OPENCV or "
              "OPENCV_FISHEYE");
    EXPECT_EQ(refused_with("/frames/0", 3), // a number has no members
              "frames[0].transform_matrix: found nothing, expected a pose: 4 rows of 4 numbers, "
              "from the camera to the world");
    EXPECT_EQ(refused_with("/frames/0/file_path", 3),
              "frames[0].file_path: found 3, expected the name of the image");
    Json json = small_file();
    json.erase("w");
    EXPECT_EQ(refused(json.dump()),
              "frames[0].w: found nothing, expected the size of the images in pixels, or the image "
              "itself");
}

TEST_F(TransformsJson, ReadsAMissingSizeFromThePhotographs)
{
    Json json = small_file();
    json.erase("w");
    json.erase("h");
    json["frames"] = {{{"file_path", "./train/r_0"}, {"transform_matrix", kPose}},
                      {{"file_path", "train/r_1.pgm"}, {"transform_matrix", kPose}}};
    folder.write("train/r_0.png", "P5 3 2 255\nabcdef");
    folder.write("train/r_1.pgm", "P5 4 1 255\nabcd");
    const ColmapViews views = read(json);
    ASSERT_EQ(views.cameras.size(), 2U);
    EXPECT_EQ(views.cameras[0].width_px, 3U);
    EXPECT_EQ(views.cameras[0].height_px, 2U);
    EXPECT_EQ(views.cameras[1].width_px, 4U);
    EXPECT_EQ(views.cameras[1].height_px, 1U);
    EXPECT_EQ(views.views[0].name, "train/r_0");
}

TEST_F(TransformsJson, ExplainsHowToConvertFilesOfOtherPrograms)
{
    EXPECT_EQ(refused(R"([{"id": 0, "img_name": "a", "position": [0, 0, 0]}])"),
              "camera lists of 3D Gaussian splatting are not supported; give the COLMAP model that "
              "was used for training (source_path in cfg_args), and its Gaussians as --points "
              "point_cloud/iteration_30000/point_cloud.ply");
    EXPECT_EQ(refused(R"([{"cameras": {}, "shots": {}, "points": {}}])"),
              "reconstructions of OpenSfM are not supported; run: opensfm export_colmap DATASET, "
              "and give the exported folder");
    EXPECT_EQ(refused(R"({"sfm_data_version": "0.3", "views": []})"),
              "scenes of OpenMVG are not supported; run: openMVG_main_openMVG2Colmap -i " +
                  (folder / "transforms.json").string() + " -o FOLDER, and give FOLDER");
}

/// A rotation by 90 degrees about z, a translation, and a scale of 2.
constexpr const char* kParsed =
    R"({"transform": [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3]], "scale": 2.0})";

Vector3d moved(const Similarity& to, const Vector3d& x)
{
    return to.linear * x + to.translation;
}

TEST_F(TransformsJson, MapsTheFrameOfColmapToThatOfTraining)
{
    const fs::path file = folder.write("dataparser_transforms.json", kParsed);
    const Similarity to = read_nerfstudio_transform(file, {});
    EXPECT_NEAR(to.scale, 2.0, 1e-15);
    EXPECT_TRUE(moved(to, {5, 6, 7}).isApprox(Vector3d(2 * (-6 + 1), 2 * (5 + 2), 2 * (7 + 3))));
}

TEST_F(TransformsJson, MapsItsOwnFrameToThatOfTraining)
{
    const fs::path file = folder.write("dataparser_transforms.json", kParsed);
    const Similarity from_colmap = read_nerfstudio_transform(file, {});
    Json json = small_file();
    const fs::path poses = folder.write("transforms.json", json.dump());
    EXPECT_EQ(read_nerfstudio_transform(file, poses).linear, from_colmap.linear);
    // nerfstudio writes x, z and -y of COLMAP.
    json["applied_transform"] = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 4}};
    folder.write("transforms.json", json.dump());
    const Similarity to = read_nerfstudio_transform(file, poses);
    EXPECT_TRUE(moved(to, {5, 7, -6 + 4}).isApprox(moved(from_colmap, {5, 6, 7})));
    EXPECT_NEAR(to.scale, 2.0, 1e-15);
}

TEST_F(TransformsJson, RefusesFilesOfOtherFormatsAsDataparser)
{
    const auto refused_transform = [&](const char* text) {
        const fs::path file = folder.write("t.json", text);
        const std::string sentence =
            refusal<InputError>([&] { read_nerfstudio_transform(file, {}); });
        return sentence.substr(file.string().size());
    };
    EXPECT_EQ(refused_transform("{}"), ": scale: found nothing, expected the scale of nerfstudio");
    EXPECT_EQ(refused_transform(R"({"scale": 0})"), ": scale: found 0, expected a scale above 0");
    EXPECT_EQ(refused_transform(R"({"scale": 1, "transform": [1]})"),
              ": transform: found an array of size 1, expected a matrix of 3 rows of 4 numbers");
}

TEST_F(TransformsJson, RefusesInvalidPoses)
{
    const std::string place = "frames[0].transform_matrix";
    const std::string pose = ", expected a pose: 4 rows of 4 numbers, from the camera to the world";
    EXPECT_EQ(refused_with("/frames/0/transform_matrix", "I"), place + ": found \"I\"" + pose);
    EXPECT_EQ(refused_with("/frames/0/transform_matrix", {1, 2}),
              place + ": found an array of size 2" + pose);
    EXPECT_EQ(refused_with("/frames/0/transform_matrix/1", {1, 2, 3}),
              place + "[1]: found an array of size 3" + pose);
    EXPECT_EQ(refused_with("/frames/0/transform_matrix/1/2", nullptr),
              place + "[1][2]: found null, expected a number");
    EXPECT_EQ(refused_with("/frames/0/transform_matrix/0/2", -1),
              place + ": found a reflection, which turns surfaces inside out" + pose);
    EXPECT_EQ(refused_with("/frames/0/transform_matrix/0/2", 0),
              place + ": found a singular or infinite matrix" + pose);
}

TEST_F(TransformsJson, FindsItsPointsByNameOrInItsFolder)
{
    const fs::path file = folder.write("transforms.json", small_file().dump());
    EXPECT_EQ(points_of_transforms(file), fs::path());
    folder.write("points3D.ply", "");
    EXPECT_EQ(points_of_transforms(file), folder / "points3D.ply");
    folder.write("sparse_pc.ply", "");
    EXPECT_EQ(points_of_transforms(file), folder / "sparse_pc.ply");
    Json json = small_file();
    json["ply_file_path"] = "a/b.ply";
    folder.write("transforms.json", json.dump());
    EXPECT_EQ(points_of_transforms(file), folder / "a/b.ply");
    EXPECT_EQ(
        points_of_transforms(folder.write("t.json", R"({"ply_file_path": "a", "frames": [1]})")),
        folder / "a");
    EXPECT_THAT(refusal<InputError>([&] { points_of_transforms(folder.write("c.json", "{}")); }),
                ::testing::HasSubstr("c.json: frames: found nothing"));
}

} // namespace
} // namespace vcarve::transforms_json_test
