#include "base/control_free.h"

#include <gtest/gtest.h>

namespace vcarve::control_free_test {
namespace {

TEST(ControlFree, LeavesNothingThatATerminalObeys)
{
    EXPECT_EQ(control_free("a\x1b[31mb\tc\nd\x7f"), "a?[31mb?c?d?");
    EXPECT_EQ(control_free("a\xC2\x9B"
                           "31m"),
              "a?31m");
    EXPECT_EQ(control_free("\xC2"), "\xC2");
}

TEST(ControlFree, LeavesTheRestAsItIs)
{
    EXPECT_EQ(control_free(""), "");
    EXPECT_EQ(control_free("Stra\xC3\x9F"
                           "e \xC2\xA0 100 %"),
              "Stra\xC3\x9F"
              "e \xC2\xA0 100 %");
}

} // namespace
} // namespace vcarve::control_free_test
