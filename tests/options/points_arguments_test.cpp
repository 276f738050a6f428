#include "options/points_arguments.h"

#include <gtest/gtest.h>

namespace vcarve::points_arguments_test {
namespace {

TEST(PointsArguments, NameEveryFieldOfThePointsOptions)
{
    PointsArguments arguments;
    std::string names;
    for (const Option& option : options_of(arguments)) {
        names += option.info.name + " ";
    }
    EXPECT_EQ(names, "points visibility sights scanner ");
}

TEST(PointsArguments, HaveAScannerOnlyWherePlaceIsTyped)
{
    PointsArguments arguments;
    const Option scanner = options_of(arguments).back();
    set_value(scanner, "1,2,3");
    EXPECT_EQ(arguments.all_points().scanner, Eigen::Vector3d(1.0, 2.0, 3.0));
    set_value(scanner, "file");
    EXPECT_FALSE(arguments.all_points().scanner.has_value());
}

} // namespace
} // namespace vcarve::points_arguments_test
