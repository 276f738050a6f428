#include "model/up_of.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vcarve::up_of_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Views that are turned so, in a scene of no points.
Scene turned(const std::vector<Quaterniond>& poses)
{
    Scene scene = make_scene(std::vector<Vector3d>(poses.size(), Vector3d::Zero()), {});
    for (std::size_t i = 0; i < poses.size(); ++i) {
        scene.views[i].cam_from_world = poses[i];
    }
    return scene;
}

Quaterniond around(const Vector3d& axis, double degrees)
{
    return Quaterniond(AngleAxisd(degrees * std::numbers::pi / 180.0, axis));
}

TEST(UpOf, IsTheMeanOfWhatIsAboveForTheCameras)
{
    EXPECT_LT((up_of(turned({Quaterniond::Identity()})) - Vector3d(0, -1, 0)).norm(), 1e-12);
    const Scene tilted = turned({around(Vector3d::UnitX(), 30), around(Vector3d::UnitX(), -30)});
    EXPECT_LT((up_of(tilted) - Vector3d(0, -1, 0)).norm(), 1e-12);
}

TEST(UpOf, IsWhereCamerasLookBackWhoseUpwardDirectionsCancelOut)
{
    const Scene down = turned({Quaterniond::Identity(), around(Vector3d::UnitZ(), 180)});
    EXPECT_LT((up_of(down) - Vector3d(0, 0, -1)).norm(), 1e-12);
}

TEST(UpOf, IsZOfALaserScan)
{
    Scene scan = turned({around(Vector3d::UnitX(), 50)});
    for (Camera& camera : scan.cameras) {
        camera.measures_range = true;
    }
    EXPECT_EQ(up_of(scan), Vector3d::UnitZ());
}

} // namespace
} // namespace vcarve::up_of_test
