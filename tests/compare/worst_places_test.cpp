#include "base/numbers.h"
#include "compare/truth.h"
#include "compare/worst_places.h"
#include "support/measured_scenes.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vcarve::worst_places_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<Eigen::Vector3d> on_a_line(const std::vector<double>& x)
{
    std::vector<Eigen::Vector3d> places;
    for (const double coordinate : x) {
        places.emplace_back(coordinate, 0.5, 0.5);
    }
    return places;
}

constexpr WorstChoice kChoice{.cell = 1.0, .apart = 2.0, .least = 0.1, .count = 8};

TEST(WorstSamples, RankCubesByAreaTimesDistance)
{
    // The sums of cubes 0, 1, 10 and 20 are 2.5, 2, 0 and 3; cubes 0 and 1 are neighbors.
    const auto places = on_a_line({0.5, 0.6, 1.5, 10.5, 20.5});
    EXPECT_THAT(worst_samples(places, std::vector{1.0, 1.5, 2.0, 0.1, 3.0}, kChoice),
                ElementsAre(4, 1));
}

TEST(WorstSamples, AreAtMostCount)
{
    WorstChoice choice = kChoice;
    choice.count = 2;
    EXPECT_THAT(worst_samples(on_a_line({-5.5, 0.5, 5.5}), std::vector{1.0, 3.0, 2.0}, choice),
                ElementsAre(1, 2));
}

TEST(WorstSamples, KeepTheirOrderInTies)
{
    EXPECT_THAT(worst_samples(on_a_line({9.5, 0.5, 5.5}), std::vector{1.0, 1.0, 1.0}, kChoice),
                ElementsAre(0, 1, 2));
}

TEST(WorstSamples, NameADistantRegionOnce)
{
    // The distance of the first two is less than their distances to the surface; the third is far.
    EXPECT_THAT(
        worst_samples(on_a_line({100.5, 60.5, 0.5}), std::vector{100.0, 60.0, 1.0}, kChoice),
        ElementsAre(0, 2));
}

TEST(WorstSamples, ExcludeNearSamples)
{
    EXPECT_THAT(worst_samples(on_a_line({0.5, 3.5}), std::vector{0.1, 0.0}, kChoice), IsEmpty());
    EXPECT_THAT(worst_samples({}, {}, kChoice), IsEmpty());
}

TEST(WorstSamples, AreSpreadApartAndComplete)
{
    std::vector<Eigen::Vector3d> places;
    std::vector<double> distances;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        places.emplace_back(20.0 * random_number(1, 3 * i), 20.0 * random_number(1, 3 * i + 1),
                            0.0);
        distances.push_back(4.0 * random_number(2, i));
    }
    WorstChoice choice = kChoice;
    choice.count = places.size();
    const std::vector<std::size_t> named = worst_samples(places, distances, choice);
    EXPECT_GT(named.size(), 10U);
    const auto lone = [&](std::size_t a, std::size_t b) {
        return std::max(choice.apart, std::min(distances[a], distances[b]));
    };
    const auto clash = [&](std::size_t a, std::size_t b) {
        return a != b && (places[a] - places[b]).norm() < lone(a, b);
    };
    std::size_t clashes = 0;
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool is_named = std::ranges::count(named, i) > 0;
        const bool is_near =
            std::ranges::any_of(named, [&](std::size_t other) { return clash(i, other); });
        if (is_named && is_near) ++clashes;
        // Whether the sample is the farthest of its cube.
        const bool speaks = std::ranges::none_of(places, [&](const Eigen::Vector3d& place) {
            const auto k = static_cast<std::size_t>(&place - places.data());
            const bool same = std::floor(place.x()) == std::floor(places[i].x()) &&
                              std::floor(place.y()) == std::floor(places[i].y());
            return same && distances[k] > distances[i];
        });
        EXPECT_TRUE(speaks || !is_named);
        if (!is_named && speaks && distances[i] > choice.least && !is_near) ++left_out;
    }
    EXPECT_EQ(clashes, 0U);
    EXPECT_EQ(left_out, 0U);
}

/// The reference of a square at height 0, seen by four views above it.
Reference square_reference(bool with_truth)
{
    const NamedMesh truth{"gt.ply", testing::square()};
    return make_reference(testing::scene_above_square(11, testing::high_centers()),
                          with_truth ? &truth : nullptr, testing::few_samples());
}

TEST(DiagonalOf, UsesTheTruthOrElseThePoints)
{
    const Reference with_truth = square_reference(true);
    EXPECT_EQ(diagonal_of(with_truth), with_truth.truth->diagonal);
    EXPECT_NEAR(diagonal_of(square_reference(false)), std::sqrt(2.0), 1e-12);
}

/// The positions where a mesh is farthest from the square.
std::vector<WorstPlace> wrong(const TriMesh& mesh, const Reference& reference)
{
    const MeasuredMesh placed = place_mesh({"a.ply", mesh}, reference);
    const TriangleTree& square = reference.truth->surface.tree;
    return largest_deviations(placed, surface_distances(placed, square, reference), reference, 4);
}

TEST(WrongPlaces, AreFarFromTheTruth)
{
    const Reference reference = square_reference(true);
    const double diagonal = diagonal_of(reference);
    const auto places =
        wrong(testing::together(testing::square(), testing::strip(0.4, 0.6, 0.3)), reference);
    ASSERT_GE(places.size(), 2U);
    for (const WorstPlace& place : places) {
        EXPECT_NEAR(place.position.z() + reference.origin.z(), 0.3, 1e-12);
        EXPECT_NEAR(place.distance, 0.3 / diagonal, 1e-12);
        EXPECT_NEAR(place.towards.norm(), 1.0, 1e-12);
        EXPECT_GT(place.towards.z(), 0.9);
        EXPECT_EQ(place.views, 4);
        // A view is at this viewpoint.
        const Eigen::Vector3d eye = place.position + place.reach * place.towards;
        EXPECT_TRUE(std::ranges::any_of(reference.scene.views, [&](const View& view) {
            return (view.center - eye).norm() < 1e-9;
        }));
    }
    EXPECT_GE((places[0].position - places[1].position).norm(), 0.3);
}

TEST(WrongPlaces, HaveNoViewsIfTheyAreHidden)
{
    const Reference reference = square_reference(true);
    const auto places =
        wrong(testing::together(testing::square(), testing::strip(0.4, 0.6, -0.3)), reference);
    ASSERT_GE(places.size(), 1U);
    EXPECT_EQ(places[0].views, 0);
    EXPECT_EQ(places[0].towards, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(places[0].reach, 0.0);
}

TEST(WrongPlaces, AreEmptyForTheTruth)
{
    EXPECT_THAT(wrong(testing::square(), square_reference(true)), IsEmpty());
}

TEST(MissingPlaces, AreFarFromTheMesh)
{
    const Reference reference = square_reference(true);
    const double diagonal = diagonal_of(reference);
    const MeasuredMesh half = place_mesh({"a.ply", testing::strip(0.0, 0.5, 0.0)}, reference);
    const auto places = largest_gaps(half, reference, 4);
    ASSERT_GE(places.size(), 2U);
    EXPECT_GT(places[0].distance, 0.45 / diagonal);
    for (const WorstPlace& place : places) {
        EXPECT_NEAR(place.position.x() + reference.origin.x(), 0.5 + place.distance * diagonal,
                    1e-9);
        EXPECT_GT(place.towards.z(), 0.9);
        EXPECT_EQ(place.views, std::nullopt);
    }
    EXPECT_GE((places[0].position - places[1].position).norm(), 0.08 * diagonal);
}

TEST(WorstPlaces, AreIdenticalForAnyThreadCount)
{
    const auto positions = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<Eigen::Vector3d> found;
        for (const WorstPlace& place :
             wrong(testing::together(testing::square(), testing::strip(0.1, 0.9, 0.2)),
                   square_reference(true))) {
            found.push_back(place.position);
        }
        return found;
    };
    EXPECT_EQ(positions(1), positions(3));
}

} // namespace
} // namespace vcarve::worst_places_test
