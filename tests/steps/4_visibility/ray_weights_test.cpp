#include "steps/1_points/arrange.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/ray_weights.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vcarve::ray_weights_test {
namespace {

/// The lengths of all finite edges, ascending.
std::vector<double> edge_lengths(const TetMesh& mesh)
{
    std::set<std::pair<Index, Index>> edges;
    for (const Cell& cell : mesh.cells) {
        for (const Index a : cell.vertices) {
            for (const Index b : cell.vertices) {
                if (a < b && b != kInfinite) {
                    edges.emplace(a, b);
                }
            }
        }
    }
    std::vector<double> lengths;
    for (const auto& [a, b] : edges) {
        lengths.push_back((mesh.positions[a] - mesh.positions[b]).norm());
    }
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

TEST(ShortEdgeLength, IsTheFirstQuartileOfAllFiniteEdges)
{
    const TetMesh mesh = triangulate(spatial_sort(bumpy_sphere(800, 21)));
    const std::vector<double> lengths = edge_lengths(mesh);
    EXPECT_EQ(short_edge_length(mesh), lengths[lengths.size() / 4]);
}

TEST(ShortEdgeLength, IsNearTheFirstQuartileIfEdgesAreSampled)
{
    const TetMesh mesh = triangulate(spatial_sort(bumpy_sphere(20000, 22)));
    ASSERT_GT(mesh.cells.size(), 100'000U);
    const std::vector<double> lengths = edge_lengths(mesh);
    const double found = short_edge_length(mesh);
    EXPECT_GE(found, lengths[lengths.size() * 24 / 100]);
    EXPECT_LE(found, lengths[lengths.size() * 26 / 100]);
}

TEST(ShortEdgeLength, IsTheEdgeOfARegularTetrahedron)
{
    const Scene scene =
        make_scene({{9, 9, 9}},
                   {{{1, 1, 1}, {0}}, {{1, -1, -1}, {0}}, {{-1, 1, -1}, {0}}, {{-1, -1, 1}, {0}}});
    EXPECT_DOUBLE_EQ(short_edge_length(triangulate(scene)), std::sqrt(8.0));
}

/// Points with two, three and four views; the median is three.
Scene points_of_some_views()
{
    return make_scene({{0, 0, 9}, {1, 0, 9}, {2, 0, 9}, {3, 0, 9}},
                      {{{0, 0, 0}, {0, 1}}, {{1, 0, 0}, {0, 1, 2}}, {{2, 0, 0}, {0, 1, 2, 3}}});
}

TEST(RayWeights, WeightsPointsByTheirViewsRelativeToTheMedian)
{
    const Scene scene = points_of_some_views();
    TraceOptions options;
    const RayWeights weights(scene, measure_scales({}, scene), options);
    const auto by_views = [&](double views) {
        return 1.0 - std::exp(-0.5 * views * views / (options.views_sigma * options.views_sigma));
    };
    EXPECT_EQ(weights.full_weight(1), RayWeights::kUnit);
    EXPECT_EQ(weights.full_weight(0), std::lround(RayWeights::kUnit * by_views(2) / by_views(3)));
    EXPECT_EQ(weights.full_weight(2), std::lround(RayWeights::kUnit * by_views(4) / by_views(3)));
    EXPECT_EQ(weights.full_weight(1, 0.25), RayWeights::kUnit / 4);
}

TEST(RayWeights, ReducesWeightsOnlyForErrorsAboveTheMedian)
{
    Scene scene = points_of_some_views();
    scene.errors_px = {0.1, 3.0, 1.0};
    TraceOptions options;
    options.views_sigma = 0.0;
    options.error_sigma = 2.0;
    const RayWeights weights(scene, measure_scales({}, scene), options);
    EXPECT_EQ(weights.full_weight(0), RayWeights::kUnit);
    EXPECT_EQ(weights.full_weight(2), RayWeights::kUnit);
    EXPECT_EQ(weights.full_weight(1), std::lround(RayWeights::kUnit * std::exp(-0.5 * 8.0 / 4.0)));
}

TEST(RayWeights, WeightsAMeasuredRangeAsTwoRaysForAnyNumberOfViews)
{
    Scene scene = points_of_some_views();
    scene.cameras.push_back(scene.cameras.front());
    scene.cameras.back().measures_range = true;
    scene.views[3].camera = static_cast<std::uint32_t>(scene.cameras.size() - 1);
    const TraceOptions options;
    const RayWeights weights(scene, measure_scales({}, scene), options);
    EXPECT_EQ(weights.full_weight(2), 2 * RayWeights::kUnit); // four views, one a scanner
    EXPECT_LT(weights.full_weight(0), RayWeights::kUnit);     // photographs only
}

TEST(RayWeights, AcceptsAnEmptyScene)
{
    const Scene scene;
    const TraceOptions options;
    EXPECT_NO_THROW(RayWeights(scene, measure_scales({}, scene), options));
}

} // namespace
} // namespace vcarve::ray_weights_test
