#include "steps/4_visibility/sight_weights.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve::sight_weights_test {
namespace {

/// Points of two, three and four views; three is the median.
Scene points_of_some_views()
{
    return make_scene({{0, 0, 9}, {1, 0, 9}, {2, 0, 9}, {3, 0, 9}},
                      {{{0, 0, 0}, {0, 1}}, {{1, 0, 0}, {0, 1, 2}}, {{2, 0, 0}, {0, 1, 2, 3}}});
}

TEST(SightWeights, CountAMedianPointAsOneAndOthersByTheirViews)
{
    const Scene scene = points_of_some_views();
    TraceOptions options;
    const SightWeights weights(scene, measure_scales({}, scene), options);
    const auto by_views = [&](double views) {
        return 1.0 - std::exp(-0.5 * views * views / (options.views_sigma * options.views_sigma));
    };
    EXPECT_EQ(weights.full_weight(1), SightWeights::kUnit);
    EXPECT_EQ(weights.full_weight(0), std::lround(SightWeights::kUnit * by_views(2) / by_views(3)));
    EXPECT_EQ(weights.full_weight(2), std::lround(SightWeights::kUnit * by_views(4) / by_views(3)));
    EXPECT_EQ(weights.full_weight(1, 0.25), SightWeights::kUnit / 4);
}

TEST(SightWeights, CountErrorsBeyondTheMedianOnly)
{
    Scene scene = points_of_some_views();
    scene.errors_px = {0.1, 3.0, 1.0};
    TraceOptions options;
    options.views_sigma = 0.0;
    options.error_sigma = 2.0;
    const SightWeights weights(scene, measure_scales({}, scene), options);
    EXPECT_EQ(weights.full_weight(0), SightWeights::kUnit);
    EXPECT_EQ(weights.full_weight(2), SightWeights::kUnit);
    EXPECT_EQ(weights.full_weight(1),
              std::lround(SightWeights::kUnit * std::exp(-0.5 * 8.0 / 4.0)));
}

TEST(SightWeights, CountAMeasuredRangeAsTwoSightsOfAMedianPointWhateverItsViews)
{
    Scene scene = points_of_some_views();
    scene.cameras.push_back(scene.cameras.front());
    scene.cameras.back().measures_range = true;
    scene.views[3].camera = static_cast<std::uint32_t>(scene.cameras.size() - 1);
    const TraceOptions options;
    const SightWeights weights(scene, measure_scales({}, scene), options);
    EXPECT_EQ(weights.full_weight(2), 2 * SightWeights::kUnit); // of four views
    EXPECT_LT(weights.full_weight(0), SightWeights::kUnit);     // of photographs
}

TEST(SightWeights, KnowNothingOfAnEmptyScene)
{
    const Scene scene;
    const TraceOptions options;
    EXPECT_NO_THROW(SightWeights(scene, measure_scales({}, scene), options));
}

} // namespace
} // namespace vcarve::sight_weights_test
