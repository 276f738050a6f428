#include "geometry/triangle.h"
#include "mesh/check.h"
#include "support/tents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace vcarve::trim_test {
namespace {

using Eigen::Vector3d;

/// A view that shows all of the second base.
const Eye kShowsAside{Vector3d(0, 0, -30) + kAside};

/// Tents of which one image shows only a part of the first base.
Tents half_shown()
{
    return Tents({{{-4, -1.5, -7}}, kShowsAside});
}

/// Tents whose bases are completely in the images, but the third tent occludes a part of the first.
Tents half_hidden()
{
    return Tents({{{-0.6, -1.5, -30}}, kShowsAside}, true);
}

/// The visible area of a face, and the part of it that trimming removed.
struct SeenArea {
    double seen = 0.0;
    double lost = 0.0;
};

SeenArea seen_area(const Tents& tents, std::size_t face)
{
    const std::vector<Piece> pieces = tents.pieces();
    const std::vector<Vector3d> places = grid_on(tents.whole(face), 90);
    const double each = tents.whole_area(face) / static_cast<double>(places.size());
    SeenArea area;
    for (const Vector3d& place : places) {
        if (!tents.is_seen(face, place)) continue;
        area.seen += each;
        const bool lies_on_kept = std::ranges::any_of(pieces, [&](const Piece& piece) {
            return piece.origin == face && piece.is_kept && lies_on(piece.corners, place);
        });
        if (!lies_on_kept) area.lost += each;
    }
    return area;
}

/// Fails if three faces share an edge, two are not consistently oriented, or a vertex of one is
/// inside an edge of another.
void expect_no_cracks(const TriMesh& surface)
{
    const MeshCheck check = check_mesh(surface);
    EXPECT_EQ(check.nonmanifold_edges, 0);
    EXPECT_EQ(check.orientation_faults, 0);
    std::int64_t at_rims = 0;
    for (const Face& face : surface.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d middle =
                (surface.positions[face[i]] + surface.positions[face[(i + 1) % 3]]) / 2.0;
            const auto holds = [&](const Face& other) {
                return lies_on(corners_of(surface.positions, other), middle);
            };
            const auto faces = std::ranges::count_if(surface.faces, holds);
            at_rims += faces == 1 ? 1 : 0;
        }
    }
    EXPECT_EQ(check.boundary_edges, at_rims) << "an edge of one face lies on another";
}

/// Fails unless the pieces of each face cover it, and the kept pieces join without cracks.
void expect_whole(const Tents& tents)
{
    const std::vector<Piece> pieces = tents.pieces();
    EXPECT_EQ(pieces.size(), tents.boundary.faces.size()) << "each piece lies on one face";
    for (const Piece& piece : pieces) {
        for (const Vector3d& corner : piece.corners) {
            EXPECT_TRUE(lies_on(tents.whole(piece.origin), corner));
        }
        const auto& [a, b, c] = piece.corners;
        const auto& [p, q, r] = tents.whole(piece.origin);
        EXPECT_GT(scaled_normal(a, b, c).dot(scaled_normal(p, r, q)), 0.0);
    }
    for (std::size_t face = 0; face < tents.made.facets.size(); ++face) {
        EXPECT_NEAR(tents.area(face), tents.whole_area(face), 1e-9) << "face " << face;
    }
    expect_no_cracks(tents.kept());
    EXPECT_EQ(tents.keep.size(), tents.boundary.faces.size());
}

/// The number of faces that lost a piece.
std::int64_t faces_that_lost(const Tents& tents)
{
    std::set<std::size_t> found;
    for (const Piece& piece : tents.pieces()) {
        if (!piece.is_kept) found.insert(piece.origin);
    }
    return static_cast<std::int64_t>(found.size());
}

TEST(TrimFaces, KeepsThePartThatAnImageShows)
{
    // The kept part exceeds the visible one by a quarter of the length, or 0.07 of the face's.
    for (const auto& [long_edge, most_more] : {std::pair(4.0, 2.0), std::pair(1.0, 1.1)}) {
        Tents tents = half_shown();
        EXPECT_EQ(tents.trim(long_edge), 1);
        expect_whole(tents);
        const SeenArea area = seen_area(tents, tents.base());
        ASSERT_GT(area.seen, 0.4 * tents.whole_area(tents.base()));
        ASSERT_LT(area.seen, 0.6 * tents.whole_area(tents.base()));
        EXPECT_EQ(area.lost, 0.0);
        EXPECT_GT(tents.area(tents.base(), true), area.seen);
        EXPECT_LT(tents.area(tents.base(), true), area.seen + most_more);
    }
}

TEST(TrimFaces, KeepsTheUnoccludedPart)
{
    for (const auto& [long_edge, most_more] : {std::pair(4.0, 3.0), std::pair(1.0, 2.8)}) {
        Tents tents = half_hidden();
        tents.trim(long_edge);
        expect_whole(tents);
        const SeenArea area = seen_area(tents, tents.base());
        ASSERT_GT(area.seen, 0.6 * tents.whole_area(tents.base()));
        ASSERT_LT(area.seen, 0.7 * tents.whole_area(tents.base()));
        EXPECT_LT(area.lost, 0.002 * area.seen) << "between the samples";
        EXPECT_GT(tents.area(tents.base(), true), area.seen);
        EXPECT_LT(tents.area(tents.base(), true), area.seen + most_more);
    }
}

TEST(TrimFaces, KeepsOnlyVisiblePieces)
{
    constexpr double kBetween = 0.05; // share that may be seen between samples
    for (const bool is_hidden : {false, true}) {
        for (const double long_edge : {1.0, 4.0, 12.0}) {
            Tents tents = is_hidden ? half_hidden() : half_shown();
            tents.trim(long_edge);
            for (const Piece& piece : tents.pieces()) {
                if (longest_edge(tents.whole(piece.origin)) < 0.5 * long_edge) continue;
                const double seen = tents.share_seen(piece);
                EXPECT_TRUE(piece.is_kept ? seen > 0.0 : seen < kBetween)
                    << middle_of(piece.corners).transpose() << " at " << long_edge;
            }
        }
    }
}

TEST(TrimFaces, CountsTheFacesThatLostAPiece)
{
    Tents tents = half_hidden();
    const std::int64_t count = tents.trim(1.0);
    EXPECT_EQ(count, faces_that_lost(tents));
    EXPECT_EQ(count, 4) << "the base, and three sides of the occluded tent below";
}

TEST(TrimFaces, DropsUnseenFacesWithoutBisectingThem)
{
    Tents tents({kShowsAside});
    EXPECT_EQ(tents.trim(1.0), 1);
    EXPECT_EQ(tents.boundary.faces, tents.made.surface.faces);
    FaceFlags expected(tents.made.facets.size(), 1);
    expected[tents.base()] = 0;
    EXPECT_EQ(tents.keep, expected);
}

TEST(TrimFaces, KeepsCompletelyVisibleFaces)
{
    Tents tents = half_shown();
    tents.trim(1.0);
    const auto sides_and_base = {tents.face_of({4, 5, 7}), tents.face_of({5, 6, 7}),
                                 tents.face_of({4, 6, 7}), tents.base_aside()};
    for (const std::size_t face : sides_and_base) {
        EXPECT_EQ(tents.boundary.faces[face], tents.made.surface.faces[face]);
        EXPECT_EQ(tents.keep[face], 1);
        EXPECT_EQ(std::ranges::count_if(tents.pieces(),
                                        [&](const Piece& piece) { return piece.origin == face; }),
                  1);
    }
    // Faces beside the base are bisected with it, and all pieces stay.
    for (const std::size_t face :
         {tents.face_of({0, 1, 3}), tents.face_of({1, 2, 3}), tents.face_of({0, 2, 3})}) {
        EXPECT_NEAR(tents.area(face, true), tents.whole_area(face), 1e-9);
    }
}

TEST(TrimFaces, IgnoresKeptUnseenFaces)
{
    Tents tents = half_shown();
    tents.seen[tents.base()] = 0;
    EXPECT_EQ(tents.trim(1.0), 0);
    EXPECT_TRUE(tents.is_as_before());
}

TEST(TrimFaces, IgnoresDroppedFaces)
{
    Tents tents = half_shown();
    tents.keep[tents.base()] = 0;
    EXPECT_EQ(tents.trim(1.0), 0);
    EXPECT_TRUE(tents.is_as_before());
}

TEST(TrimFaces, DoesNothingIfDisabled)
{
    Tents tents = half_shown();
    EXPECT_EQ(tents.trim(0.0), 0);
    EXPECT_TRUE(tents.is_as_before());
    EXPECT_EQ(tents.boundary.positions.size(), tents.made.surface.positions.size());
}

TEST(TrimFaces, IgnoresFacesShorterThanHalfTheLength)
{
    Tents tents = half_shown();
    EXPECT_EQ(tents.trim(2.0 * kLongest * 1.01), 0);
    EXPECT_TRUE(tents.is_as_before());
    EXPECT_EQ(tents.trim(2.0 * kLongest * 0.99), 1);
    EXPECT_FALSE(tents.is_as_before());
}

TEST(TrimFaces, IgnoresFacesWithUnreliableImages)
{
    // The view saw the corners of the base, but its image shows only two of them.
    Scene scene = tents({{{-4, -1.5, -7}}, kShowsAside}, false);
    Tracks tracks;
    for (Index point = 0; point < scene.num_points(); ++point) {
        const std::vector<std::uint32_t> both = {0, 1};
        tracks.push_back(point < 3 ? std::span(both) : scene.tracks[point]);
    }
    scene.tracks = std::move(tracks);
    Tents tents(std::move(scene), false);
    EXPECT_EQ(tents.trim(1.0), 0);
    EXPECT_TRUE(tents.is_as_before());
}

TEST(TrimFaces, KeepsFacesSeenAtAGrazingAngle)
{
    Scene scene = tents({{{15, 0, -0.5}}, kShowsAside}, false); // 88 degrees off the normal
    testing::aim(scene.views[1], {0, 0, 0});
    Tents tents(std::move(scene), false);
    const Vector3d middle = middle_of(tents.whole(tents.base()));
    ASSERT_FALSE(tents.made.visibility.sees(1, tents.made.facets[tents.base()], middle));
    EXPECT_EQ(tents.trim(1.0), 0);
    EXPECT_TRUE(tents.is_as_before());
}

TEST(TrimFaces, IgnoresOcclusionByDroppedFaces)
{
    Tents tents = half_hidden();
    for (const Face& face : {Face{8, 9, 10}, Face{8, 9, 11}, Face{8, 10, 11}, Face{9, 10, 11}}) {
        tents.keep[tents.face_of(face)] = 0;
    }
    EXPECT_EQ(tents.trim(1.0), 0);
    EXPECT_TRUE(tents.is_as_before());
}

TEST(TrimFaces, AddsVerticesWithoutPoints)
{
    Tents tents = half_shown();
    tents.trim(1.0);
    const TriMesh& before = tents.made.surface;
    const std::size_t first = before.positions.size();
    ASSERT_GT(tents.boundary.positions.size(), first);
    ASSERT_EQ(tents.boundary.points.size(), tents.boundary.positions.size());
    ASSERT_EQ(tents.boundary.colors.size(), tents.boundary.positions.size());
    for (std::size_t vertex = 0; vertex < tents.boundary.points.size(); ++vertex) {
        EXPECT_EQ(tents.boundary.points[vertex], vertex < first ? before.points[vertex] : kNoPoint);
    }
}

TEST(TrimFaces, MergesPiecesThatAreAllKept)
{
    // The tip beyond x = 3.3 is not seen, but no piece has all samples there. The last piece has
    // the corners (5, -2), (2, 1) and (2.75, -2.25), and its longest edge is 4.24.
    Tents tents({{{3.3 - 0.64 * 12, 0.5, -12}}, kShowsAside});
    EXPECT_EQ(tents.trim(17.5), 0);
    EXPECT_TRUE(tents.is_as_before());
    EXPECT_GT(tents.boundary.positions.size(), tents.made.surface.positions.size())
        << "it was bisected";
}

TEST(TrimFaces, BisectsToASixteenthAtMost)
{
    Tents fine = half_shown();
    fine.trim(1.0);
    Tents finest = half_shown();
    finest.trim(0.1);
    EXPECT_EQ(finest.boundary.faces, fine.boundary.faces);
    EXPECT_EQ(finest.keep, fine.keep);
}

TEST(TrimFaces, IsTheSameForAnyThreadCount)
{
    const auto by = [&](int threads) {
        Tents tents = half_hidden();
        testing::with_threads(threads, [&] { return tents.trim(1.0); });
        return std::pair(tents.boundary.faces, tents.keep);
    };
    EXPECT_EQ(by(1), by(2));
}

} // namespace
} // namespace vcarve::trim_test
