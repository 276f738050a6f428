#include "support/sample_options.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace vcarve::option_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> texts(std::string (*text)(const Option&))
{
    SampleOptions options;
    std::vector<std::string> all;
    for (const Option& option : options_of(options)) {
        all.push_back(text(option));
    }
    return all;
}

std::string refusal_of(SampleOptions options)
{
    try {
        check_values(options_of(options));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Option, FormatsItsValueAsTyped)
{
    EXPECT_THAT(texts(value_text),
                ElementsAre("10.5", "2", "3", "no", "round", "3M", "here", "none", "7", "1"));
}

TEST(Option, ShowsARangeIfMoreThanTheSignIsRestricted)
{
    EXPECT_THAT(texts(range_text),
                ElementsAre("max: 180", "", "min: 2", "", "", "", "min: -10, max: 10", "", "", ""));
}

TEST(Option, ShowsAPlaceholderForItsValue)
{
    EXPECT_THAT(texts(placeholder),
                ElementsAre("N", "N", "N", "", "round|flat", "SIZE", "here|there|X,Y,Z",
                            "none|auto|BOX|FILE", "usual|N", "N"));
}

TEST(CheckValues, AcceptsTheDefaults)
{
    EXPECT_EQ(refusal_of({}), "accepted");
}

TEST(CheckValues, AcceptsTheBoundsOfARange)
{
    EXPECT_EQ(refusal_of({.angle_deg = 0.0, .views = 2}), "accepted");
    EXPECT_EQ(refusal_of({.angle_deg = 180.0, .spacing = kUnlimited}), "accepted");
}

TEST(CheckValues, ReportsOptionRangeAndValue)
{
    EXPECT_EQ(refusal_of({.angle_deg = 200.0}),
              "--angle takes a number from 0 to 180 (deg), not 200");
    EXPECT_EQ(refusal_of({.spacing = -0.5}), "--spacing takes a number, 0 or more, not -0.5");
    EXPECT_EQ(refusal_of({.views = 1}),
              "--min-views takes a whole number, 2 or more (views), not 1");
    EXPECT_EQ(refusal_of({.memory = -1}),
              "--memory takes a size in bytes, or with K, M or G as in 8G, not -1");
    EXPECT_EQ(refusal_of({.shape = static_cast<Shape>(3)}),
              "--shape has 2 choices; 3 is not one of them");
    EXPECT_EQ(refusal_of({.place = {.word = 2}}), "--place has 2 choices; 2 is not one of them");
    EXPECT_EQ(refusal_of({.place = {.word = WordOrVector::kNoWord, .vector = {0, 0, -11}}}),
              "--place takes here, there or x,y,z from -10 to 10, not -11");
}

TEST(CheckValues, RejectsEmptyRegions)
{
    const double nan = std::nan("");
    const auto refusal_of_box = [](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
        return refusal_of({.part = {.kind = RegionChoice::Kind::box, .low = low, .high = high}});
    };
    const std::string expected =
        "--part takes a box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and z0 < z1, not ";
    EXPECT_EQ(refusal_of_box({0, 0, 0}, {1, 1, 1}), "accepted");
    EXPECT_EQ(refusal_of_box({0, 0, 0}, {1, 1, 0}), expected + "0,0,0,1,1,0");
    EXPECT_EQ(refusal_of_box({2, 0, 0}, {1.5, 1, 1}), expected + "2,0,0,1.5,1,1");
    EXPECT_EQ(refusal_of_box({0, nan, 0}, {1, 1, 1}), expected + "0,nan,0,1,1,1");
    EXPECT_EQ(refusal_of_box({0, 0, 0}, {1, 1, kUnlimited}), expected + "0,0,0,1,1,inf");
    EXPECT_EQ(refusal_of({.part = {.kind = RegionChoice::Kind::file, .file = ""}}),
              "--part takes none, auto, x0,y0,z0,x1,y1,z1 or a file, not \"\"");
}

TEST(CheckValues, RejectsNaN)
{
    EXPECT_EQ(refusal_of({.spacing = std::nan("")}),
              "--spacing takes a number, 0 or more, not nan");
}

} // namespace
} // namespace vcarve::option_test
