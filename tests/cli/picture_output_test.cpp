#include "cli/picture_output.h"
#include "support/ball_model.h"
#include "support/program.h"
#include "support/read_png.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace vcarve::picture_output_test {
namespace {

using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

// The images of the ball have 1000 x 1000 pixels.
constexpr int kPanel = 1108;
constexpr int kWidth = 2 * kPanel + 8;
constexpr int kCaption = 2 * 14 + 8;
const Rgb kBackground = {236, 239, 243};
const Rgb kBacks = {255, 0, 255};

class PreviewOfBall : public ::testing::Test {
  protected:
    PreviewOfBall() { write_ball_model(ball, 400); }

    TemporaryFolder folder;
    std::string ball = folder / "ball";
    std::string out = folder / "out.ply";
    std::string png = folder / "out.png";
};

TEST_F(PreviewOfBall, ShowsTheMeshBesideItsNormals)
{
    const Outcome outcome = run_program({ball, out, "--preview", png});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, ContainsRegex("preview +1,227,664 pixels of out.ply +[0-9.]+ s\n"));
    const ReadPng shown = read_png(png);
    ASSERT_EQ(shown.width, kWidth);
    ASSERT_EQ(shown.height, kCaption + kPanel);
    EXPECT_EQ(folder.num_entries(), 3U);

    const int middle_y = kCaption + kPanel / 2;
    const Rgb ball_color = shown.at(kPanel / 2, middle_y);
    // The points' color 200, 100, 50, viewed almost along the normal.
    EXPECT_NEAR(ball_color[0], 198, 3);
    EXPECT_NEAR(ball_color[1], 99, 2);
    EXPECT_NEAR(ball_color[2], 49, 2);
    EXPECT_EQ(shown.at(5, middle_y), kBackground);
    EXPECT_GT(shown.at(kPanel + 8 + kPanel / 2, middle_y)[2], 215);
    EXPECT_EQ(shown.at(kWidth - 5, middle_y), kBackground);
    EXPECT_THAT(shown.colors(0, kCaption, kWidth, shown.height), Not(Contains(kBacks)));
    EXPECT_GT(shown.colors(0, kCaption, kPanel, shown.height).size(), 50U);
}

TEST_F(PreviewOfBall, IsTheSameForAnyThreadCount)
{
    std::vector<std::string> written;
    for (const char* threads : {"1", "2", "3"}) {
        ASSERT_EQ(
            run_program({"--quiet", ball, out, "--preview", png, "--threads", threads}).exit_code,
            0);
        written.push_back(bytes_of(png));
    }
    EXPECT_FALSE(written[0].empty());
    EXPECT_TRUE(written[1] == written[0] && written[2] == written[0]);
}

TEST_F(PreviewOfBall, UsesTheChosenViewpoint)
{
    const std::string stats = folder / "stats.json";
    std::vector<std::string> written;
    for (const char* view : {"auto", "+z.jpg", "top", "orbit"}) {
        ASSERT_EQ(run_program({"--quiet", ball, out, "--preview", png,
                               std::string("--view=") + view, "--stats", stats})
                      .exit_code,
                  0);
        const auto record = nlohmann::json::parse(bytes_of(stats));
        EXPECT_EQ(record["preview"]["file"], png);
        // Of the six images, -x.jpg sees the most points.
        EXPECT_EQ(record["preview"]["view"], std::string(view) == "auto" ? "-x.jpg" : view);
        EXPECT_TRUE(std::ranges::count(written, bytes_of(png)) == 0) << view;
        written.push_back(bytes_of(png));
        const int wide = std::string(view) == "top" || std::string(view) == "orbit" ? 1280 : kPanel;
        EXPECT_EQ(read_png(png).width, 2 * wide + 8);
    }
}

TEST_F(PreviewOfBall, HasOneRowPerMeshInAComparison)
{
    ASSERT_EQ(run_program({"--quiet", ball, out}).exit_code, 0);
    const std::string inside_out = folder / "inside_out.ply";
    folder.write("inside_out.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n"
                                   "property double y\nproperty double z\nelement face 1\n"
                                   "property list uchar int vertex_indices\nend_header\n"
                                   "0 -9 -9\n0 9 -9\n0 0 9\n3 0 1 2\n");
    const Outcome outcome =
        run_program({"compare", ball, out, inside_out, "--samples", "2000", "--preview", png});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("pixels of out.ply"));
    EXPECT_THAT(outcome.err, HasSubstr("pixels of inside_out.ply"));
    const ReadPng shown = read_png(png);
    ASSERT_EQ(shown.width, kWidth);
    ASSERT_EQ(shown.height, 2 * (kCaption + kPanel));
    EXPECT_NEAR(shown.at(kPanel / 2, kCaption + kPanel / 2)[0], 198, 3);
    EXPECT_EQ(shown.at(kPanel / 2, 2 * kCaption + kPanel + kPanel / 2), kBacks);
}

TEST_F(PreviewOfBall, RejectsAnUnknownViewBeforePointsAreRead)
{
    EXPECT_EQ(sentence_of(2, {ball, out, "--preview", png, "--view", "x.jpg"}),
              "colmap-vcarve: --view must be auto, top, orbit or the name of an image, but "
              "\"x.jpg\" is none of the 6 images (+z.jpg, -z.jpg, +y.jpg, ...)\n");
    EXPECT_EQ(folder.num_entries(), 1U);
}

} // namespace
} // namespace vcarve::picture_output_test
