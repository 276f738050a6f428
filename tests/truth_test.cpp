#include "base/error.h"
#include "compare/truth.h"
#include "support/measured_scenes.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numbers>

namespace vcarve {
namespace {

using testing::few_samples;
using testing::high_centers;
using testing::scene_above_square;
using testing::square;
using testing::strip;

/// Of a share of 20,000 random samples, at most.
constexpr double kFourDeviations = 0.0142;

Yardstick yardstick_of(const TriMesh& truth, const std::vector<Eigen::Vector3d>& centers)
{
    const NamedMesh named{"gt.ply", truth};
    return make_yardstick(scene_above_square(11, centers), &named, few_samples());
}

TruthFigures figures_of(const TriMesh& mesh, const Yardstick& yardstick)
{
    return measure_against_truth(place_mesh({"a.ply", mesh}, yardstick), yardstick);
}

TEST(Truth, AgreesWithItself)
{
    const Yardstick yardstick = yardstick_of(square(), high_centers());
    const TruthFigures figures = figures_of(square(), yardstick);
    for (const Agreement& agreement : figures.agreements) {
        EXPECT_EQ(agreement.precision, 1.0);
        EXPECT_EQ(agreement.recall, 1.0);
        EXPECT_EQ(agreement.f_score, 1.0);
    }
    EXPECT_NEAR(figures.mean_accuracy, 0.0, 1e-15);
    EXPECT_NEAR(figures.mean_completeness, 0.0, 1e-15);
    EXPECT_EQ(figures.blocked, 0.0);
}

TEST(Truth, MeasuresAMoveAlongTheNormal)
{
    const Yardstick yardstick = yardstick_of(square(), high_centers());
    const double height = 0.004 * std::numbers::sqrt2;
    const TruthFigures figures = figures_of(square(height), yardstick);
    EXPECT_EQ(figures.agreements[0].precision, 0.0);
    EXPECT_EQ(figures.agreements[0].recall, 0.0);
    EXPECT_EQ(figures.agreements[0].f_score, 0.0);
    EXPECT_EQ(figures.agreements[1].precision, 1.0);
    EXPECT_EQ(figures.agreements[1].recall, 1.0);
    // The samples do not quite reach the corners, so the diagonal is a little short.
    EXPECT_NEAR(figures.mean_accuracy, 0.004, 4e-5);
    EXPECT_NEAR(figures.mean_completeness, 0.004, 4e-5);
}

TEST(Truth, MeasuresAMoveAlongTheSurface)
{
    const Yardstick yardstick = yardstick_of(square(), high_centers());
    const TruthFigures figures = figures_of(strip(0.2, 1.2, 0.0), yardstick);
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        // Within tolerance of the other lies all but the strip beyond it.
        const double overlap = 0.8 + kTolerances[i] * std::numbers::sqrt2;
        EXPECT_NEAR(figures.agreements[i].precision, overlap, kFourDeviations);
        EXPECT_NEAR(figures.agreements[i].recall, overlap, kFourDeviations);
        EXPECT_NEAR(figures.agreements[i].f_score, overlap, kFourDeviations);
    }
    // 0.2 of the area is on average 0.1 away.
    EXPECT_NEAR(figures.mean_accuracy, 0.02 / std::numbers::sqrt2, 3e-4);
}

TEST(Truth, TellsPrecisionFromRecall)
{
    const Yardstick yardstick = yardstick_of(square(), high_centers());
    const TruthFigures half = figures_of(strip(0.0, 0.5, 0.0), yardstick);
    EXPECT_EQ(half.agreements[2].precision, 1.0);
    EXPECT_NEAR(half.agreements[2].recall, 0.5 + 0.01 * std::numbers::sqrt2, kFourDeviations);
    const double recall = half.agreements[2].recall;
    EXPECT_DOUBLE_EQ(half.agreements[2].f_score, 2.0 * recall / (1.0 + recall));
}

TEST(Truth, CountsLinesTheMeshBlocks)
{
    // Views so high that their lines are upright; a screen hangs over a quarter of the square.
    std::vector<Eigen::Vector3d> centers = high_centers();
    for (Eigen::Vector3d& center : centers) {
        center.z() = 1e6;
    }
    const Yardstick yardstick = yardstick_of(square(), centers);
    const TriMesh screened = testing::together(square(), strip(0.0, 0.25, 0.5));
    EXPECT_NEAR(figures_of(screened, yardstick).blocked, 0.25, kFourDeviations);
    // Nearer than 1 % of the diagonal it is taken for the surface itself.
    const TriMesh skin = testing::together(square(), strip(0.0, 0.25, 0.01));
    EXPECT_EQ(figures_of(skin, yardstick).blocked, 0.0);
}

TEST(Truth, CountsOnlyWhatThreeViewsSee)
{
    const TriMesh stacked = testing::together(square(), square(-0.5));
    const Yardstick yardstick = yardstick_of(stacked, high_centers());
    // Every line from the lower square to a view passes the upper one.
    EXPECT_NEAR(yardstick.truth->seen_share, 0.5, 1e-4);
    EXPECT_GE(yardstick.truth->samples.size(), 20000U);
    for (const Eigen::Vector3d& sample : yardstick.truth->samples) {
        ASSERT_EQ(sample.z(), 0.0);
    }
}

TEST(Truth, IsSeenFromEitherSide)
{
    const Yardstick yardstick = yardstick_of(testing::flipped(square()), high_centers());
    EXPECT_EQ(yardstick.truth->seen_share, 1.0);
}

TEST(Truth, CountsNoGrazingViews)
{
    // Two views above, others 100 to 200 away at a height of 1: 89 degrees from the normal and
    // more.
    std::vector<Eigen::Vector3d> centers = {
        {0.2, 0.2, 10}, {0.8, 0.2, 10}, {100, 0, 1}, {0, 200, 1}};
    EXPECT_THAT(
        [&] { yardstick_of(square(), centers); },
        ::testing::ThrowsMessage<InputError>(
            "gt.ply: less than a thousandth of its area is seen by at least 3 of the model's 4 "
            "views, so it cannot tell how good a mesh is"));
    centers[2] = {0.5, 0.5, 1.0};
    EXPECT_EQ(yardstick_of(square(), centers).truth->seen_share, 1.0);
}

TEST(Truth, PicksASeeingViewAtRandom)
{
    const Yardstick yardstick = yardstick_of(square(), high_centers());
    const auto samples = static_cast<double>(yardstick.truth->samples.size());
    for (const std::uint32_t view : {0U, 1U, 2U, 3U}) {
        const auto count = std::ranges::count(yardstick.truth->views, view);
        EXPECT_NEAR(static_cast<double>(count) / samples, 0.25, kFourDeviations);
    }
}

TEST(Truth, FiguresAreTheSameForAnyNumberOfThreads)
{
    const TriMesh mesh = testing::random_soup(100, 5);
    const TruthFigures many = figures_of(mesh, yardstick_of(square(), high_centers()));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const TruthFigures alone = figures_of(mesh, yardstick_of(square(), high_centers()));
    EXPECT_EQ(alone.agreements[2].f_score, many.agreements[2].f_score);
    EXPECT_EQ(alone.mean_accuracy, many.mean_accuracy);
    EXPECT_EQ(alone.mean_completeness, many.mean_completeness);
    EXPECT_EQ(alone.blocked, many.blocked);
}

} // namespace
} // namespace vcarve
