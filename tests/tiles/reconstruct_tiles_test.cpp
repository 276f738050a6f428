// Models in tiles: the surface, several ranks, and runs that were stopped.
#include "mesh/check.h"
#include "support/ranks_in_turn.h"
#include "support/scene_checks.h"
#include "support/scenes.h"
#include "tiles/reconstruct_tiles.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace vcarve::reconstruct_tiles_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

const Job kJob = {{"points3D.bin", "12 bytes"}};

struct NotingLog final : Log {
    void note(std::string_view sentence) override { notes.emplace_back(sentence); }
    std::vector<std::string> notes;
};

/// The faces of a mesh by the positions of their corners.
std::set<std::array<std::array<double, 3>, 3>> faces_of(const TriMesh& mesh)
{
    std::set<std::array<std::array<double, 3>, 3>> faces;
    for (const Face& face : mesh.faces) {
        std::array<std::array<double, 3>, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Eigen::Vector3d at = mesh.positions[face[i]] + mesh.offset;
            corners[i] = {at.x(), at.y(), at.z()};
        }
        std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
        faces.insert(corners);
    }
    return faces;
}

class ModelInTiles : public ::testing::Test {
  protected:
    TriMesh made_in_tiles(std::size_t most, std::size_t count = 1,
                          const std::function<void(const std::string&)>& meddle = {})
    {
        WorkFolder work(folder / "work");
        work.begin(kJob);
        RanksInTurn ranks(work, options, count);
        if (meddle) ranks.after_share = meddle;
        TiledRun run(work, options, log);
        const ModelPoints points = {
            .number = scene.num_points(),
            .read = [&](std::size_t part, const TakePoints& take, const Progress& /*progress*/) {
                PartsOfScene parts(scene);
                for (Scene next = parts.next(part, {}); next.num_points() > 0;
                     next = parts.next(part, {})) {
                    take(next);
                }
            }};
        run.plan(scene, points, most);
        TriMesh mesh = run.make(&ranks);
        tasks = ranks.tasks;
        work.clear();
        return mesh;
    }

    TriMesh whole_surface() const
    {
        Log silent;
        return reconstruct(scene, options, silent).mesh;
    }

    std::filesystem::path file_of(const std::string& stage) const
    {
        return folder / "work" / (stage + ".stage");
    }

    TemporaryFolder folder;
    Scene scene = bumpy_sphere(6000, 3);
    Options options;
    NotingLog log;
    std::vector<std::string> tasks;
};

TEST_F(ModelInTiles, HasTheFacesOfTheWholeButForAFew)
{
    const TriMesh whole = whole_surface();
    const TriMesh mesh = made_in_tiles(1500);
    const auto expected = faces_of(whole);
    const auto found = faces_of(mesh);
    std::vector<std::array<std::array<double, 3>, 3>> common;
    std::ranges::set_intersection(expected, found, std::back_inserter(common));
    EXPECT_GT(common.size() * 100, expected.size() * 97);
    EXPECT_NEAR(static_cast<double>(found.size()), static_cast<double>(expected.size()),
                0.01 * static_cast<double>(expected.size()));
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.orientation_faults, 0);
    EXPECT_EQ(check.unreferenced_vertices, 0);
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.colors.size(), mesh.positions.size());
}

TEST_F(ModelInTiles, IsTheSameForAnyNumberOfRanksAndThreads)
{
    const TriMesh alone = made_in_tiles(800);
    EXPECT_THAT(tasks, ElementsAre("task-points", "task-surfaces"));
    options.threads = 1;
    for (const std::size_t count : {2U, 5U}) {
        const TriMesh mesh = made_in_tiles(800, count);
        EXPECT_TRUE(mesh.positions == alone.positions) << count;
        EXPECT_TRUE(mesh.faces == alone.faces) << count;
        EXPECT_TRUE(mesh.colors == alone.colors) << count;
        EXPECT_TRUE(mesh.normals == alone.normals) << count;
    }
}

TEST_F(ModelInTiles, IsManifoldIfItIsADenseCloudWhoseTilesAreSimplified)
{
    scene.is_dense = true;
    const TriMesh mesh = made_in_tiles(1500);
    EXPECT_LT(mesh.faces.size(), faces_of(whole_surface()).size() * 2);
    EXPECT_TRUE(check_mesh(mesh).is_manifold());
}

TEST_F(ModelInTiles, ResumesAfterTheLastFinishedTile)
{
    const TriMesh expected = made_in_tiles(1500);
    const auto die = [](const std::string& task) {
        if (task == TiledRun::kSurfacesTask) throw std::runtime_error("killed");
    };
    EXPECT_THROW(made_in_tiles(1500, 1, die), std::runtime_error);
    const auto written = std::filesystem::last_write_time(file_of("tile-2-surface"));
    std::filesystem::remove(file_of("tile-1-surface"));
    std::filesystem::file_time_type found;
    const TriMesh mesh = made_in_tiles(1500, 1, [&](const std::string& /*task*/) {
        found = std::filesystem::last_write_time(file_of("tile-2-surface"));
    });
    EXPECT_EQ(found, written) << "it was not made again";
    EXPECT_TRUE(mesh.positions == expected.positions);
    EXPECT_TRUE(mesh.faces == expected.faces);
    EXPECT_FALSE(std::filesystem::exists(folder / "work")) << "the folder is removed at the end";
}

TEST_F(ModelInTiles, MakesDamagedTilesAgain)
{
    const TriMesh expected = made_in_tiles(1500);
    const TriMesh mesh = made_in_tiles(1500, 1, [&](const std::string& task) {
        const auto file =
            file_of(task == TiledRun::kPointsTask ? "tile-0-points" : "tile-1-surface");
        std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    });
    EXPECT_TRUE(mesh.positions == expected.positions);
    EXPECT_TRUE(mesh.faces == expected.faces);
    EXPECT_THAT(log.notes, Contains(HasSubstr("tile-0-points.stage: it has ")));
    EXPECT_THAT(log.notes, Contains(HasSubstr("tile-1-surface.stage: it has ")));
}

TEST_F(ModelInTiles, NamesAFileThatOnlyANewRunCanMake)
{
    const auto damage = [&](const std::string& /*task*/) {
        for (const char* const name : {"tile-0-points", "tile-0-read-0"}) {
            std::filesystem::resize_file(file_of(name), 100);
        }
    };
    EXPECT_THAT(
        refusal<InputError>([&] { made_in_tiles(1500, 1, damage); }),
        MatchesRegex("tile 1 of [0-9]+: .*tile 1 of .*tile-0-read-0.stage: it is truncated.*; "
                     "remove the work folder to start over"));
}

TEST_F(ModelInTiles, RejectsPointsWithoutASurface)
{
    for (Eigen::Vector3d& position : scene.positions) {
        position.z() = 0.0;
    }
    EXPECT_THAT(refusal<InputError>([&] { made_in_tiles(1500); }), HasSubstr("no surface found"));
}

} // namespace
} // namespace vcarve::reconstruct_tiles_test
