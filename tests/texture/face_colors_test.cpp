#include "support/photographed_wall.h"
#include "texture/face_colors.h"

#include <gtest/gtest.h>

namespace vcarve::face_colors_test {
namespace {

/// Faces that all photographs show: the constant color of each face times the photograph's
/// exposure.
struct Shown {
    std::vector<PhotosOfFace> photos;
    FaceColors colors;

    Shown(std::size_t faces, const std::vector<double>& exposures) : photos(faces), colors(faces)
    {
        for (std::size_t face = 0; face < faces; ++face) {
            photos[face].count = static_cast<std::uint8_t>(exposures.size());
            for (std::size_t i = 0; i < exposures.size(); ++i) {
                photos[face].best[i] = {static_cast<std::uint32_t>(i), 100.0F};
                const double level =
                    60.0 + 80.0 * static_cast<double>(face) / static_cast<double>(faces);
                const auto seen = static_cast<std::uint8_t>(std::lround(level * exposures[i]));
                colors[face][i].fill({seen, seen, seen});
            }
        }
    }
};

TEST(Gains, MakeExposuresAgree)
{
    const std::vector<double> exposures = {0.8, 1.0, 1.25, 1.1};
    const Shown shown(2000, exposures);
    const Gains gains = find_gains(4, shown.photos, shown.colors);
    double mean = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(gains[i][0] * exposures[i] / (gains[1][0] * exposures[1]), 1.0, 0.02) << i;
        mean += gains[i][0] / 4.0;
    }
    EXPECT_NEAR(mean, 1.0, 0.02);
}

TEST(Gains, AreOneForPhotographsWithoutCommonFaces)
{
    Shown shown(10, {0.5});
    shown.photos[3].best[0].photo = 1;
    const Gains gains = find_gains(2, shown.photos, shown.colors);
    EXPECT_NEAR(gains[0][0], 1.0, 1e-6);
    EXPECT_NEAR(gains[1][0], 1.0, 1e-6);
}

TEST(DropOutliers, DropsThePhotographWithAnotherColor)
{
    Shown shown(5, {1.0, 1.0, 1.0, 1.0});
    shown.colors[2][1].fill({250, 0, 250});
    EXPECT_EQ(drop_outliers(Gains(4, Eigen::Array3f::Ones()), shown.photos, shown.colors), 1U);
    ASSERT_EQ(shown.photos[2].count, 3);
    EXPECT_EQ(shown.photos[2].best[1].photo, 2U);
    EXPECT_EQ(shown.colors[2][1][0][1], shown.colors[2][0][0][1]);
    EXPECT_EQ(shown.photos[1].count, 4);
}

TEST(DropOutliers, KeepsBothOfTwoPhotographs)
{
    Shown shown(1, {1.0, 1.0});
    shown.colors[0][1].fill({250, 0, 250});
    EXPECT_EQ(drop_outliers(Gains(2, Eigen::Array3f::Ones()), shown.photos, shown.colors), 0U);
}

} // namespace
} // namespace vcarve::face_colors_test
