#include "io/input/unknown_values.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vcarve::unknown_values_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene three_points()
{
    Scene scene = make_scene({{0, 0, 9}, {3, 0, 9}},
                             {{{1, 0, 0}, {0, 1}}, {{2, 0, 0}, {0, 1}}, {{0, 1, 0}, {0, 1}}});
    scene.colors = {{7, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    scene.errors_px = {0.0, 0.3, 0.0};
    return scene;
}

TEST(ForgetUnknownValues, LeavesWhatTellsSomething)
{
    Scene scene = three_points();
    EXPECT_THAT(forget_unknown_values(scene), IsEmpty());
    EXPECT_THAT(scene.errors_px, ElementsAre(0.0, 0.3, 0.0));
}

TEST(ForgetUnknownValues, TakesErrorsThatAreZeroEverywhereForUnknown)
{
    Scene scene = three_points();
    scene.errors_px.assign(3, 0.0);
    EXPECT_THAT(forget_unknown_values(scene), ElementsAre(HasSubstr("error of every point is 0")));
    EXPECT_THAT(scene.errors_px, Each(-1.0));
}

TEST(ForgetUnknownValues, TellsOfPointsWithoutColors)
{
    Scene scene = three_points();
    scene.colors.assign(3, {0, 0, 0});
    EXPECT_THAT(forget_unknown_values(scene), ElementsAre(HasSubstr("the points have no colours")));
}

TEST(ForgetUnknownValues, SaysNothingOfNoPoints)
{
    Scene scene;
    EXPECT_THAT(forget_unknown_values(scene), IsEmpty());
}

} // namespace
} // namespace vcarve::unknown_values_test
