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

/// The counts of a stage, or none.
Json counts_of(const Json& record, const char* name)
{
    for (const Json& stage : record.value("stages", Json::array())) {
        if (stage["name"] == name) return stage["counts"];
    }
    return Json::object();
}

/// Why points are dropped: what the stage calls it, and what is said of it.
struct Reason {
    const char* count;
    const char* option; ///< that sets the limit; empty where none does
    const char* means;
};

constexpr Reason kReasons[] = {
    {"non-finite", "", "have no finite coordinates"},
    {"duplicate", "", "lie where another point lies and became one with it"},
    {"few views", "min-views", "too few views saw them"},
    {"high error", "max-error", "they were measured too badly"},
    {"low angle", "min-angle", "their sights meet at too small an angle to tell how far they are"},
    {"stray", "stray-spacing", "two views saw them, and no others stand near"},
};

void warn_of_dropped_points(std::vector<std::string>& warnings, const Json& record)
{
    constexpr double kMany = 0.2;
    const Json counts = counts_of(record, "filter");
    const double all = counts.value("of points", 0.0);
    for (const Reason& reason : kReasons) {
        const double dropped = counts.value(reason.count, 0.0);
        if (all == 0.0 || dropped / all < kMany) continue;
        const std::string share = percent(dropped / all);
        if (reason.option[0] == '\0') {
            warnings.push_back(fmt::format("{} of the points {}.", share, reason.means));
        } else {
            warnings.push_back(fmt::format("{} of the points fell to --{}: {}.", share,
                                           reason.option, reason.means));
        }
    }
}

void warn_of_weak_points(std::vector<std::string>& warnings, const SurfaceFigures& figures)
{
    constexpr double kLargeErrorPx = 1.5;
    if (figures.track_lengths.values > 0 && figures.track_lengths.median <= 2.0) {
        warnings.emplace_back("At least half of the points were seen by no more than two views, so "
                              "that a wrong match is hard to tell from a point.");
    }
    if (figures.errors_px.values > 0 && figures.errors_px.median > kLargeErrorPx) {
        warnings.push_back(
            fmt::format("Half of the points lie {:.1f} px or more from where the images show them; "
                        "the cameras may not be calibrated well.",
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
            fmt::format("{} of the surface has a corner that no camera saw from its front; colour "
                        "by support to see where.",
                        percent(figures.unsupported_area)));
    }
    if (figures.long_area >= kMuchLong) {
        warnings.push_back(fmt::format(
            "{} of the surface is in faces with an edge over {:.0f} times the median edge: they "
            "span places where points are few.",
            percent(figures.long_area), SurfaceFigures::kLong));
    }
}

void warn_of_orientation(std::vector<std::string>& warnings, const Json& record)
{
    constexpr double kFew = 0.9;
    const Json counts = counts_of(record, "orient");
    const double all = counts.value("of sights on the outside", 0.0);
    if (all == 0.0) return;
    const double outside = counts.value("sights on the outside", 0.0) / all;
    if (outside < kFew) {
        warnings.push_back(
            fmt::format("{} of the sights meet the surface from behind.", percent(1.0 - outside)));
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
