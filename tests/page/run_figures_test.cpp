#include "page/run_figures.h"
#include "support/scenes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <numeric>

namespace vcarve::run_figures_test {
namespace {

/// Nine right triangles with legs of 1, and one with legs of 40 and 1.
TriMesh triangles()
{
    TriMesh mesh;
    for (std::uint32_t i = 0; i < 10; ++i) {
        const double x = 3.0 * i;
        const double length = i == 9 ? 40.0 : 1.0;
        mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + length, 0, 0}, {x, 1, 0}});
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

Scene two_points()
{
    Scene scene = make_scene({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}},
                             {{{0, 0, 0}, {0, 1, 2}}, {{1, 0, 0}, {0, 1}}, {{0, 1, 0}, {1, 2}}});
    scene.errors_px = {0.25, -1.0, 0.75};
    return scene;
}

TEST(SurfaceFigures, MeasureAreasAndPoints)
{
    const std::vector<std::int32_t> supports = {0, 0, 1, 2, 3, 1, 1, 1, 1, 1};
    const SurfaceFigures figures = surface_figures(triangles(), supports, two_points());
    EXPECT_EQ(figures.faces, 10);
    EXPECT_EQ(figures.unsupported_faces, 2);
    EXPECT_DOUBLE_EQ(figures.unsupported_area, 1.0 / 24.5);
    EXPECT_DOUBLE_EQ(figures.long_area, 20.0 / 24.5);
    EXPECT_EQ(figures.edge_lengths.values, 30);
    EXPECT_EQ(figures.edge_lengths.median, 1.0);
    EXPECT_EQ(figures.points, 3);
    EXPECT_EQ(figures.track_lengths.bounds, (std::vector<double>{2, 3, 4}));
    EXPECT_EQ(figures.track_lengths.counts, (std::vector<std::int64_t>{2, 1}));
    EXPECT_EQ(figures.errors_px.values, 2);
    EXPECT_EQ(figures.errors_px.median, 0.75);
}

TEST(SurfaceFigures, CountOnlyMeasuredPoints)
{
    Scene scene = two_points();
    scene.kinds = {PointKind::measured, PointKind::measured, PointKind::border};
    const SurfaceFigures figures =
        surface_figures(triangles(), std::vector<std::int32_t>(10, 1), scene);
    EXPECT_EQ(figures.points, 2);
    EXPECT_EQ(figures.track_lengths.counts, (std::vector<std::int64_t>{1, 1}));
    EXPECT_EQ(figures.errors_px.values, 1);
    EXPECT_EQ(figures.errors_px.median, 0.25);
}

TEST(SurfaceFigures, AreEmptyForAnEmptyMesh)
{
    const SurfaceFigures figures = surface_figures({}, {}, {});
    EXPECT_EQ(figures.unsupported_area, 0.0);
    const auto json = figures_json(figures);
    EXPECT_TRUE(json["histograms"]["edge_length"].is_null());
    EXPECT_TRUE(json["histograms"]["reprojection_error"].is_null());
}

using Counts = std::vector<std::int64_t>;
using Bounds = std::vector<double>;

TEST(HistogramOfCounts, CountsEachInteger)
{
    const Histogram histogram = histogram_of_counts({2, 3, 2, 5, 2}, 10);
    EXPECT_EQ(histogram.bounds, (Bounds{2, 3, 4, 5, 6}));
    EXPECT_EQ(histogram.counts, (Counts{3, 1, 0, 1}));
    EXPECT_EQ(histogram.beyond, 0);
    EXPECT_EQ(histogram.values, 5);
    EXPECT_EQ(histogram.median, 2.0);
    EXPECT_EQ(histogram.largest, 5.0);
}

TEST(HistogramOfCounts, CountsALongTailAsBeyond)
{
    const Histogram histogram = histogram_of_counts({2, 3, 4, 99, 1000}, 3);
    EXPECT_EQ(histogram.bounds, (Bounds{2, 3, 4, 5}));
    EXPECT_EQ(histogram.counts, (Counts{1, 1, 1}));
    EXPECT_EQ(histogram.beyond, 2);
    EXPECT_EQ(histogram.largest, 1000.0);
}

TEST(HistogramOfLengths, HasRoundBounds)
{
    const Histogram histogram = histogram_of_lengths({0.0, 0.1, 0.9, 1.0, 1.9, 3.7}, 4);
    EXPECT_EQ(histogram.bounds, (Bounds{0, 1, 2, 3, 4}));
    EXPECT_EQ(histogram.counts, (Counts{3, 2, 0, 1}));
    EXPECT_EQ(histogram.beyond, 0);
}

TEST(HistogramOfLengths, CountsOutliersAsBeyond)
{
    std::vector<double> lengths(1000, 1.0);
    lengths[7] = 1e6;
    const Histogram histogram = histogram_of_lengths(lengths, 10);
    EXPECT_EQ(histogram.beyond, 1);
    EXPECT_EQ(histogram.largest, 1e6);
    EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), histogram.beyond),
              1000);
    EXPECT_LT(histogram.bounds.back(), 2.0);
}

TEST(HistogramOfLengths, AcceptsZerosAndNoValues)
{
    EXPECT_EQ(histogram_of_lengths({0.0, 0.0}, 10).counts, (Counts{2}));
    EXPECT_EQ(histogram_of_lengths({}, 10).values, 0);
    EXPECT_TRUE(histogram_of_counts({}, 10).bounds.empty());
}

} // namespace
} // namespace vcarve::run_figures_test
