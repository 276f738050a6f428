#include "base/stage_counts.h"
#include "page/run_figures.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace vcarve {

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share)
{
    const long long rounded = std::llround(100.0 * share);
    return rounded == 0 ? "less than 1 %" : fmt::format("{} %", rounded);
}

/// The counts of a stage, or an empty object.
Json counts_of(const Json& record, const char* name)
{
    for (const Json& stage : record.value("stages", Json::array())) {
        if (stage["name"] == name) return stage["counts"];
    }
    return Json::object();
}

/// The key of the total of a count.
std::string key_of_total(const CountKind& kind)
{
    return "of " + std::string(kind.key);
}

/// A reason for dropped points, and the text of its warning.
struct Reason {
    const CountKind& count;
    const char* option; ///< option that sets the limit; empty: none
    const char* means;
};

constexpr Reason kReasons[] = {
    {counts::kFilter.non_finite, "", "have non-finite coordinates"},
    {counts::kFilter.duplicate, "", "coincide with another point and were merged with it"},
    {counts::kFilter.few_views, "min-views", "too few views see them"},
    {counts::kFilter.high_error, "max-error", "their reprojection errors are too large"},
    {counts::kFilter.low_angle, "min-angle",
     "the angle between their rays is too small to fix their depth"},
    {counts::kFilter.stray, "stray-spacing",
     "at most two views see them, and no other points are near"},
};

void warn_of_dropped_points(std::vector<std::string>& warnings, const Json& record)
{
    constexpr double kMany = 0.2;
    const Json counts = counts_of(record, "filter");
    const double all = counts.value(key_of_total(counts::kFilter.points), 0.0);
    for (const Reason& reason : kReasons) {
        const double dropped = counts.value(reason.count.key, 0.0);
        if (all == 0.0 || dropped / all < kMany) continue;
        const std::string share = percent(dropped / all);
        if (reason.option[0] == '\0') {
            warnings.push_back(fmt::format("{} of the points {}.", share, reason.means));
        } else {
            warnings.push_back(fmt::format("{} of the points were dropped by --{}: {}.", share,
                                           reason.option, reason.means));
        }
    }
}

void warn_of_weak_points(std::vector<std::string>& warnings, const SurfaceFigures& figures)
{
    constexpr double kLargeErrorPx = 1.5;
    if (figures.track_lengths.values > 0 && figures.track_lengths.median <= 2.0) {
        warnings.emplace_back("At least half of the points have no more than two views, so wrong "
                              "matches are hard to detect.");
    }
    if (figures.errors_px.values > 0 && figures.errors_px.median > kLargeErrorPx) {
        warnings.push_back(
            fmt::format("Half of the points have a reprojection error of {:.1f} px or more; the "
                        "calibration of the cameras may be inaccurate.",
                        figures.errors_px.median));
    }
}

void warn_of_surface(std::vector<std::string>& warnings, const SurfaceFigures& figures)
{
    constexpr double kMuchUnsupported = 0.05;
    constexpr double kMuchLong = 0.75;
    constexpr std::int64_t kFewFaces = 200;
    if (figures.faces < kFewFaces) {
        warnings.push_back(fmt::format("The surface has only {} faces.", figures.faces));
    }
    if (figures.unsupported_area >= kMuchUnsupported) {
        warnings.push_back(
            fmt::format("{} of the surface is unsupported: these faces have a corner that no view "
                        "sees from the front. Color by support to see them.",
                        percent(figures.unsupported_area)));
    }
    if (figures.long_area >= kMuchLong) {
        warnings.push_back(fmt::format(
            "{} of the surface is in faces with an edge above {:.0f} times the median edge: they "
            "span regions with few points.",
            percent(figures.long_area), SurfaceFigures::kLong));
    }
}

void warn_of_orientation(std::vector<std::string>& warnings, const Json& record)
{
    constexpr double kFew = 0.9;
    const Json counts = counts_of(record, "orient");
    const double all = counts.value(key_of_total(counts::kMesh.outside), 0.0);
    if (all == 0.0) return;
    const double outside = counts.value(counts::kMesh.outside.key, 0.0) / all;
    if (outside < kFew) {
        warnings.push_back(
            fmt::format("{} of the rays hit the surface from behind.", percent(1.0 - outside)));
    }
}

} // namespace

std::vector<std::string> warnings_of(const SurfaceFigures& figures, const Json& record)
{
    std::vector<std::string> warnings;
    warn_of_dropped_points(warnings, record);
    warn_of_weak_points(warnings, figures);
    warn_of_surface(warnings, figures);
    warn_of_orientation(warnings, record);
    return warnings;
}

} // namespace vcarve
