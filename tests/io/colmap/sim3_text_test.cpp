#include "io/colmap/sim3_text.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <string>

namespace vcarve::sim3_text_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class Sim3Text : public ::testing::Test {
  protected:
    Similarity read(const std::string& text) const
    {
        return read_sim3(folder_.write("sim3.txt", text));
    }
    /// The error message after the path of the file.
    std::string refused(const std::string& text) const
    {
        const std::string sentence = refusal<InputError>([&] { read(text); });
        const std::string begin = (folder_ / "sim3.txt").string() + ": ";
        EXPECT_TRUE(sentence.starts_with(begin)) << sentence;
        return sentence.substr(std::min(begin.size(), sentence.size()));
    }

  private:
    TemporaryFolder folder_;
};

/// A rotation by 90 degrees about z.
Matrix3d quarter()
{
    Matrix3d matrix;
    matrix << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return matrix;
}

TEST_F(Sim3Text, ReadsScaleQuaternionAndTranslationOfColmap)
{
    const Similarity to = read("2.5 0.70710678118654757 0 0 0.70710678118654757 1 -2 3e5\n");
    EXPECT_NEAR(to.scale, 2.5, 1e-14);
    EXPECT_TRUE(to.linear.isApprox(2.5 * quarter(), 1e-15)) << to.linear;
    EXPECT_EQ(to.translation, Vector3d(1, -2, 3e5));
}

TEST_F(Sim3Text, ReadsAMatrixOfThreeOrFourRows)
{
    const std::string rows = "# moved by hand\n0 -3 0 7\n3 0 0 8\n\n0 0 3 9";
    for (const char* const last : {"", "\n", "\n0 0 0 1\n", "\r\n0 0 0 1.0\r\n"}) {
        const Similarity to = read(rows + last);
        EXPECT_NEAR(to.scale, 3.0, 1e-15);
        EXPECT_EQ(to.linear, 3.0 * quarter());
        EXPECT_EQ(to.translation, Vector3d(7, 8, 9));
    }
}

TEST_F(Sim3Text, SurvivesARoundTrip)
{
    const Similarity to = read("0.1 0.5 0.5 -0.5 0.5 1e6 0.3 -7");
    const Similarity again = read(sim3_text(to));
    EXPECT_NEAR(again.scale, 0.1, 1e-15);
    EXPECT_TRUE(again.linear.isApprox(to.linear, 1e-15));
    EXPECT_EQ(again.translation, to.translation);
}

TEST_F(Sim3Text, RefusesOtherTextWithOneSentence)
{
    const std::string expected = ", expected 8 as COLMAP writes them (scale, quaternion w x y z, "
                                 "translation) or a matrix of 3 or 4 rows of 4";
    EXPECT_EQ(refused(""), "found 0 numbers" + expected);
    EXPECT_EQ(refused("1 0 0 0 1 2 3"), "found 7 numbers" + expected);
    std::string many;
    for (int i = 0; i < 1000; ++i) {
        many += "1\n";
    }
    EXPECT_EQ(refused(many), "found more than 16 numbers" + expected);
    EXPECT_EQ(refused("1 0 0\n0 one 0"),
              "line 2: found 'one', expected an entry of the transformation (a number)");
    EXPECT_EQ(refused("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2"),
              "the last row of the matrix is 0 0 0 2, expected 0 0 0 1");
    const std::string end = ", expected a rotation with a scale and a translation";
    EXPECT_EQ(refused("-1 1 0 0 0 0 0 0"),
              "the transformation is a reflection, which turns surfaces inside out" + end);
    EXPECT_EQ(refused("1 0 0 0 0 1 0 0 0 0 -1 0"),
              "the transformation is a reflection, which turns surfaces inside out" + end);
    EXPECT_EQ(refused("1 0 0 0 0 2 0 0 0 0 1 0"),
              "the transformation is a matrix with shear or unequal scales" + end);
    for (const char* const none : {"0 1 0 0 0 0 0 0", "nan 1 0 0 0 0 0 0", "1 0 0 0 0 1 2 3",
                                   "1 1 0 0 0 inf 0 0", "1e300 1 0 0 0 0 0 0"}) {
        EXPECT_EQ(refused(none), "the transformation is a singular or infinite matrix" + end);
    }
}

} // namespace
} // namespace vcarve::sim3_text_test
