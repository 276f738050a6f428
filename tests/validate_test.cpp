#include "base/validate.h"
#include "support/sample_options.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vcarve {
namespace {

std::string refusal_of(const SampleOptions& options)
{
    try {
        validate(options);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Validate, AcceptsTheDefaults)
{
    EXPECT_EQ(refusal_of({}), "accepted");
}

TEST(Validate, AcceptsTheEndsOfARange)
{
    EXPECT_EQ(refusal_of({.angle_deg = 0.0, .views = 2}), "accepted");
    EXPECT_EQ(refusal_of({.angle_deg = 180.0, .spacing = kUnlimited}), "accepted");
}

TEST(Validate, NamesTheOptionTheRangeAndTheValue)
{
    EXPECT_EQ(refusal_of({.angle_deg = 200.0}),
              "--angle takes a number from 0 to 180 (deg), not 200");
    EXPECT_EQ(refusal_of({.spacing = -0.5}), "--spacing takes a number, 0 or more, not -0.5");
    EXPECT_EQ(refusal_of({.views = 1}),
              "--min-views takes a whole number, 2 or more (views), not 1");
    EXPECT_EQ(refusal_of({.memory = -1}),
              "--memory takes a size in bytes, or with K, M or G as in 8G, not -1");
    EXPECT_EQ(refusal_of({.shape = static_cast<Shape>(3)}),
              "--shape has 2 choices, and 3 is none of them");
    EXPECT_EQ(refusal_of({.place = {.word = 2}}), "--place has 2 choices, and 2 is none of them");
    EXPECT_EQ(refusal_of({.place = {.word = WordOrVector::kNoWord, .vector = {0, 0, -11}}}),
              "--place takes here, there or x,y,z from -10 to 10, not -11");
}

TEST(Validate, RefusesWhatIsNotANumber)
{
    EXPECT_EQ(refusal_of({.spacing = std::nan("")}),
              "--spacing takes a number, 0 or more, not nan");
}

} // namespace
} // namespace vcarve
