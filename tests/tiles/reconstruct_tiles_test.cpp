// Models in tiles: the surface, several processes, and runs that were stopped.
#include "mesh/check.h"
#include "support/scene_checks.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "tiles/reconstruct_tiles.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>

namespace vcarve::reconstruct_tiles_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

const Job kJob = {{"points3D.bin", "12 bytes"}};

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
    /// The stages of a run in tiles.
    struct NotingStages final : Log {
        void stage_begins(std::string_view name) override
        {
            if (before_stage) before_stage(std::string(name));
        }
        void note(std::string_view sentence) override { notes.emplace_back(sentence); }
        std::function<void(const std::string&)> before_stage;
        std::vector<std::string> notes;
    };

    void plan(TiledRun& run, std::size_t most)
    {
        const auto read = [&](std::size_t part, const TakePoints& take, const Progress&) {
            PartsOfScene parts(scene);
            for (Scene next = parts.next(part, {}); next.num_points() > 0;
                 next = parts.next(part, {})) {
                take(next);
            }
        };
        run.plan({.scene = scene, .points = scene.num_points()}, read, most);
    }

    /// The surface made by one process, and by `helpers` more.
    TriMesh made_in_tiles(std::size_t most, int helpers = 0,
                          const std::function<void(const std::string&)>& before_stage = {})
    {
        WorkFolder work(folder / "work");
        work.begin(kJob);
        log.before_stage = before_stage;
        TiledRun run(work, options, log);
        std::vector<std::thread> others;
        for (int i = 0; i < helpers; ++i) {
            others.emplace_back([&] {
                WorkFolder shared(folder / "work");
                shared.begin(kJob);
                Log silent;
                EXPECT_TRUE(TiledRun(shared, options, silent).help());
            });
        }
        plan(run, most);
        TriMesh mesh = run.make();
        work.clear();
        for (std::thread& other : others) {
            other.join();
        }
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
    NotingStages log;
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

TEST_F(ModelInTiles, IsTheSameForAnyNumberOfProcessesAndThreads)
{
    const TriMesh alone = made_in_tiles(800);
    options.threads = 1;
    for (const int helpers : {0, 1, 3}) {
        const TriMesh mesh = made_in_tiles(800, helpers);
        EXPECT_TRUE(mesh.positions == alone.positions) << helpers;
        EXPECT_TRUE(mesh.faces == alone.faces) << helpers;
        EXPECT_TRUE(mesh.colors == alone.colors) << helpers;
        EXPECT_TRUE(mesh.normals == alone.normals) << helpers;
    }
}

TEST_F(ModelInTiles, IsMadeByAnotherProcessIfTheFirstDies)
{
    const TriMesh expected = made_in_tiles(800);
    std::optional<WorkFolder> first(folder / "work");
    first->begin(kJob);
    {
        TiledRun run(*first, options, log);
        plan(run, 800);
    }
    WorkFolder second(folder / "work");
    second.begin(kJob);
    first.reset();
    TiledRun run(second, options, log);
    EXPECT_FALSE(run.help()) << "it leads now";
    plan(run, 800);
    const TriMesh mesh = run.make();
    EXPECT_TRUE(mesh.positions == expected.positions);
    EXPECT_TRUE(mesh.faces == expected.faces);
}

TEST_F(ModelInTiles, IsManifoldIfItIsADenseCloudWhoseTilesAreSimplified)
{
    scene.is_dense = true;
    const TriMesh mesh = made_in_tiles(1500);
    EXPECT_LT(mesh.faces.size(), faces_of(whole_surface()).size() * 2);
    EXPECT_TRUE(check_mesh(mesh).is_manifold());
}

TEST_F(ModelInTiles, IsFinishedEvenIfItsJobIsDeleted)
{
    const auto expected = made_in_tiles(1500).faces;
    const TriMesh mesh = made_in_tiles(1500, 0, [&](const std::string& stage) {
        if (stage == "points") std::filesystem::remove(folder / "work/job");
    });
    EXPECT_TRUE(mesh.faces == expected);
}

TEST_F(ModelInTiles, ResumesAfterTheLastFinishedTile)
{
    const TriMesh expected = made_in_tiles(1500);
    const auto die = [](const std::string& stage) {
        if (stage == "join") throw std::runtime_error("killed");
    };
    EXPECT_THROW(made_in_tiles(1500, 0, die), std::runtime_error);
    const auto written = std::filesystem::last_write_time(file_of("tile-2-surface"));
    std::filesystem::remove(file_of("tile-1-surface"));
    std::filesystem::file_time_type found;
    const TriMesh mesh = made_in_tiles(1500, 0, [&](const std::string& stage) {
        if (stage == "join") found = std::filesystem::last_write_time(file_of("tile-2-surface"));
    });
    EXPECT_EQ(found, written) << "it was not made again";
    EXPECT_TRUE(mesh.positions == expected.positions);
    EXPECT_TRUE(mesh.faces == expected.faces);
    EXPECT_FALSE(std::filesystem::exists(folder / "work")) << "the folder is removed at the end";
}

TEST_F(ModelInTiles, MakesDamagedTilesAgain)
{
    const TriMesh expected = made_in_tiles(1500);
    const TriMesh mesh = made_in_tiles(1500, 0, [&](const std::string& stage) {
        if (stage != "surfaces" && stage != "join") return;
        const auto file = file_of(stage == "surfaces" ? "tile-0-points" : "tile-1-surface");
        std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    });
    EXPECT_TRUE(mesh.positions == expected.positions);
    EXPECT_TRUE(mesh.faces == expected.faces);
    EXPECT_THAT(log.notes, Contains(HasSubstr("tile-0-points.stage: it has ")));
    EXPECT_THAT(log.notes, Contains(HasSubstr("tile-1-surface.stage: it has ")));
}

TEST_F(ModelInTiles, NamesAFileThatOnlyANewRunCanMake)
{
    const auto damage = [&](const std::string& stage) {
        if (stage != "surfaces") return;
        for (const char* const name : {"tile-0-points", "tile-0-read-0"}) {
            std::filesystem::resize_file(file_of(name), 100);
        }
    };
    EXPECT_THAT(
        refusal<InputError>([&] { made_in_tiles(1500, 0, damage); }),
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
