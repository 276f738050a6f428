// Laser scans, given to the program as the user gives them.
#include "support/dense_workspace.h"
#include "support/program.h"
#include "support/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace vcarve::mesh_command_scan_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Points on the unit ball, which two scanners measured from 3 away on both sides; each is on the
/// side of its scanner.
class ProgramOnScannedBall : public ::testing::Test {
  protected:
    ProgramOnScannedBall()
    {
        constexpr int kPoints = 1000;
        for (int i = 0; i < kPoints; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / kPoints;
            const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
            const double radius = std::sqrt(1.0 - z * z);
            if (std::abs(z) < 0.35) continue; // seen along the surface or not at all
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
        scan = folder.write("scan.ply", bytes_with({"x_origin", "y_origin", "z_origin"}));
        std::erase_if(points, [](const Eigen::Vector3d& p) { return p.z() < 0.0; });
        bare = folder.write("bare.ply", bytes_with({}));
    }

    /// As text, with the place of the scanner if that has names.
    std::string bytes_with(const std::vector<std::string>& names) const
    {
        std::string bytes = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float "
                                        "x\nproperty float y\nproperty float z\n",
                                        points.size());
        for (const std::string& name : names) {
            bytes += "property double " + name + "\n";
        }
        bytes += "end_header\n";
        for (const Eigen::Vector3d& p : points) {
            bytes += fmt::format("{} {} {}", p.x(), p.y(), p.z());
            if (!names.empty()) bytes += fmt::format(" 0 0 {}", p.z() > 0.0 ? 3 : -3);
            bytes += "\n";
        }
        return bytes;
    }

    TemporaryFolder folder;
    std::vector<Eigen::Vector3d> points;
    std::string scan;
    std::string bare; ///< one half of them, and nothing of scanners
    std::string out = folder / "out.ply";
};

TEST_F(ProgramOnScannedBall, MeshesAScanWithoutAModelAndDropsNoPointForItsOneView)
{
    const std::string stats = folder / "stats.json";
    const Outcome outcome = run_program({scan, out, "--merge-px", "0", "--stats", stats});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("note: the points are those of " + scan +
                                        ", measured by the scanners of which it tells at every "
                                        "point\nread         650 points, 2 views, 650 rays "));
    EXPECT_THAT(outcome.err, HasSubstr("\nfilter       650 of 650 points kept"));
    const auto record = nlohmann::json::parse(bytes_of(stats));
    EXPECT_EQ(record["input"]["cloud"], scan);
    EXPECT_TRUE(record["input"]["folder"].is_null());
    EXPECT_GE(record["mesh"]["faces"], 1000);
}

TEST_F(ProgramOnScannedBall, TakesOnePlaceForAllPoints)
{
    const Outcome outcome = run_program({bare, out, "--scanner", "0,0,3"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("note: the points are those of " + bare +
                                        ", measured by a scanner at 0, 0, 3\nread         325 "
                                        "points, 1 views, 325 rays"));
    EXPECT_EQ(run_program({bare, out, "--scanner", "file"}).exit_code, 3);
}

TEST_F(ProgramOnScannedBall, SaysWhatACloudWithoutScannersNeeds)
{
    const Outcome outcome = run_program({bare, out});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("no COLMAP model, looked for "));
    EXPECT_THAT(outcome.err, HasSubstr("; " + bare +
                                       " tells of no scanner's places either, where it could do "
                                       "without a model (--scanner x,y,z tells of one)\n"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ProgramOnScannedBall, RefusesTwoOpinionsOnWhereTheScannerStood)
{
    const Outcome outcome = run_program({scan, out, "--scanner", "0,0,3"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--scanner 0,0,3 is one place for all points, but " + scan +
                                       " tells itself where the scanner of each stood\n"));
}

TEST_F(ProgramOnScannedBall, MeasuresMeshesByTheScan)
{
    EXPECT_EQ(run_program({scan, out, "--quiet"}).exit_code, 0);
    EXPECT_THAT(
        run_program({"compare", "--quiet", scan, out}).out,
        HasSubstr("Measured against 650 points with at least 2 views or a measured range and 2 "
                  "views; "));
    const Outcome colmap = run_program({"compare", "--quiet", scan, "--colmap", "colmap"});
    EXPECT_EQ(colmap.exit_code, 2);
    EXPECT_EQ(colmap.err, "colmap-vcarve: --colmap cannot be told to take the points of " + scan +
                              ": COLMAP's mesher knows no scanners\n");
}

} // namespace
} // namespace vcarve::mesh_command_scan_test
