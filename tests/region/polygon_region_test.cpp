#include "region/region.h"
#include "support/region_checks.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

namespace vcarve::polygon_region_test {
namespace {

using Eigen::Vector3d;

/// An L of the squares from (-3, -3) to (3, 0) and from (-3, -3) to (0, 3).
constexpr const char* kL = "# an L\n-3 -3\n3 -3\n\n3\t0\r\n0 0\n0 3\n-3 3\n";

class PolygonFile : public ::testing::Test {
  protected:
    std::unique_ptr<Region> read(const std::string& text, const Vector3d& offset = {0, 0, 0}) const
    {
        return read_polygon_region(folder.write("corners.txt", text), offset);
    }
    /// The error message without the path at its begin.
    std::string refused(const std::string& text) const
    {
        const std::string path = (folder / "corners.txt").string();
        const std::string message = refusal<InputError>([&] { read(text); });
        return message.starts_with(path) ? message.substr(path.size()) : message;
    }

    TemporaryFolder folder;
};

TEST_F(PolygonFile, GivesAPrismWithoutLimitsInZ)
{
    const auto region = read(kL);
    EXPECT_TRUE(region->contains({-1, 2, 1e9}));
    EXPECT_TRUE(region->contains({0, 1, -1e9})); // on its side
    EXPECT_FALSE(region->contains({1, 1, 0}));   // in the notch
    EXPECT_FALSE(region->contains({4, -1, 0}));
    EXPECT_TRUE(region->meets({1, 1, 0}, {-1, 1, 5}));   // from the notch into the region
    EXPECT_FALSE(region->meets({1, 1, 0}, {2, 2, 5}));   // within the notch
    EXPECT_TRUE(region->meets({-4, -1, 0}, {4, -1, 7})); // across the region
    EXPECT_FALSE(region->meets({1, 1, 0}, {1, 1, 9}));   // vertical in the notch
    EXPECT_TRUE(region->meets({-1, 1, 0}, {-1, 1, 9}));
}

TEST_F(PolygonFile, EqualsTheUnionOfItsBoxes)
{
    const EitherRegion boxes(box_region({-3, -3, -99}, {3, 0, 99}),
                             box_region({-3, -3, -99}, {0, 3, 99}));
    expect_same_region(*read(kL), boxes, 5);
}

TEST_F(PolygonFile, MayRepeatItsFirstCornerAndHaveEitherOrientation)
{
    for (const char* square : {"0 0\n1 0\n1 1\n0 1\n0 0\n", "0 0\n0 1\n1 1\n1 0"}) {
        const auto region = read(square);
        EXPECT_TRUE(region->contains({0.5, 0.5, 0}));
        EXPECT_FALSE(region->contains({1.5, 0.5, 0}));
    }
}

TEST_F(PolygonFile, IsReadInTheFrameOfTheFile)
{
    const auto region = read("500000 4600000\n500001 4600000\n500001 4600001", {5e5, 4.6e6, 7});
    EXPECT_TRUE(region->contains({0.75, 0.5, 0}));
    EXPECT_FALSE(region->contains({500000.75, 4600000.5, 0}));
}

TEST_F(PolygonFile, IsRejectedIfItIsBroken)
{
    EXPECT_EQ(refused("0 0\n1 x\n"), ": line 2: found 'x', expected the y of a corner (a number)");
    EXPECT_EQ(refused("0 0\n# one\n1\n"), ": line 3: the line ends, expected the y of a corner");
    EXPECT_EQ(refused("0 nan\n"),
              ": line 1: found nan, expected the y of a corner (a finite number)");
    EXPECT_EQ(refused("0 0 5\n"), ": line 1: found '5' after the x and y of a corner, expected "
                                  "the end of the line");
    EXPECT_EQ(refused(""), ": found 0 corners of a polygon, expected at least 3");
    EXPECT_EQ(refused("0 0\n1 1\n0 0\n"), ": found 2 corners of a polygon, expected at least 3");
    for (const char* crossed :
         {"0 0\n1 1\n1 0\n0 1\n", "0 0\n1 0\n1 0\n1 1\n", "0 0\n1 0\n2 0\n"}) {
        EXPECT_EQ(refused(crossed), ": found a polygon that touches or intersects itself, "
                                    "expected a simple polygon");
    }
}

} // namespace
} // namespace vcarve::polygon_region_test
