#include "run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::bench {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A run of 100 points on one thread with a peak of 40 MB over 10 MB that were there before.
SampleResult sample(double predicted_mb)
{
    const Json stage = {{"name", "filter"},
                        {"seconds", 0.25},
                        {"cpu_seconds", 0.25},
                        {"peak_bytes", 30e6},
                        {"predicted_bytes", 48e6}};
    const Json write = {
        {"name", "write"}, {"seconds", 0.1}, {"cpu_seconds", 0.1}, {"peak_bytes", 20e6}};
    SampleResult result;
    result.sizes = {
        {"model", "surface"}, {"points", 100}, {"triangulated", 90}, {"sights", 300}, {"views", 4}};
    result.sequential = {{"seconds", 0.5}, {"cpu_seconds", 0.5}, {"peak_bytes", 20e6}};
    result.runs[1] = {{"seconds", 1.0},
                      {"cpu_seconds", 1.0},
                      {"peak_bytes", 40e6},
                      {"base_bytes", 10e6},
                      {"predicted_bytes", 1e6 * predicted_mb},
                      {"stages", {stage, write}}};
    return result;
}

TEST(RunReport, HoldsPredictedToMeasuredMemory)
{
    const std::string text = report(sample(60.0));
    EXPECT_THAT(text, HasSubstr("| **whole run** | 1 | 1.000 | 1.000 | 40.0 | 400000 | 1.20 | "));
    EXPECT_THAT(text, HasSubstr("| filter | 1 | 0.250 | 0.250 | 30.0 | 300000 | 1.20 | 0.50 |"));
    EXPECT_THAT(text, HasSubstr("| write | 1 | 0.100 | 0.100 | 20.0 | 200000 | - | 0.20 |"));
    EXPECT_THAT(text, HasSubstr("predicted peak of the process 60 MB, 1.20 x what was measured\n"));
}

TEST(RunReport, WarnsOfMemoryThatWasNotForetold)
{
    for (const double predicted_mb : {50.1, 69.9}) {
        EXPECT_THAT(report(sample(predicted_mb)), Not(HasSubstr("WARNING")));
    }
    for (const double predicted_mb : {49.9, 70.1}) {
        EXPECT_THAT(report(sample(predicted_mb)),
                    HasSubstr(" (**WARNING**: not within 1 to 1.4)\n"));
    }
}

} // namespace
} // namespace vcarve::bench
