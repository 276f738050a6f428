#include "page/run_figures.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vcarve::warnings_test {
namespace {

using Json = nlohmann::ordered_json;
using Sentences = std::vector<std::string>;

/// Figures that cause no warning.
SurfaceFigures good_figures()
{
    SurfaceFigures figures;
    figures.faces = 200;
    figures.unsupported_area = 0.0499;
    figures.long_area = 0.7499;
    figures.track_lengths.values = 100;
    figures.track_lengths.median = 3.0;
    figures.errors_px.values = 100;
    figures.errors_px.median = 1.5;
    return figures;
}

Json record_with(const Json& filter, const Json& orient)
{
    return {{"stages",
             {{{"name", "filter"}, {"counts", filter}}, {{"name", "orient"}, {"counts", orient}}}}};
}

Json filtered(const char* reason, int dropped)
{
    Json counts = {{"points", 1000 - dropped}, {"of points", 1000}};
    counts[reason] = dropped;
    return record_with(counts, Json::object());
}

Sentences about(const SurfaceFigures& figures)
{
    return warnings_of(figures, Json::object());
}

TEST(Warnings, AreEmptyForGoodFigures)
{
    const Json record = record_with(
        {{"points", 5}, {"of points", 10}, {"low angle", 1}, {"few views", 1}, {"duplicate", 1}},
        {{"rays on the outside", 90}, {"of rays on the outside", 100}});
    EXPECT_EQ(warnings_of(good_figures(), record), Sentences());
    EXPECT_EQ(about(good_figures()), Sentences());
}

TEST(Warnings, NameTheOptionThatDroppedManyPoints)
{
    EXPECT_EQ(warnings_of(good_figures(), filtered("low angle", 334)),
              Sentences{"33 % of the points were dropped by --min-angle: the angle between their "
                        "rays is too small to fix their depth."});
    EXPECT_EQ(warnings_of(good_figures(), filtered("few views", 200)),
              Sentences{"20 % of the points were dropped by --min-views: too few views see them."});
    EXPECT_EQ(warnings_of(good_figures(), filtered("high error", 500)),
              Sentences{"50 % of the points were dropped by --max-error: their reprojection errors "
                        "are too large."});
    EXPECT_EQ(warnings_of(good_figures(), filtered("duplicate", 201)),
              Sentences{"20 % of the points coincide with another point and were merged with it."});
    EXPECT_EQ(warnings_of(good_figures(), filtered("non-finite", 1000)),
              Sentences{"100 % of the points have non-finite coordinates."});
}

TEST(Warnings, IgnoreFewDroppedPoints)
{
    for (const char* reason :
         {"low angle", "few views", "high error", "duplicate", "non-finite", "stray"}) {
        EXPECT_EQ(warnings_of(good_figures(), filtered(reason, 199)), Sentences()) << reason;
    }
}

TEST(Warnings, ReportUnsupportedArea)
{
    SurfaceFigures figures = good_figures();
    figures.unsupported_area = 0.12;
    EXPECT_EQ(
        about(figures),
        Sentences{"12 % of the surface is unsupported: these faces have a corner that no view "
                  "sees from the front. Color by support to see them."});
}

TEST(Warnings, ReportLongFaces)
{
    SurfaceFigures figures = good_figures();
    figures.long_area = 0.75;
    EXPECT_EQ(about(figures),
              Sentences{"75 % of the surface is in faces with an edge above 10 times the median "
                        "edge: they span regions with few points."});
}

TEST(Warnings, ReportWeakPoints)
{
    SurfaceFigures figures = good_figures();
    figures.track_lengths.median = 2.0;
    EXPECT_EQ(
        about(figures),
        Sentences{"At least half of the points have no more than two views, so wrong matches are "
                  "hard to detect."});
    figures = good_figures();
    figures.errors_px.median = 1.72;
    EXPECT_EQ(
        about(figures),
        Sentences{"Half of the points have a reprojection error of 1.7 px or more; the calibration "
                  "of the cameras may be inaccurate."});
}

TEST(Warnings, IgnoreUnknownFigures)
{
    SurfaceFigures figures = good_figures();
    figures.track_lengths = {};
    figures.errors_px = {};
    EXPECT_EQ(about(figures), Sentences());
}

TEST(Warnings, ReportATinySurface)
{
    SurfaceFigures figures = good_figures();
    figures.faces = 199;
    EXPECT_EQ(about(figures), Sentences{"The surface has only 199 faces."});
}

TEST(Warnings, ReportRaysFromBehind)
{
    const Json record =
        record_with(Json::object(), {{"rays on the outside", 89}, {"of rays on the outside", 100}});
    EXPECT_EQ(warnings_of(good_figures(), record),
              Sentences{"11 % of the rays hit the surface from behind."});
}

} // namespace
} // namespace vcarve::warnings_test
