#include "model/keypoints.h"
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

constexpr double kSide = 6.0;
constexpr double kHeight = 3.0;
constexpr double kTop = 15.0; ///< of the box around

// The diagonal of what was looked at is 9. The view sees the lid whole: it goes from 3.5 times the
// length on.
constexpr double kLong = 2.7;
constexpr SheetOptions kSeenFromLong = {.max_sheet = kLong / 3.5 / 9.0};

/// Points a step apart on the walls of a hall without a ceiling, and on the rim of its floor, whose
/// middle is plain; all seen from a view on the floor that looks up and shows everything above it.
/// Eight points far around that nobody saw, but another view looks down on them.
Scene open_hall()
{
    std::vector<MadePoint> points;
    for (const Vector3d& p : lattice(static_cast<int>(kSide) + 1)) {
        const double to_wall = std::min({p.x(), p.y(), kSide - p.x(), kSide - p.y()});
        const bool is_floor = p.z() == 0.0 && to_wall <= 1.0;
        if (is_floor || (to_wall == 0.0 && p.z() <= kHeight)) points.push_back({p, {0}});
    }
    for (const double x : {-30.0, 36.0}) {
        for (const double y : {-30.0, 36.0}) {
            points.push_back({{x, y, -kTop}, {}});
            points.push_back({{x, y, kTop}, {}});
        }
    }
    Scene scene = make_scene({{3.1, 2.8, 0.4}, {3.0, 3.0, 90.0}}, points);
    scene.cameras[0].params = {50.0, 50.0, 320.0, 240.0};
    testing::aim(scene.views[1], {3.0, 3.0, 0.0});
    return scene;
}

/// Only the hall is free.
Labels around_the_hall(const TetMesh& mesh)
{
    return testing::labels_where(mesh, [&](Index cell) {
        const Vector3d p = testing::middle(mesh, cell);
        return !(p.x() > 0.0 && p.y() > 0.0 && p.x() < kSide && p.y() < kSide && p.z() > 0.0 &&
                 p.z() < kHeight);
    });
}

/// Where a face lies.
enum class Part { hall, lid, top, around };

struct Hall {
    Hall() : made(open_hall(), around_the_hall)
    {
        for (const Face& face : made.corners) {
            parts.push_back(part_of(face));
        }
    }
    Part part_of(const Face& face) const
    {
        const auto all_at = [&](double z) {
            return std::ranges::all_of(
                face, [&](Index corner) { return made.mesh.positions[corner].z() == z; });
        };
        if (all_at(kTop)) return Part::top;
        if (all_at(kHeight)) return Part::lid;
        const bool is_far = std::ranges::any_of(
            face, [&](Index corner) { return std::abs(made.mesh.positions[corner].z()) == kTop; });
        return is_far ? Part::around : Part::hall;
    }
    FaceFlags all_but(const std::set<Part>& left_out) const
    {
        FaceFlags keep;
        for (const Part part : parts) {
            keep.push_back(left_out.contains(part) ? 0 : 1);
        }
        return keep;
    }
    double longest_edge(std::size_t face) const
    {
        const auto& [a, b, c] = made.corners[face];
        const auto& positions = made.mesh.positions;
        return std::max({(positions[a] - positions[b]).norm(), (positions[b] - positions[c]).norm(),
                         (positions[c] - positions[a]).norm()});
    }
    /// `keep` without the faces of a part that have an edge so long.
    FaceFlags without(FaceFlags keep, Part part, double edge) const
    {
        for (std::size_t face = 0; face < keep.size(); ++face) {
            if (parts[face] == part && longest_edge(face) >= edge) keep[face] = 0;
        }
        return keep;
    }
    /// `keep` without the first of the long faces of the lid, where its rim then is.
    FaceFlags opened(FaceFlags keep, double edge = kLong) const
    {
        for (std::size_t face = 0; face < keep.size(); ++face) {
            if (parts[face] != Part::lid || longest_edge(face) < edge) continue;
            keep[face] = 0;
            break;
        }
        return keep;
    }
    std::int64_t peel(const SheetOptions& options, FaceFlags& keep) const
    {
        return peel_sheets(made.surface, made.facets, made.visibility, options, keep);
    }

    LabelledScene made;
    std::vector<Part> parts;
};

/// Fails unless the peeled faces are those that `expected` lacks.
void expect_peeled(const Hall& hall, const SheetOptions& options, FaceFlags keep,
                   const FaceFlags& expected)
{
    const auto before = std::ranges::count(keep, 1);
    EXPECT_EQ(hall.peel(options, keep), before - std::ranges::count(expected, 1));
    EXPECT_EQ(keep, expected);
}

TEST(PeelSheets, TakesTheLidOffAnOpenHallFromItsRimButNotItsPlainFloor)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}));
    const FaceFlags without_lid = hall.without(keep, Part::lid, kLong);
    const FaceFlags without_floor = hall.without(keep, Part::hall, kLong);
    ASSERT_NE(without_lid, keep);
    ASSERT_NE(without_floor, keep) << "the floor has faces as long";
    expect_peeled(hall, kSeenFromLong, keep, without_lid);
}

TEST(PeelSheets, TakesOffWhatViewsSeeOnlyIfItIsSeveralTimesAsLong)
{
    constexpr double kVast = 5.4; // a length between those of the faces of the lid
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}), kVast);
    const FaceFlags rest = hall.without(keep, Part::lid, kVast);
    ASSERT_NE(rest, keep);
    ASSERT_NE(hall.without(rest, Part::lid, kVast / 1.7), rest);
    expect_peeled(hall, {.max_sheet = kVast / 3.5 / 9.0}, keep, rest);
}

TEST(PeelSheets, TakesOffWhatViewsSeeInPartIfItIsTwiceAsLong)
{
    Hall hall;
    hall.made.scene.cameras[0].params = {270.0, 270.0, 320.0, 240.0}; // of the lid the middle
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}));
    const FaceFlags rest = hall.without(keep, Part::lid, kLong);
    ASSERT_NE(rest, keep);
    expect_peeled(hall, {.max_sheet = kLong / 2.0 / 9.0}, keep, rest);
}

TEST(PeelSheets, TakesOffWhatHangsBeforeTheSkyIfItIsTwiceAsLong)
{
    Hall hall;
    View& view = hall.made.scene.views[0];
    const Camera& camera = hall.made.scene.cameras[view.camera];
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}));
    const FaceFlags rest = hall.without(keep, Part::lid, kLong);
    const SheetOptions options = {.max_sheet = kLong / 2.0 / 9.0};
    ASSERT_NE(rest, keep);
    for (double u = 1.0; u < static_cast<double>(camera.width_px); u += 4.0) {
        for (double v = 1.0; v < static_cast<double>(camera.height_px); v += 4.0) {
            count_keypoint(view, camera, {u, v});
        }
    }
    expect_peeled(hall, options, keep, keep);
    view.keypoints.assign(view.keypoints.size(), 0);
    count_keypoint(view, camera, {1.0, 1.0}); // a corner of the image, not on the lid
    expect_peeled(hall, options, keep, rest);
}

TEST(PeelSheets, TakesNothingSeenOutOfTheMiddle)
{
    const Hall hall;
    const FaceFlags keep = hall.all_but({Part::top, Part::around});
    expect_peeled(hall, kSeenFromLong, keep, keep);
}

TEST(PeelSheets, LeavesWhatIsNoLongerThanTheShare)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::top, Part::around}));
    ASSERT_NE(hall.without(keep, Part::lid, 9.0 * 0.5), keep);
    expect_peeled(hall, {.max_sheet = 0.475}, keep, keep);
}

TEST(PeelSheets, TakesNoneWhereNotAsked)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({}));
    expect_peeled(hall, {.max_sheet = 0.0}, keep, keep);
}

TEST(PeelSheets, LeavesALidThatHidesTheBackOfAKeptFace)
{
    const Hall hall;
    const FaceFlags keep = hall.opened(hall.all_but({Part::around}));
    expect_peeled(hall, kSeenFromLong, keep, keep);
}

TEST(PeelSheets, TakesUnseenFacesOfTheHullAndThenWhatTheyWereBehind)
{
    // The box around goes first, since nobody looks at it: then it is no back behind the lid.
    Hall hall;
    hall.made.scene.views[1].center.z() = -90.0; // what visibility refers to
    testing::aim(hall.made.scene.views[1], {3.0, 3.0, -200.0});
    const FaceFlags keep = hall.opened(hall.all_but({}));
    const FaceFlags open = hall.opened(hall.all_but({Part::top, Part::around}));
    expect_peeled(hall, kSeenFromLong, keep, hall.without(open, Part::lid, kLong));
}

TEST(PeelSheets, TakesNoFaceThatIsNotKept)
{
    const Hall hall;
    const FaceFlags none(hall.parts.size(), 0);
    expect_peeled(hall, kSeenFromLong, none, none);
}

TEST(PeelSheets, TakesTheSameFromOneThreadAndTwo)
{
    const Hall hall;
    const auto by = [&](int threads) {
        FaceFlags keep = hall.all_but({});
        testing::with_threads(threads, [&] { return hall.peel(kSeenFromLong, keep); });
        return keep;
    };
    EXPECT_EQ(by(1), by(2));
}

} // namespace
} // namespace vcarve
