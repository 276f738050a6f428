#include "compare/compare.h"
#include "io/colmap_model.h"
#include "io/ply.h"
#include "pipeline.h"

#include <gtest/gtest.h>

#include <filesystem>

// What the program is proud of, held to bounds on a fixture whose truth is known, at the defaults
// it ships. The bounds lie between what it makes and what it made before the pass they guard.

namespace vcarve {
namespace {

Scene scene_fixture()
{
    return read_colmap_model(std::filesystem::path(VCARVE_FIXTURES) / "scene" / "sparse_txt",
                             ModelFormat::text);
}

Comparison compared(const Options& options)
{
    Log silent;
    const Scene model = scene_fixture();
    const std::filesystem::path truth = std::filesystem::path(VCARVE_FIXTURES) / "scene/truth.ply";
    const NamedMesh known{"truth.ply", read_ply(truth)};
    const Yardstick yardstick = make_yardstick(model, &known, {.samples = 40000});
    return compare_mesh({"ours.ply", reconstruct(model, options, silent).mesh}, yardstick);
}

TEST(Quality, IsWholeAndTrueOnTheSceneAtShippedDefaults)
{
    const Comparison ours = compared({});
    ASSERT_TRUE(ours.truth && ours.truth->lines && ours.evidence.rays);
    EXPECT_GE(ours.truth->agreements[0].f_score, 0.735);
    EXPECT_LE(ours.truth->blocked, 0.095);
    EXPECT_GE(ours.truth->lines->seen_right, 0.693);
    EXPECT_LE(ours.truth->lines->torn, 0.0005);
    EXPECT_LE(ours.truth->lines->open, 0.1);
    EXPECT_LE(ours.evidence.rays->back_faces_seen, 0.0005);
    EXPECT_LE(ours.evidence.hidden_sights, 0.002);
    EXPECT_LE(ours.evidence.missed_points, 0.001);
    EXPECT_LE(ours.evidence.unsupported_area, 0.05);
    EXPECT_LE(ours.evidence.seen_boundary_edges, 60);
    EXPECT_EQ(ours.size.nonmanifold_edges + ours.size.nonmanifold_vertices, 0);
    EXPECT_EQ(ours.size.orientation_faults, 0);
}

} // namespace
} // namespace vcarve
