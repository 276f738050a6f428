#include "geometry/triangle.h"
#include "steps/6_surface/make_surface.h"
#include "steps/6_surface/rims.h"
#include "steps/6_surface/sheets.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::LabelledScene;

constexpr int kSide = 7;

/// Points a step apart on the top of a slab and on its bottom, so much below, which two views above
/// show, and eight points far around that nobody saw.
Scene slab(double thickness)
{
    std::vector<MadePoint> points;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const double off = 0.01 * std::sin(5.0 * i + 3.0 * j * j);
            points.push_back({{i + off, j - off, 0.0}, {0, 1}});
            points.push_back({{i - off, j + off, -thickness}, {}});
        }
    }
    for (const double x : {-40.0, 46.0}) {
        for (const double y : {-41.0, 47.0}) {
            points.push_back({{x, y, -60.0}, {}});
            points.push_back({{x, y, 55.0}, {}});
        }
    }
    Scene scene = make_scene({{3.1, 2.8, 40.0}, {3.3, 2.9, 41.0}}, points);
    for (View& view : scene.views) {
        testing::aim(view, {3.0, 3.0, 0.0});
    }
    return scene;
}

struct Slab {
    explicit Slab(double thickness = 1.0)
        : made(slab(thickness), [&](const TetMesh& mesh) {
              return testing::labels_where(mesh, [&](Index cell) {
                  return std::ranges::all_of(mesh.cells[cell].vertices, [&](Index v) {
                      return std::abs(mesh.positions[v].x()) < 20.0;
                  });
              });
          })
    {
        for (const Face& face : made.surface.faces) {
            top.push_back(face_normal(made.surface.positions, face).z() > 0.9 ? 1 : 0);
            rest.push_back(top.back() == 0 ? 1 : 0);
        }
    }
    FaceFlags all() const { return FaceFlags(top.size(), 1); }
    bool shares_an_edge_with_top(std::size_t face) const
    {
        const auto& faces = made.surface.faces;
        for (std::size_t other = 0; other < faces.size(); ++other) {
            const auto common = std::ranges::count_if(faces[face], [&](std::uint32_t corner) {
                return std::ranges::count(faces[other], corner) > 0;
            });
            if (top[other] != 0 && common == 2) return true;
        }
        return false;
    }
    FaceFlags rounded(FaceFlags keep, const FaceFlags& may_return) const
    {
        round_off_rims(made.surface, made.facets, made.visibility, may_return, keep);
        return keep;
    }
    FaceFlags peeled(FaceFlags keep, double max_sheet) const
    {
        const auto before = std::ranges::count(keep, 1);
        const std::int64_t count =
            peel_sheets(made.surface, made.facets, made.visibility, {.max_sheet = max_sheet}, keep);
        EXPECT_EQ(count, before - std::ranges::count(keep, 1));
        return keep;
    }

    LabelledScene made;
    FaceFlags top;
    FaceFlags rest;
};

TEST(RoundOffRims, PutsBackTheSmallFacesBehindAnEdgeInView)
{
    const Slab slab;
    FaceFlags expected = slab.top;
    for (std::size_t face = 0; face < expected.size(); ++face) {
        if (slab.shares_an_edge_with_top(face)) expected[face] = 1;
    }
    ASSERT_NE(expected, slab.top);
    ASSERT_NE(expected, slab.all());
    EXPECT_EQ(slab.rounded(slab.top, slab.rest), expected);
}

TEST(RoundOffRims, PutsBackWhatMayReturnOnly)
{
    const Slab slab;
    EXPECT_EQ(slab.rounded(slab.top, FaceFlags(slab.top.size(), 0)), slab.top);
}

TEST(RoundOffRims, LeavesLargeFaces)
{
    const Slab slab(5.8); // less than six local edges, more than four usual faces
    EXPECT_EQ(slab.rounded(slab.top, slab.rest), slab.top);
}

TEST(SeenSurface, EndsBehindTheBendWhereItTurnsOutOfSight)
{
    Slab slab;
    Log log;
    const SeenSurface seen =
        seen_surface({slab.made.mesh, slab.made.labels}, slab.made.scene, {}, {}, log);
    EXPECT_EQ(size_of(seen.faces.faces.size()),
              std::ranges::count(slab.rounded(slab.top, slab.rest), 1));
}

TEST(RoundOffRims, LeavesWhatNoViewSeesTheEdgeOf)
{
    const Slab slab;
    EXPECT_EQ(slab.rounded(slab.rest, slab.top), slab.rest) << "the sides hide their own edges";
}

TEST(PeelSheets, TakesWhatIsHardlySeenOffTheRimHoweverSmall)
{
    const Slab slab;
    FaceFlags keep = slab.all();
    keep[static_cast<std::size_t>(std::ranges::find(slab.rest, 1) - slab.rest.begin())] = 0;
    EXPECT_EQ(slab.peeled(keep, 0.9), slab.top);
    EXPECT_EQ(slab.peeled(keep, 0.0), keep) << "0 takes nothing off";
    EXPECT_EQ(slab.peeled(slab.all(), 0.9), slab.all()) << "there is no rim";
}

TEST(PeelSheets, TakesWhatIsLongAndMostlyUnseenFromAnywhere)
{
    const Slab slab;
    EXPECT_EQ(slab.peeled(slab.all(), 0.01), slab.top);
}

} // namespace
} // namespace vcarve
