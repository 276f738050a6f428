#include "steps/5_labels/needles.h"
#include "support/made_cells.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using testing::labels_where;
using testing::middle;

constexpr int kSide = 8;
constexpr Index kTip = kSide * kSide; ///< the first of the points above the plate

/// A point above the plate, and how many views saw it.
struct Tip {
    Vector3d position;
    std::uint32_t views;
};

std::vector<std::uint32_t> first_views(std::uint32_t count)
{
    std::vector<std::uint32_t> views(count);
    std::iota(views.begin(), views.end(), 0U);
    return views;
}

/// A solid plate of points a unit apart, each seen by so many views, and points above it. Four
/// points far below that nobody saw.
struct Plate {
    explicit Plate(const std::vector<Tip>& tips, std::uint32_t views_of_plate = 5)
    {
        std::vector<MadePoint> points;
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; j < kSide; ++j) {
                const double unevenness = 0.02 * std::sin(7.0 * i + 3.0 * j * j);
                points.push_back({{i - 3.5 + unevenness, j - 3.5 - unevenness, unevenness},
                                  first_views(views_of_plate)});
            }
        }
        for (const Tip& tip : tips) {
            points.push_back({tip.position, first_views(tip.views)});
        }
        for (const double x : {-3.0, 3.1}) {
            for (const double y : {-3.2, 3.3}) {
                points.push_back({{x, y, -6.0}, {}});
            }
        }
        scene = make_scene(std::vector<Vector3d>(40, {0, 0, 60}), points);
        mesh = triangulate(scene);
        bare = labels_where(mesh, [&](Index cell) {
            return middle(mesh, cell).z() < 0.0 &&
                   std::ranges::none_of(mesh.cells[cell].vertices,
                                        [&](Index v) { return mesh.positions[v].z() > 1.0; });
        });
        labels = bare;
    }

    /// Cells with these points and else only points of the plate, within `reach` of its middle.
    std::vector<Index> cells_between(const std::vector<Index>& tips, double reach) const
    {
        std::vector<Index> found;
        for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
            const auto& vertices = mesh.cells[cell].vertices;
            const auto is_tip = [&](Index v) { return std::ranges::count(tips, v) > 0; };
            const auto is_plate = [&](Index v) {
                return v < kTip && mesh.positions[v].head<2>().norm() < reach;
            };
            const bool fits =
                std::ranges::all_of(vertices, [&](Index v) { return is_tip(v) || is_plate(v); });
            const auto count = std::ranges::count_if(vertices, is_tip);
            if (fits && count == static_cast<std::ptrdiff_t>(tips.size())) found.push_back(cell);
        }
        return found;
    }
    /// Calls the first of some cells inside, which must be there.
    void add(const std::vector<Index>& cells)
    {
        ASSERT_FALSE(cells.empty());
        labels[cells[0]] = Label::inside;
    }
    /// Takes needles back, and says how many.
    std::int64_t take_back(const NeedleOptions& options = {})
    {
        Labelling labelling(mesh, labels);
        const std::int64_t count = take_back_needles(scene, options, labelling);
        labels = labelling.labels();
        return count;
    }

    Scene scene;
    TetMesh mesh;
    Labels bare; ///< below the plate only
    Labels labels;
};

/// A plate with a spike of one cell up to a point that so many views saw.
Plate spike(std::uint32_t views, std::uint32_t views_of_plate = 5, double height = 6.0)
{
    Plate plate({{{0.1, 0.2, height}, views}}, views_of_plate);
    plate.add(plate.cells_between({kTip}, 2.0));
    return plate;
}

TEST(Needles, AreTakenBackAndNothingElse)
{
    Plate plate = spike(2);
    EXPECT_NE(plate.labels, plate.bare);
    EXPECT_EQ(plate.take_back(), 1);
    EXPECT_EQ(plate.labels, plate.bare);
    EXPECT_EQ(plate.take_back(), 0);
}

TEST(Needles, StayWhereFourViewsSawTheirTips)
{
    EXPECT_EQ(spike(3).take_back(), 1);
    Plate plate = spike(4);
    const Labels before = plate.labels;
    EXPECT_EQ(plate.take_back(), 0);
    EXPECT_EQ(plate.labels, before);
}

TEST(Needles, StayWhereHalfAsManyViewsSawTheirTipsAsOtherPoints)
{
    EXPECT_EQ(spike(9, 20).take_back(), 1);
    EXPECT_EQ(spike(10, 20).take_back(), 0);
    EXPECT_EQ(spike(10, 21).take_back(), 1);
}

TEST(Needles, StandOutByAMultipleOfTheEdgesAtTheirFeet)
{
    // The edges of the plate are 1 to 1.5 long.
    EXPECT_EQ(spike(2).take_back({.needle_edge = 3.9}), 1);
    EXPECT_EQ(spike(2).take_back({.needle_edge = 6.3}), 0);
    EXPECT_EQ(spike(2, 5, 3.5).take_back(), 0);
    EXPECT_EQ(spike(2, 5, 3.5).take_back({.needle_edge = 2.3}), 1);
}

TEST(Needles, StayWhereNotAsked)
{
    Plate plate = spike(2);
    const Labels before = plate.labels;
    EXPECT_EQ(plate.take_back({.needle_edge = 0.0}), 0);
    EXPECT_EQ(plate.labels, before);
}

TEST(Needles, AreThin)
{
    // A cone on 3 x 3 of the plate: from 2.8 above it fills 0.90, less than a twelfth of all
    // around, which is 1.05; from 2.3 above 1.21.
    for (const auto& [height, expected] : {std::pair(2.8, 1), std::pair(2.3, 0)}) {
        Plate plate({{{0.0, 0.0, height}, 2}});
        const auto cone = plate.cells_between({kTip}, 2.3);
        EXPECT_EQ(cone.size(), 18U);
        for (const Index cell : cone) {
            plate.labels[cell] = Label::inside;
        }
        EXPECT_EQ(plate.take_back({.needle_edge = 1.5}), expected) << height;
    }
}

TEST(Needles, AreTakenBackTipByTip)
{
    // The upper tip hangs on the lower one, which has long edges as long as it is there.
    Plate plate({{{0.1, 0.2, 6}, 2}, {{0.3, 0.1, 100}, 2}});
    plate.add(plate.cells_between({kTip}, 2.0));
    plate.add(plate.cells_between({kTip, kTip + 1}, 10.0));
    EXPECT_EQ(plate.take_back(), 2);
    EXPECT_EQ(plate.labels, plate.bare);
}

TEST(Needles, StandOutByAllOfTheirEdges)
{
    // The same, but many views saw the upper tip, where all edges are long.
    Plate plate({{{0.1, 0.2, 6}, 2}, {{0.3, 0.1, 100}, 5}});
    plate.add(plate.cells_between({kTip}, 2.0));
    plate.add(plate.cells_between({kTip, kTip + 1}, 10.0));
    EXPECT_EQ(plate.take_back(), 0);
}

TEST(Needles, AreNotPits)
{
    // All is solid but a thin cell that leads down to a point below the plate.
    Plate plate({{{0.1, 0.2, -6.2}, 2}});
    const auto pits = plate.cells_between({kTip}, 2.0);
    ASSERT_FALSE(pits.empty());
    plate.labels[pits[0]] = Label::outside;
    const Labels before = plate.labels;
    EXPECT_EQ(plate.take_back(), 0);
    EXPECT_EQ(plate.labels, before);
}

TEST(Needles, AreSoughtAgainNearThoseTakenBack)
{
    // Where one is gone, the edges at the feet of another may have become shorter.
    constexpr NeedleOptions kMany = {.needle_edge = 1.1};
    for (std::uint32_t seed = 93; seed < 99; ++seed) {
        const Scene scene = bumpy_sphere(3000, seed); // with outliers
        const TetMesh mesh = triangulate(scene);
        std::mt19937_64 random(94);
        Labelling labelling(mesh, labels_where(mesh, [&](Index cell) {
                                return (middle(mesh, cell).norm() < 1.0) != (pick(random, 10) < 1);
                            }));
        EXPECT_GT(take_back_needles(scene, kMany, labelling), 0);
        EXPECT_EQ(take_back_needles(scene, kMany, labelling), 0);
    }
}

TEST(Needles, AreTheSameFromOneThreadAndTwo)
{
    const Scene scene = bumpy_sphere(3000, 91); // with outliers
    const TetMesh mesh = triangulate(scene);
    const auto by = [&](int threads) {
        std::mt19937_64 random(92);
        Labelling labelling(mesh, labels_where(mesh, [&](Index cell) {
                                return (middle(mesh, cell).norm() < 1.0) != (pick(random, 100) < 5);
                            }));
        const auto count = testing::with_threads(
            threads, [&] { return take_back_needles(scene, {.needle_edge = 2.0}, labelling); });
        EXPECT_GT(count, 0);
        return std::pair(labelling.labels(), count);
    };
    EXPECT_EQ(by(1), by(2));
}

} // namespace
} // namespace vcarve
