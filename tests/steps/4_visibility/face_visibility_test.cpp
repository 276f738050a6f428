#include "geometry/predicates.h"
#include "steps/4_visibility/face_visibility.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vcarve::face_visibility_test {
namespace {

using Eigen::Vector3d;
using testing::aim;
using testing::cell_of;
using testing::facet_across;
using testing::LabeledScene;
using testing::labels_where;
using testing::middle;
using Meets = FaceVisibility::Meets;

/// Two tetrahedra in a wide box: points 0 to 3 with the base at z = -3, and points 4 to 7 with the
/// base at z = 0. Views look up, so the first occludes the second from below.
struct TwoTetrahedra {
    explicit TwoTetrahedra(const std::vector<Vector3d>& centers, bool first = true,
                           bool second = true)
        : TwoTetrahedra(make_scene(centers, points()), first, second)
    {
    }
    TwoTetrahedra(Scene scene, bool first, bool second)
        : made(std::move(scene),
               [&](const TetMesh& mesh) {
                   Labels labels(mesh.cells.size(), Label::outside);
                   if (first) labels[cell_of(mesh, {0, 1, 2, 3})] = Label::inside;
                   if (second) labels[cell_of(mesh, {4, 5, 6, 7})] = Label::inside;
                   return labels;
               }),
          first_base(facet_across(made.mesh, cell_of(made.mesh, {0, 1, 2, 3}), 3)),
          base(facet_across(made.mesh, cell_of(made.mesh, {4, 5, 6, 7}), 7))
    {
    }

    static std::vector<MadePoint> points()
    {
        std::vector<MadePoint> points;
        for (const double z : {-3.0, 0.0}) {
            points.push_back({{-1, -1, z}, {}});
            points.push_back({{1, -1, z}, {}});
            points.push_back({{0, 1, z}, {}});
            points.push_back({{0, 0, z + 1}, {}});
        }
        for (const Vector3d& corner : mapped(lattice(2), 20.0, Vector3d::Constant(-10.0))) {
            points.push_back({corner, {}});
        }
        return points;
    }
    bool sees(std::uint32_t view, const Vector3d& place = kMiddle) const
    {
        return made.visibility.sees(view, base, place);
    }

    inline static const Vector3d kMiddle{0.0, -1.0 / 3.0, 0.0};
    inline static const Vector3d kFirstMiddle{0.0, -1.0 / 3.0, -3.0};
    LabeledScene made;
    CellFacet first_base;
    CellFacet base;
};

/// Aims all views at one position.
Scene aimed(Scene scene, const Vector3d& place)
{
    for (View& view : scene.views) {
        aim(view, place);
    }
    return scene;
}

// ---- sees ---------------------------------------------------------------------------------------

TEST(FaceVisibility, SeesAFacetFromInFront)
{
    const TwoTetrahedra scene({{0, 0, -5}, {0, 0, -50}}, false, true);
    EXPECT_TRUE(scene.sees(0)) << "from inside the hull";
    EXPECT_TRUE(scene.sees(1)) << "from outside the hull";
}

TEST(FaceVisibility, DoesNotSeeAFacetFromBehind)
{
    const TwoTetrahedra scene(
        aimed(make_scene({{0.2, 0.3, 5}, {6, 0, 0.5}}, TwoTetrahedra::points()), {0, 0, 0}), false,
        true);
    EXPECT_FALSE(scene.sees(0));
    EXPECT_FALSE(scene.sees(1));
}

TEST(FaceVisibility, DoesNotSeeAFacetAtGrazingAngles)
{
    // 87.2 and 87.0 degrees from the normal; angles are grazing up to a cosine of 0.05.
    const double y = TwoTetrahedra::kMiddle.y();
    const TwoTetrahedra scene(
        aimed(make_scene({{4, y, -0.195}, {4, y, -0.205}, {4, y, 0}}, TwoTetrahedra::points()),
              TwoTetrahedra::kMiddle),
        false, true);
    EXPECT_FALSE(scene.sees(0));
    EXPECT_TRUE(scene.sees(1));
    EXPECT_FALSE(scene.sees(2));
}

TEST(FaceVisibility, SeesOnlyWhatTheImageShows)
{
    // At depth 5 an image extends 3.2 to the sides and 2.4 up and down.
    const double y = TwoTetrahedra::kMiddle.y();
    const TwoTetrahedra scene({{3.1, y, -5}, {3.3, y, -5}, {0, y + 2.3, -5}, {0, y - 2.5, -5}},
                              false, true);
    EXPECT_TRUE(scene.sees(0));
    EXPECT_FALSE(scene.sees(1));
    EXPECT_TRUE(scene.sees(2));
    EXPECT_FALSE(scene.sees(3));
}

TEST(FaceVisibility, DoesNotSeeThroughInsideCells)
{
    const std::vector<Vector3d> centers = {{0, 0, -5}, {0, 0, -50}, {0, 0, -1}, {2.5, 0, -4}};
    const TwoTetrahedra both(centers);
    EXPECT_FALSE(both.sees(0));
    EXPECT_FALSE(both.sees(1));
    EXPECT_TRUE(both.sees(2)) << "from between both";
    EXPECT_TRUE(both.sees(3)) << "past the first tetrahedron";
    const TwoTetrahedra one(centers, false, true);
    EXPECT_TRUE(one.sees(0));
    EXPECT_TRUE(one.sees(1));
}

TEST(FaceVisibility, DoesNotSeeThroughTheEdgeOfAnInsideCell)
{
    // The ray enters the first tetrahedron through the edge from (0, 1, -3) to (0, 0, -2).
    const TwoTetrahedra scene({{0, 0, -5}});
    EXPECT_FALSE(scene.sees(0, {0, 0.6, 0}));
}

TEST(FaceVisibility, SeesNothingFromWithinAnInsideCell)
{
    const TwoTetrahedra scene({{0, 0, -2.5}});
    EXPECT_FALSE(scene.sees(0));
}

// ---- places_on, is_seen -------------------------------------------------------------------------

TEST(FaceVisibility, SpreadsSamplesOverAFacet)
{
    // The samples are the centroid, one near each corner, and one near each edge midpoint. They are
    // compared by sorted barycentric coordinates.
    const TwoTetrahedra scene({});
    Eigen::Matrix3d corners;
    corners << -1, 1, 0, -1, -1, 1, 1, 1, 1; // x, y and the sum of barycentric coordinates
    std::vector<int> at_corner(3, 0);
    std::vector<int> at_edge(3, 0);
    const auto places = scene.made.visibility.places_on(scene.base);
    EXPECT_TRUE(places[0].isApprox(TwoTetrahedra::kMiddle, 1e-12));
    for (std::size_t i = 1; i < places.size(); ++i) {
        EXPECT_EQ(places[i].z(), 0.0);
        Vector3d shares = corners.inverse() * Vector3d(places[i].x(), places[i].y(), 1.0);
        int most = 0;
        int least = 0;
        shares.maxCoeff(&most);
        shares.minCoeff(&least);
        std::ranges::sort(shares);
        if (shares.isApprox(Vector3d(0.1, 0.1, 0.8), 1e-12)) ++at_corner[most];
        if (shares.isApprox(Vector3d(0.05, 0.475, 0.475), 1e-12)) ++at_edge[least];
    }
    EXPECT_EQ(at_corner, std::vector<int>(3, 1));
    EXPECT_EQ(at_edge, std::vector<int>(3, 1));
}

/// The samples of a facet with corners at 0 and at x = 10, y = +- half the width.
std::vector<Vector3d> places_on_facet_of_width(double width)
{
    const LabeledScene made(make_scene({}, {{{0, 0, 0}, {}},
                                            {{10, -0.5 * width, 0}, {}},
                                            {{10, 0.5 * width, 0}, {}},
                                            {{7, 0, 5}, {}}}),
                            testing::solid);
    return made.visibility.places_on(facet_across(made.mesh, cell_of(made.mesh, {0, 1, 2, 3}), 3));
}

TEST(FaceVisibility, AddsSamplesNearTheCornersOfAThinFacet)
{
    EXPECT_EQ(places_on_facet_of_width(2.1).size(), 7U); // the long edges are 10.06 long
    const double width = 1.0;
    const std::vector<Vector3d> places = places_on_facet_of_width(width);
    ASSERT_EQ(places.size(), 10U);
    const double share = width / std::hypot(10.0, 0.5 * width);
    const Vector3d middle(20.0 / 3.0, 0.0, 0.0);
    for (const Vector3d& corner : {Vector3d(0, 0, 0), {10, -0.5, 0}, {10, 0.5, 0}}) {
        const Vector3d expected = corner + share * (middle - corner);
        EXPECT_EQ(std::count_if(places.begin() + 7, places.end(),
                                [&](const Vector3d& p) { return (p - expected).norm() < 1e-12; }),
                  1);
    }
}

TEST(FaceVisibility, SeesAFacetWithoutTracks)
{
    const TwoTetrahedra seen({{0, 0, -5}}, false, true);
    EXPECT_TRUE(seen.made.visibility.is_seen(seen.base));
    const TwoTetrahedra unseen({{0.03, 0, -5}, {9, 9, -5}}, true, true);
    EXPECT_FALSE(unseen.made.visibility.is_seen(unseen.base));
    EXPECT_TRUE(unseen.made.visibility.is_seen(unseen.first_base));
    const TwoTetrahedra nobody({});
    EXPECT_FALSE(nobody.made.visibility.is_seen(nobody.base));
}

TEST(FaceVisibility, TriesTheNearestThirtyTwoCandidateViews)
{
    const auto is_seen_beside = [](std::size_t num_hidden) {
        std::vector<Vector3d> centers(num_hidden, Vector3d(0.03, 0.0, -5.0));
        centers.emplace_back(8.0, 0.0, -5.0); // from the side, farther away than the others
        Scene scene = make_scene(centers, TwoTetrahedra::points());
        const TwoTetrahedra pair(aimed(std::move(scene), TwoTetrahedra::kMiddle), true, true);
        return pair.made.visibility.is_seen(pair.base);
    };
    EXPECT_TRUE(is_seen_beside(0));
    EXPECT_TRUE(is_seen_beside(31));
    EXPECT_FALSE(is_seen_beside(32));
}

TEST(FaceVisibility, IgnoresTracksOfOccludedViews)
{
    auto points = TwoTetrahedra::points();
    for (MadePoint& point : points) {
        point.views = {0};
    }
    const TwoTetrahedra scene(make_scene({{0.03, 0, -5}}, points), true, true);
    EXPECT_FALSE(scene.made.visibility.is_seen(scene.base));
}

TEST(FaceVisibility, SeesAFacetIfOneSampleIsSeen)
{
    const TwoTetrahedra blind({});
    const auto places = blind.made.visibility.places_on(blind.base);
    for (std::size_t seen = 0; seen < places.size(); ++seen) {
        const Vector3d below(0.0, 0.0, -5.0);
        Scene narrow = make_scene({places[seen] + below}, TwoTetrahedra::points());
        narrow.cameras[0].params = {50'000.0, 50'000.0, 320.0, 240.0}; // shows 0.06 x 0.05
        const TwoTetrahedra scene(narrow, false, true);
        for (std::size_t i = 0; i < places.size(); ++i) {
            EXPECT_EQ(scene.sees(0, places[i]), i == seen);
        }
        EXPECT_TRUE(scene.made.visibility.is_seen(scene.base)) << seen;
    }
    Scene beside = make_scene({{0.2, 0.2, -5.0}}, TwoTetrahedra::points());
    beside.cameras[0].params = {50'000.0, 50'000.0, 320.0, 240.0};
    const TwoTetrahedra scene(beside, false, true);
    EXPECT_FALSE(scene.made.visibility.is_seen(scene.base));
}

// ---- met_behind ---------------------------------------------------------------------------------

TEST(FaceVisibility, MeetsTheFirstKeptFacetBehindAPosition)
{
    const std::vector<Vector3d> centers = {{0, 0, -5}, {0, 0, -500}};
    const TwoTetrahedra scene(centers);
    const auto met = [&](std::uint32_t view, const auto& is_kept) {
        return scene.made.visibility.met_behind(view, scene.first_base, TwoTetrahedra::kFirstMiddle,
                                                is_kept);
    };
    const auto is = [](const CellFacet& a, const CellFacet& b) {
        return a.cell == b.cell && a.slot == b.slot;
    };
    for (const std::uint32_t view : {0U, 1U}) {
        EXPECT_EQ(met(view, [](const CellFacet&) { return false; }), Meets::nothing);
        EXPECT_EQ(met(view, [](const CellFacet&) { return true; }), Meets::back);
        EXPECT_EQ(met(view, [&](const CellFacet& f) { return is(f, scene.base); }), Meets::front);
        EXPECT_EQ(met(view, [&](const CellFacet& f) { return f.cell == scene.base.cell; }),
                  Meets::front);
        EXPECT_EQ(met(view,
                      [&](const CellFacet& f) {
                          return f.cell == scene.base.cell && !is(f, scene.base);
                      }),
                  Meets::back);
        EXPECT_EQ(met(view, [&](const CellFacet& f) { return is(f, scene.first_base); }),
                  Meets::nothing)
            << "the facet itself is ignored";
    }
}

TEST(FaceVisibility, DistinguishesFrontFromBackBehindAnEdge)
{
    // The line leaves the first tetrahedron through an edge and enters the second by its base.
    const TwoTetrahedra scene({{0, 0, -5}});
    EXPECT_EQ(scene.made.visibility.met_behind(
                  0, scene.first_base, {0, 0.24, -3},
                  [&](const CellFacet& facet) { return facet.cell == scene.base.cell; }),
              Meets::front);
}

TEST(FaceVisibility, QueriesFacetsInOrderFromTheirInsideCells)
{
    const TwoTetrahedra scene({{0, 0, -5}});
    std::vector<double> heights;
    const auto note = [&](const CellFacet& facet) {
        EXPECT_EQ(scene.made.labels[facet.cell], Label::inside);
        EXPECT_EQ(scene.made.labels[scene.made.mesh.other_side(facet).cell], Label::outside);
        heights.push_back(middle(scene.made.mesh, facet).z());
        return false;
    };
    scene.made.visibility.met_behind(0, scene.first_base, TwoTetrahedra::kFirstMiddle, note);
    ASSERT_EQ(heights.size(), 3U);
    EXPECT_NEAR(heights[0], -3.0 + 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(heights[1], 0.0, 1e-12);
    EXPECT_NEAR(heights[2], 1.0 / 3.0, 1e-12);
}

// ---- brute force --------------------------------------------------------------------------------

/// The definition in the header, by a test of every boundary facet.
bool sees_by_brute_force(const LabeledScene& made, std::uint32_t view, std::size_t face,
                         const Vector3d& place)
{
    const Vector3d& center = made.scene.views[view].center;
    const auto corners = [&](std::size_t of) -> std::array<Vector3d, 3> {
        const auto& [a, b, c] = made.corners[of];
        return {made.mesh.positions[a], made.mesh.positions[b], made.mesh.positions[c]};
    };
    const auto [a, b, c] = corners(face);
    const Vector3d normal = (b - a).cross(c - a).normalized();
    if (normal.dot((center - place).normalized()) <= 0.05) return false;
    const Vector3d shown = made.scene.views[view].cam_from_world * (place - center);
    if (shown.z() <= 0.0) return false;
    if (std::abs(shown.x() / shown.z()) > 0.64 || std::abs(shown.y() / shown.z()) > 0.48) {
        return false;
    }
    for (std::size_t other = 0; other < made.corners.size(); ++other) {
        if (other != face && meets_triangle(place, center, corners(other))) return false;
    }
    return true;
}

/// Compares the visibility of all samples of all faces, and counts unseen and seen samples.
void expect_as_by_brute_force(const LabeledScene& made, std::array<int, 2>& counts)
{
    for (std::size_t face = 0; face < made.facets.size(); ++face) {
        bool is_seen = false;
        for (const Vector3d& place : made.visibility.places_on(made.facets[face])) {
            for (std::uint32_t view = 0; view < made.scene.views.size(); ++view) {
                const bool sees = sees_by_brute_force(made, view, face, place);
                ASSERT_EQ(made.visibility.sees(view, made.facets[face], place), sees)
                    << "view " << view << ", face " << face;
                is_seen |= sees;
                ++counts[sees ? 1 : 0];
            }
        }
        ASSERT_EQ(made.visibility.is_seen(made.facets[face]), is_seen) << "face " << face;
    }
}

TEST(FaceVisibility, MatchesBruteForce)
{
    Scene scene = aimed(bumpy_sphere(150, 41), {0.5, 0, 0});
    scene.views.resize(6);
    scene.views[0].center *= 0.2; // within the hull
    for (std::uint64_t& begin : scene.tracks.begins) {
        begin = 0; // no view saw a point
    }
    std::array<int, 2> counts{};
    for (const std::uint64_t flipped : {0U, 15U}) {
        std::mt19937_64 random(42);
        expect_as_by_brute_force({scene,
                                  [&](const TetMesh& mesh) {
                                      return labels_where(mesh, [&](Index cell) {
                                          const bool is_deep = middle(mesh, cell).norm() < 0.8;
                                          return is_deep != (pick(random, 100) < flipped);
                                      });
                                  }},
                                 counts);
    }
    EXPECT_GT(counts[0], 0);
    EXPECT_GT(counts[1], 0);
}

} // namespace
} // namespace vcarve::face_visibility_test
