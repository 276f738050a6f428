#include "cli/surface_check.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::cli::surface_check_test {
namespace {

using ::testing::HasSubstr;

TriMesh tetrahedron()
{
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

/// What is said of a surface where a promise is broken; empty where none is.
std::string broken_promise(const TriMesh& mesh)
{
    try {
        Log silent;
        require_promised(checked(mesh, {}, silent), "colmap-vcarve a/model b.ply", "a/model");
        return "";
    } catch (const std::logic_error& error) {
        return error.what();
    }
}

TEST(Checked, CountsWhatASurfaceIs)
{
    Log silent;
    const Json json = checked(tetrahedron(), {}, silent);
    EXPECT_EQ(json["faces"], 4);
    EXPECT_EQ(json["self_intersections"], 0);
    EXPECT_TRUE(json["is_closed"]);
    TriMesh crossed = tetrahedron();
    crossed.positions.insert(crossed.positions.end(), {{0.1, 0.1, -1}, {0.1, 0.1, 9}, {9, 9, 9}});
    crossed.faces.push_back({4, 5, 6});
    EXPECT_EQ(checked(crossed, {}, silent)["self_intersections"], 2);
}

TEST(RequirePromised, TakesSurfacesWithHolesAndThroughThemselves)
{
    EXPECT_EQ(broken_promise(tetrahedron()), "");
    TriMesh open = tetrahedron();
    open.faces.pop_back();
    open.positions.insert(open.positions.end(), {{0.1, 0.1, -1}, {0.1, 0.1, 9}, {9, 9, 9}});
    open.faces.push_back({4, 5, 6});
    EXPECT_EQ(broken_promise(open), "");
}

TEST(RequirePromised, NamesWhatIsBrokenAndWhatRepeatsIt)
{
    TriMesh turned = tetrahedron();
    turned.faces[0] = {0, 1, 2};
    EXPECT_EQ(broken_promise(turned),
              "the surface has 3 orientation_faults, which none is to have, and was not written; "
              "colmap-vcarve a/model b.ply repeats it with a/model");
    TriMesh thrice = tetrahedron();
    thrice.positions.emplace_back(5, 5, 5);
    thrice.faces.push_back({0, 1, 4});
    EXPECT_THAT(broken_promise(thrice), HasSubstr("1 nonmanifold_edges"));
    TriMesh degenerate = tetrahedron();
    degenerate.faces.push_back({0, 1, 1});
    EXPECT_THAT(broken_promise(degenerate), HasSubstr("1 degenerate_faces"));
    TriMesh touching = tetrahedron();
    touching.positions.insert(touching.positions.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
    touching.faces.insert(touching.faces.end(), {{0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
    EXPECT_THAT(broken_promise(touching), HasSubstr("1 nonmanifold_vertices"));
}

TEST(Program, ChecksTheSurfaceWhereAsked)
{
    const TemporaryFolder folder;
    write_ball_model(folder / "ball", 200);
    const std::string out = folder / "out.ply";
    const Outcome outcome = run_program({folder / "ball", out, "--check", "-v"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                ::testing::ContainsRegex("\ncheck +[0-9,]+ of [0-9,]+ sights from behind [^\n]*\n"
                                         "write "));
    EXPECT_THAT(run_program({folder / "ball", out, "--check"}).err,
                ::testing::ContainsRegex("\ncheck +0 open edges[^\n]*\nwrote "));
}

} // namespace
} // namespace vcarve::cli::surface_check_test
