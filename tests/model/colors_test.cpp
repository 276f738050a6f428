#include "model/colors.h"

#include <gtest/gtest.h>

namespace vcarve::colors_test {
namespace {

TEST(RoundedColor, ClampsToBytes)
{
    const Eigen::Array3f gain(2.0F, 2.0F, 0.5F);
    EXPECT_EQ(rounded_color(channels_of({100, 200, 3}) * gain), (Color{200, 255, 2}));
    EXPECT_EQ(rounded_color(Eigen::Array3d(-3.0, 0.4, 254.6)), (Color{0, 0, 255}));
}

} // namespace
} // namespace vcarve::colors_test
