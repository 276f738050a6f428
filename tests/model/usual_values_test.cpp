#include "model/usual_values.h"

#include <gtest/gtest.h>

namespace vcarve::usual_values_test {
namespace {

TEST(UsualValue, IsMeasuredOnceUnlessNothingIsShared)
{
    int measured = 0;
    const auto measure = [&] { return static_cast<double>(++measured); };
    EXPECT_EQ(usual_value(nullptr, &UsualValues::bend, measure), 1.0);
    EXPECT_EQ(usual_value(nullptr, &UsualValues::bend, measure), 2.0);
    UsualValues values;
    EXPECT_EQ(usual_value(&values, &UsualValues::bend, measure), 3.0);
    EXPECT_EQ(usual_value(&values, &UsualValues::bend, measure), 3.0);
    EXPECT_EQ(values.bend, 3.0);
    EXPECT_EQ(values.radius, std::nullopt);
}

TEST(UsualValue, ListsAllFields)
{
    EXPECT_EQ(std::size(kUsualValues) * sizeof(std::optional<double>), sizeof(UsualValues));
}

} // namespace
} // namespace vcarve::usual_values_test
