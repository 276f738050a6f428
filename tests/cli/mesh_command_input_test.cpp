#include "io/colmap/colmap_model.h"
#include "io/images/encode_image.h"
#include "support/ball_model.h"
#include "support/dense_workspace.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "vcarve/io.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace vcarve::mesh_command_input_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

/// A workspace of a ball: 300 sparse points, and 600 dense ones with normals.
class ProgramOnDenseBall : public ::testing::Test {
  protected:
    ProgramOnDenseBall()
    {
        write_ball_model(folder / "dense/sparse", 300);
        write_ball_model(folder / "more", 600);
        cloud = read_colmap_model(folder / "more", ModelFormat::text);
        for (const Eigen::Vector3d& position : cloud.positions) {
            cloud.normals.emplace_back(position.cast<float>());
        }
        write_cloud(CloudEncoding::binary);
        folder.write("dense/fused.ply.vis", visibility_bytes(cloud.tracks));
    }

    void write_cloud(CloudEncoding encoding) const
    {
        folder.write("dense/fused.ply", cloud_bytes(cloud, encoding));
    }

    std::string bytes_made_of(const std::vector<std::string>& input) const
    {
        std::vector<std::string> arguments = input;
        arguments.insert(arguments.end(), {out, "--quiet"});
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return bytes_of(out);
    }

    /// The beginning of the sentence that `compare` prints about its reference.
    std::string measured_against(const std::vector<std::string>& input) const
    {
        std::vector<std::string> arguments = {"compare", "--quiet"};
        arguments.insert(arguments.end(), input.begin(), input.end());
        const std::string printed = run_program(arguments).out;
        const std::size_t begin = printed.find("Measured against");
        return begin == std::string::npos ? printed : printed.substr(begin, 30);
    }

    TemporaryFolder folder;
    Scene cloud;
    std::string dense = folder / "dense";
    std::string fused = folder / "dense/fused.ply";
    std::string out = folder / "out.ply";
};

TEST_F(ProgramOnDenseBall, MeshesTheDensePointsWithANote)
{
    const std::string stats = folder / "stats.json";
    const Outcome outcome = run_program({dense, out, "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, StartsWith("note: points are read from " + fused));
    EXPECT_THAT(outcome.err, HasSubstr("\nread         600 points, 6 views, "));
    const auto input = nlohmann::json::parse(bytes_of(stats))["input"];
    EXPECT_EQ(input["cloud"], fused);
    EXPECT_EQ(input["folder"], dense + "/sparse");
    EXPECT_EQ(input["points"], 600);
}

TEST_F(ProgramOnDenseBall, MeshesTheSparsePointsOnRequest)
{
    const std::string sparse = bytes_made_of({dense + "/sparse"});
    EXPECT_TRUE(bytes_made_of({dense, "--points", "sparse"}) == sparse);
    EXPECT_FALSE(bytes_made_of({dense}) == sparse);
}

TEST_F(ProgramOnDenseBall, WritesTheSameBytesForTextAndForAnyPathToTheCloud)
{
    const std::string made = bytes_made_of({dense});
    EXPECT_TRUE(bytes_made_of({fused}) == made);
    EXPECT_TRUE(bytes_made_of({dense, "--points", "dense"}) == made);
    const auto other = folder.write("other.ply", cloud_bytes(cloud, CloudEncoding::ascii));
    const std::string named =
        bytes_made_of({dense + "/sparse", "--points", other, "--visibility", fused + ".vis"});
    EXPECT_TRUE(named == made);
    write_cloud(CloudEncoding::ascii);
    EXPECT_TRUE(bytes_made_of({dense}) == made);
}

TEST_F(ProgramOnDenseBall, UsesTheNearestViewsForACloudWithoutVisibility)
{
    std::filesystem::remove(fused + ".vis");
    const Outcome outcome = run_program({dense, out, "--rays", "nearest"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("no file has their views"));
    EXPECT_THAT(outcome.err, HasSubstr("\nread         600 points, 6 views, "));
    EXPECT_EQ(run_program({fused, out}).exit_code, 3);
    EXPECT_EQ(run_program({dense, out, "--rays", "nearest", "--points", "sparse"}).exit_code, 0);
}

TEST_F(ProgramOnDenseBall, DropsAPointThatIsNotFinite)
{
    cloud.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
    write_cloud(CloudEncoding::binary);
    EXPECT_THAT(run_program({dense, out}).err,
                HasSubstr("493 of 600 points kept, 106 few views, 1 not finite"));
}

TEST_F(ProgramOnDenseBall, RejectsBrokenInputWithASentenceAndWritesNothing)
{
    folder.write("dense/fused.ply.vis", std::string(8, '\0'));
    const Outcome outcome = run_program({dense, out});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err,
                HasSubstr("colmap-vcarve: " + fused + ".vis: has the views of 0 points, but " +
                          fused + " has 600 points; "));
    EXPECT_THAT(outcome.err,
                ::testing::EndsWith("(--crop reconstructs a region of the whole cloud)\n"));
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(run_program({fused, out, "--points", "sparse"}).exit_code, 2);
}

TEST_F(ProgramOnDenseBall, RejectsACloudThatNeedsTooMuchMemoryBeforeReadingIt)
{
    const Outcome outcome = run_program({dense, out, "--max-memory", "1M"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("dense: 600 points with "));
    EXPECT_THAT(outcome.err, Not(HasSubstr("\nread ")));
}

TEST_F(ProgramOnDenseBall, MeasuresMeshesAgainstTheDensePoints)
{
    bytes_made_of({dense});
    // The points that at least two views saw.
    EXPECT_THAT(measured_against({dense, out}), StartsWith("Measured against 493 points "));
    EXPECT_THAT(measured_against({dense, out, "--points", "sparse"}),
                StartsWith("Measured against 247 points "));
}

TEST_F(ProgramOnDenseBall, ComparesWithColmapsMeshOfTheWorkspace)
{
    const auto words = folder / "words.txt";
    const auto script =
        folder.write("mesher", "#!/bin/sh\necho \"$@\" > '" + words.string() + "'; exit 1\n");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    const std::string colmap = script.string();
    const Outcome outcome = run_program({"compare", dense, "--colmap", colmap});
    EXPECT_THAT(bytes_of(words), StartsWith("delaunay_mesher --input_type dense --input_path " +
                                            dense + " --output_path "));
    EXPECT_THAT(outcome.out, MatchesRegex("\\| +\\| colmap-vcarve \\|\n(.|\n)*"));
    EXPECT_THAT(outcome.out, HasSubstr("\nMeasured against 493 points "));
    run_program({"compare", dense, "--points", "sparse", "--colmap", colmap});
    EXPECT_THAT(bytes_of(words), StartsWith("delaunay_mesher --input_type sparse --input_path " +
                                            dense + "/sparse --output_path "));
    const Outcome other =
        run_program({"compare", dense + "/sparse", "--points", fused, "--colmap", colmap});
    EXPECT_THAT(other.out, HasSubstr("\nMeasured against 493 points "));
}

TEST_F(ProgramOnDenseBall, RejectsPointsThatColmapCannotRead)
{
    std::filesystem::rename(fused, folder / "dense/other.ply");
    const Outcome outcome = run_program({"compare", dense, "--points", folder / "dense/other.ply",
                                         "--visibility", fused + ".vis", "--colmap", "colmap"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "colmap-vcarve: --colmap cannot use the points of " + dense +
                               "/other.ply: COLMAP's mesher reads fused.ply, fused.ply.vis and "
                               "sparse from one folder\n");
}

/// Points on the unit ball, measured by two scanners on opposite sides at a distance of 3 from its
/// center. Each point is on the side of its scanner.
class ProgramOnScannedBall : public ::testing::Test {
  protected:
    ProgramOnScannedBall()
    {
        constexpr int kPoints = 1000;
        for (int i = 0; i < kPoints; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / kPoints;
            const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
            const double radius = std::sqrt(1.0 - z * z);
            if (std::abs(z) < 0.35) continue; // seen along the surface or not at all
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
        scan = folder.write("scan.ply", bytes_with({"x_origin", "y_origin", "z_origin"}));
        std::erase_if(points, [](const Eigen::Vector3d& p) { return p.z() < 0.0; });
        bare = folder.write("bare.ply", bytes_with({}));
    }

    /// The points as text, with scanner positions if `names` has their properties.
    std::string bytes_with(const std::vector<std::string>& names) const
    {
        std::string bytes = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float "
                                        "x\nproperty float y\nproperty float z\n",
                                        points.size());
        for (const std::string& name : names) {
            bytes += "property double " + name + "\n";
        }
        bytes += "end_header\n";
        for (const Eigen::Vector3d& p : points) {
            bytes += fmt::format("{} {} {}", p.x(), p.y(), p.z());
            if (!names.empty()) bytes += fmt::format(" 0 0 {}", p.z() > 0.0 ? 3 : -3);
            bytes += "\n";
        }
        return bytes;
    }

    TemporaryFolder folder;
    std::vector<Eigen::Vector3d> points;
    std::string scan;
    std::string bare; ///< half of the points, without scanner positions
    std::string out = folder / "out.ply";
};

TEST_F(ProgramOnScannedBall, MeshesAScanWithoutAModelAndKeepsPointsOfOneView)
{
    const std::string stats = folder / "stats.json";
    const Outcome outcome =
        run_program({scan, out, "--merge-px", "0", "--simplify", "0", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("note: points are read from " + scan +
                                        " with the scanner position of each point\n"
                                        "read         650 points, 2 views, 650 rays "));
    EXPECT_THAT(outcome.err, HasSubstr("\nfilter       650 of 650 points kept"));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["input"]["cloud"], scan);
    EXPECT_TRUE(record["input"]["folder"].is_null());
    EXPECT_GE(record["mesh"]["faces"], 1000);
}

TEST_F(ProgramOnScannedBall, AcceptsOneScannerPositionForAllPoints)
{
    const Outcome outcome = run_program({bare, out, "--scanner", "0,0,3"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("note: points are read from " + bare +
                                        " with the scanner at 0, 0, 3\nread         325 "
                                        "points, 1 view, 325 rays"));
    EXPECT_EQ(run_program({bare, out, "--scanner", "file"}).exit_code, 3);
}

TEST_F(ProgramOnScannedBall, ReportsThatACloudWithoutScannersNeedsAModel)
{
    const Outcome outcome = run_program({bare, out});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("no COLMAP model found; searched "));
    EXPECT_THAT(outcome.err, HasSubstr("; without a model, " + bare +
                                       " needs scanner positions (--scanner x,y,z sets one)\n"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ProgramOnScannedBall, RejectsContradictoryScannerPositions)
{
    const Outcome outcome = run_program({scan, out, "--scanner", "0,0,3"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--scanner 0,0,3 is one position for all points, but " +
                                       scan + " has a scanner position for each point\n"));
}

TEST_F(ProgramOnScannedBall, MeasuresMeshesAgainstTheScan)
{
    EXPECT_EQ(run_program({scan, out, "--quiet"}).exit_code, 0);
    EXPECT_THAT(
        run_program({"compare", "--quiet", scan, out}).out,
        HasSubstr("Measured against 650 points with at least 2 views or a measured range and 2 "
                  "views; "));
    const Outcome colmap = run_program({"compare", "--quiet", scan, "--colmap", "colmap"});
    EXPECT_EQ(colmap.exit_code, 2);
    EXPECT_EQ(colmap.err, "colmap-vcarve: --colmap cannot use the points of " + scan +
                              ": COLMAP's mesher does not support laser scans\n");
}

class CropOfScene : public ::testing::Test {
  protected:
    Outcome run(const std::vector<std::string>& words) const
    {
        std::vector<std::string> all = {scene, out};
        all.insert(all.end(), words.begin(), words.end());
        return run_program(all);
    }
    /// Expects the program to fail with this code and to write no mesh. Returns its message.
    std::string sentence_of(int exit_code, const std::string& crop) const
    {
        const Outcome outcome = run({"--quiet", "--crop", crop});
        EXPECT_EQ(outcome.exit_code, exit_code);
        EXPECT_FALSE(std::filesystem::exists(out));
        return outcome.err;
    }

    TemporaryFolder folder;
    std::string scene = (fixtures_folder() / "scene/sparse/0").string();
    std::string out = folder / "out.ply";
    std::string stats = folder / "stats.json";
};

TEST_F(CropOfScene, IsCountedAndRecorded)
{
    const Outcome outcome = run({"--crop=auto", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("crop +[0-9,]+ of [0-9,]+ points in the region"));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["options"]["crop"], "auto");
    EXPECT_EQ(record["stages"][4]["name"], "crop");
    const auto& counts = record["stages"][4]["counts"];
    EXPECT_LT(counts["points"], counts["of points"]);
    EXPECT_GT(counts["points"].get<double>(), 0.85 * counts["of points"].get<double>());
}

TEST_F(CropOfScene, KeepsTheMeshInsideABox)
{
    ASSERT_EQ(run({"--quiet"}).exit_code, 0);
    const TriMesh all = read_ply(out);
    Eigen::AlignedBox3d half;
    for (const Eigen::Vector3d& position : all.positions) {
        half.extend(position);
    }
    half.max() = half.center();
    ASSERT_EQ(
        run({"--quiet", "--stats", stats,
             fmt::format("--crop={},{}", fmt::join(half.min(), ","), fmt::join(half.max(), ","))})
            .exit_code,
        0);
    const TriMesh cropped = read_ply(out);
    EXPECT_GT(cropped.faces.size(), 100U);
    for (const Eigen::Vector3d& position : cropped.positions) {
        ASSERT_TRUE(half.contains(position));
    }
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["options"]["crop"].size(), 6U);
    EXPECT_EQ(record["options"]["crop"][3], half.max().x());
}

TEST_F(CropOfScene, AcceptsASurfaceOrAPolygonFromAFile)
{
    ASSERT_EQ(run({"--quiet", "--closed"}).exit_code, 0);
    const std::string region = folder / "Region.PLY";
    std::filesystem::rename(out, region);
    EXPECT_EQ(run({"--quiet", "--crop", region}).exit_code, 0);
    EXPECT_GT(read_ply(out).faces.size(), 1000U);

    const std::string corners = folder.write("corners.txt", "-1e3 -1e3\n1e3 -1e3\n0 1e3\n");
    EXPECT_EQ(run({"--quiet", "--crop", corners, "--stats", stats}).exit_code, 0);
    EXPECT_GT(read_ply(out).faces.size(), 1000U);
    EXPECT_EQ(nlohmann::json::parse(bytes_of(stats))["options"]["crop"], corners);
}

TEST_F(CropOfScene, RejectsWrongRegionsWithOneSentence)
{
    EXPECT_EQ(sentence_of(2, "0,0,0,1,1"), "colmap-vcarve: --crop takes none, auto, "
                                           "x0,y0,z0,x1,y1,z1 or a file, not \"0,0,0,1,1\"\n");
    EXPECT_EQ(sentence_of(2, "0,0,0,1,1,0"),
              "colmap-vcarve: --crop takes a box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and "
              "z0 < z1, not 0,0,0,1,1,0\n");
    EXPECT_EQ(sentence_of(3, "gone.txt"), "colmap-vcarve: gone.txt: the file does not exist\n");
    EXPECT_EQ(sentence_of(3, "gone.ply"), "colmap-vcarve: gone.ply: the file does not exist\n");
    const std::string corners = folder.write("corners.txt", "1 2\n3\n");
    EXPECT_EQ(sentence_of(3, corners), "colmap-vcarve: " + corners +
                                           ": line 2: the line ends, expected the y of a corner\n");
}

TEST_F(CropOfScene, RejectsARegionWithoutPoints)
{
    scene = folder / "ball";
    write_ball_model(scene, 400);
    EXPECT_THAT(sentence_of(3, "5,5,5,6,6,6.5"),
                ::testing::MatchesRegex(
                    "colmap-vcarve: " + scene +
                    ": no point is inside the region of --crop \\(x 5 to 6, y 5 to 6, z 5 to "
                    "6\\.5\\); the points span x -0\\.9[0-9]+ to 0\\.9[0-9]+, y "
                    "-0\\.9[0-9]+ to 0\\.9[0-9]+, z -0\\.9425 to 0\\.9425\\. Enlarge or move the "
                    "region\n"));
}

/// A model with photographs beside it, all in one color.
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

TEST_F(TextureOfProgram, IsWrittenIntoTheGlb)
{
    const std::string out = folder / "out.glb";
    const Outcome outcome = run({out, "--texture"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("using the photographs in"));
    EXPECT_THAT(outcome.err, HasSubstr("charts on 1 page"));
    EXPECT_THAT(bytes_of(out), HasSubstr("\"mimeType\":\"image/jpeg\""));
}

TEST_F(TextureOfProgram, IsWrittenBesideTheObj)
{
    ASSERT_EQ(run({folder / "out.obj", "--texture", "--quiet"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "out.mtl"));
    EXPECT_TRUE(fs::exists(folder / "out_0.jpg"));
}

TEST_F(TextureOfProgram, ColorsVerticesFromThePhotographs)
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

TEST_F(TextureOfProgram, NotesViewsWithoutPhotographs)
{
    fs::remove(fs::path(images) / scene.views[0].name);
    folder.write("images/" + scene.views[1].name, "some text");
    const Outcome outcome = run({folder / "out.ply", "--images", images});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("1 of "));
    EXPECT_THAT(outcome.err, HasSubstr("views have no photograph in"));
    EXPECT_THAT(outcome.err, HasSubstr(scene.views[1].name));
}

TEST_F(TextureOfProgram, FailsWithoutPhotographs)
{
    fs::remove_all(images);
    const Outcome outcome = run({folder / "out.glb", "--texture"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("name the folder of the photographs with --images"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("points"))) << "the points were read before";
    EXPECT_FALSE(fs::exists(folder / "out.glb"));
    const Outcome none = run({folder / "out.glb", "--images", folder / "none"});
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_EQ(none.err, "colmap-vcarve: " + (folder / "none").string() +
                            ": the folder does not exist or cannot be opened; expected the "
                            "folder of the photographs\n");
}

TEST_F(TextureOfProgram, NeverReplacesAPhotograph)
{
    // Converted photographs; one has the name of the first texture page of scanx.obj.
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
} // namespace vcarve::mesh_command_input_test
