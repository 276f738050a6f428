#include "steps/6_surface/provenance.h"
#include "support/places.h"
#include "support/program.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace vcarve::provenance_test {
namespace {

using Eigen::Vector3d;
using Place = std::array<double, 3>;

// ---- hand-made scene ----------------------------------------------------------------------------

/// Three views above the plane z = 0 and one below. The mesh has a square of two triangles that
/// face up, and a corner that is no point.
Scene square_scene()
{
    Scene scene =
        make_scene({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0, 0, -5}}, {{{0, 0, 0}, {0, 1, 2, 3}},
                                                                   {{1, 0, 0}, {0, 1, 2}},
                                                                   {{1, 1, 0}, {1, 2, 3}},
                                                                   {{0, 1, 0}, {3}}});
    scene.point_ids = {70, 60, 50, std::uint64_t{1} << 53};
    scene.errors_px = {0.5, 0.25, -7.0, 2.0};
    return scene;
}

TriMesh square_mesh()
{
    TriMesh mesh;
    mesh.positions = {{1, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}};
    mesh.points = {2, 0, 1, 3, kNoPoint};
    mesh.faces = {{1, 2, 0}, {1, 0, 3}, {0, 2, 1}, {0, 2, 4}};
    return mesh;
}

TEST(Provenance, RecordsPointsOfVerticesAndSupportOfFaces)
{
    const Provenance found = find_provenance(square_mesh(), square_scene());
    EXPECT_EQ(found.point_ids, (std::vector<std::int64_t>{50, 70, 60, 9007199254740992, -1}));
    EXPECT_EQ(found.num_views, (std::vector<std::int32_t>{3, 4, 3, 1, 0}));
    EXPECT_EQ(found.errors_px, (std::vector<float>{-1.0F, 0.5F, 0.25F, 2.0F, -1.0F}));
    // Views in front that saw the corners: 3, 3 and 2; 3, 2 and 0; 1, 0 and 1 (turned over). The
    // last face has a corner without a point.
    EXPECT_EQ(found.supports, (std::vector<std::int32_t>{2, 0, 0, 0}));
}

TEST(Provenance, RecordsNoPointForAddedPoints)
{
    Scene scene = square_scene();
    scene.kinds.assign(scene.num_points(), PointKind::measured);
    scene.kinds[1] = PointKind::crease;
    const Provenance found = find_provenance(square_mesh(), scene);
    EXPECT_EQ(found.point_ids, (std::vector<std::int64_t>{50, 70, -1, 9007199254740992, -1}));
    EXPECT_EQ(found.num_views, (std::vector<std::int32_t>{3, 4, 3, 1, 0})) << "its assigned views";
    EXPECT_EQ(found.errors_px, (std::vector<float>{-1.0F, 0.5F, -1.0F, 2.0F, -1.0F}));
}

TEST(Provenance, RejectsIdsThatWouldBeRounded)
{
    Scene scene = square_scene();
    scene.point_ids[1] = (std::uint64_t{1} << 53) + 1;
    EXPECT_EQ(refusal<InputError>([&] { find_provenance(square_mesh(), scene); }),
              "--attributes cannot write point 9007199254740993: PLY stores ids up to "
              "9007199254740992 only; omit --attributes");
}

// ---- comparison with COLMAP's text files, read here ---------------------------------------------

std::filesystem::path scene_folder()
{
    return fixtures_folder() / "scene/sparse_txt";
}

struct TextPoint {
    double id = 0.0;
    Place place{};
    double error_px = 0.0;
    std::set<int> images;
};

/// The points of points3D.txt, by id.
std::map<double, TextPoint> read_points()
{
    std::map<double, TextPoint> points;
    std::ifstream in(scene_folder() / "points3D.txt");
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with('#')) continue;
        std::istringstream words(line);
        TextPoint point;
        int color = 0;
        words >> point.id >> point.place[0] >> point.place[1] >> point.place[2];
        words >> color >> color >> color >> point.error_px;
        for (int image = 0, place = 0; words >> image >> place;) {
            point.images.insert(image);
        }
        points[point.id] = point;
    }
    return points;
}

/// The camera centers of images.txt, by id: -R^T t.
std::map<int, Vector3d> read_centers()
{
    std::map<int, Vector3d> centers;
    std::ifstream in(scene_folder() / "images.txt");
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with('#')) continue;
        std::istringstream words(line);
        int id = 0;
        Eigen::Quaterniond rotation;
        Vector3d shift;
        words >> id >> rotation.w() >> rotation.x() >> rotation.y() >> rotation.z();
        words >> shift.x() >> shift.y() >> shift.z();
        centers[id] = rotation.conjugate() * -shift;
        std::getline(in, line); // the 2D points
    }
    return centers;
}

/// The numbers after the header of an ascii PLY file, per line.
std::vector<std::vector<double>> read_rows(const std::filesystem::path& path)
{
    std::ifstream in(path);
    std::string line;
    while (std::getline(in, line) && line != "end_header") {
    }
    std::vector<std::vector<double>> rows;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        rows.emplace_back();
        for (double number = 0.0; words >> number;) {
            rows.back().push_back(number);
        }
    }
    return rows;
}

/// The ascii output of the program for fixtures/scene with more arguments, without denoising, so
/// that vertices stay at their points.
std::vector<std::vector<double>> rows_of_run(const std::vector<std::string>& arguments)
{
    const TemporaryFolder folder;
    std::vector<std::string> words = {scene_folder(), folder / "out.ply", "--ascii",
                                      "--quiet",      "--denoise",        "0"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    EXPECT_EQ(run_program(words).exit_code, 0);
    return read_rows(folder / "out.ply");
}

class WrittenAttributes : public ::testing::Test {
  protected:
    static constexpr std::size_t kId = 9; // column, after position, normal and color

    void SetUp() override
    {
        for (const auto& [id, point] : points_) {
            at_place_[point.place].insert(point.images.begin(), point.images.end());
        }
        rows_ = rows_of_run({"--attributes"});
        plain_ = rows_of_run({});
        while (rows_[num_vertices_].size() == kId + 3) {
            ++num_vertices_;
        }
        num_faces_ = (rows_.size() - num_vertices_) / 2;
    }

    /// The number of images in front of the face that saw a point at the position of the corner.
    std::ptrdiff_t images_before(const std::vector<double>& corner, const Vector3d& normal) const
    {
        if (corner[kId] < 0.0) return 0;
        const Place& place = points_.at(corner[kId]).place;
        const auto& images = at_place_.at(place);
        return std::count_if(images.begin(), images.end(), [&](int image) {
            const Vector3d way = centers_.at(image) - Vector3d(place[0], place[1], place[2]);
            return normal.dot(way.normalized()) > 0.05;
        });
    }

    std::map<double, TextPoint> points_ = read_points();
    std::map<int, Vector3d> centers_ = read_centers();
    std::map<Place, std::set<int>> at_place_; ///< the images that saw a point at a position
    std::vector<std::vector<double>> rows_;   ///< with --attributes
    std::vector<std::vector<double>> plain_;  ///< without
    std::size_t num_vertices_ = 0;
    std::size_t num_faces_ = 0;
};

TEST_F(WrittenAttributes, MatchTheModel)
{
    std::size_t num_points = 0;
    for (std::size_t v = 0; v < num_vertices_; ++v) {
        const std::vector<double>& row = rows_[v];
        if (row[kId] < 0.0) {
            EXPECT_EQ(row[kId], -1.0);
            EXPECT_NE(row[kId + 1], 1.0) << "points on creases have at least two";
            EXPECT_EQ(row[kId + 2], -1.0);
            continue;
        }
        ++num_points;
        const TextPoint& point = points_.at(row[kId]);
        const Vector3d written(row[0], row[1], row[2]);
        ASSERT_LT((written - Vector3d(point.place[0], point.place[1], point.place[2])).norm(),
                  1e-12);
        ASSERT_EQ(row[kId + 1], static_cast<double>(at_place_.at(point.place).size()));
        ASSERT_EQ(static_cast<float>(row[kId + 2]), static_cast<float>(point.error_px));
    }
    EXPECT_GT(num_points, num_vertices_ * 3 / 4); // others are on creases, or at trimmed faces
}

TEST_F(WrittenAttributes, IncludeTheSupportOfEveryFace)
{
    ASSERT_EQ(rows_.size(), num_vertices_ + 2 * num_faces_);
    std::set<double> supports;
    for (std::size_t f = 0; f < num_faces_; ++f) {
        const std::vector<double>& face = rows_[num_vertices_ + f];
        std::array<Vector3d, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& row = rows_[static_cast<std::size_t>(face[i + 1])];
            corners[i] = {row[0], row[1], row[2]};
        }
        const Vector3d normal =
            (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        const std::vector<double>& support = rows_[num_vertices_ + num_faces_ + f];
        std::ptrdiff_t expected = 1000;
        bool is_of_model = true; // no file has the views of added points
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& row = rows_[static_cast<std::size_t>(face[i + 1])];
            is_of_model = is_of_model && (row[kId] >= 0.0 || row[kId + 1] == 0.0);
            expected = std::min(expected, images_before(row, normal));
        }
        if (!is_of_model) continue;
        ASSERT_EQ(support, std::vector<double>{static_cast<double>(expected)}) << "face " << f;
        supports.insert(support[0]);
    }
    EXPECT_GT(supports.size(), 5U); // otherwise the test checks nothing
}

TEST_F(WrittenAttributes, ChangeNoOtherProperty)
{
    ASSERT_EQ(plain_.size(), num_vertices_ + num_faces_);
    for (std::size_t i = 0; i < plain_.size(); ++i) {
        ASSERT_EQ(plain_[i], std::vector<double>(rows_[i].begin(),
                                                 rows_[i].begin() + (i < num_vertices_ ? kId : 4)));
    }
}

} // namespace
} // namespace vcarve::provenance_test
