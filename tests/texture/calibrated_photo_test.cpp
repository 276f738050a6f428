#include "support/photographed_wall.h"
#include "texture/calibrated_photo.h"

#include <gtest/gtest.h>

namespace vcarve::calibrated_photo_test {
namespace {

TEST(CalibratedPhoto, ShowsAPlaceAtThePixelOfItsCamera)
{
    const CalibratedPhoto photo = photo_from({0, 0, -2});
    const auto pixel = pixel_of(photo, {0.5, -0.25, 0.0});
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(pixel->isApprox(Eigen::Vector2d(105.0, 47.5), 1e-12)) << pixel->transpose();
}

TEST(CalibratedPhoto, ThatWasMadeSmallerShowsItAsMuchNearerToItsCorner)
{
    CalibratedPhoto photo = photo_from({0, 0, -2});
    photo.size = {80, 40};
    photo.scale = {0.5, 1.0 / 3.0};
    const auto pixel = pixel_of(photo, {0.5, -0.25, 0.0});
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(pixel->isApprox(Eigen::Vector2d(52.5, 47.5 / 3.0), 1e-12)) << pixel->transpose();
}

TEST(CalibratedPhoto, ShowsNothingBeyondItsEdgesAndBehindIt)
{
    const CalibratedPhoto photo = photo_from({0, 0, -2});
    EXPECT_FALSE(pixel_of(photo, {1.7, 0.0, 0.0}));
    EXPECT_FALSE(pixel_of(photo, {0.0, 0.0, -3.0}));
    EXPECT_TRUE(pixel_beyond(photo, {1.7, 0.0, 0.0}));
}

} // namespace
} // namespace vcarve::calibrated_photo_test
