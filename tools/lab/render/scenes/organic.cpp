#include "render/scenes/scenes.h"
#include "render/shapes.h"
#include "render/stands.h"

#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Waves of a unit direction: smooth on the ball, without seams or poles.
double body_reach(const Eigen::Vector3d& way)
{
    const double x = way.x();
    const double y = way.y();
    const double z = way.z();
    const double lobes = 0.35 * (x * x - y * y) * x + 0.30 * z * (5.0 * z * z - 3.0) / 2.0 * y +
                         0.18 * std::sin(5.0 * x + 1.0) * std::cos(4.0 * y);
    const double bumps = 0.05 * std::sin(11.0 * x) * std::sin(10.0 * y + 2.0 * z) +
                         0.03 * std::sin(17.0 * z + 6.0 * x);
    return 0.58 * (1.0 + lobes + bumps);
}

/// A (2, 3) torus knot about z.
Eigen::Vector3d knot(double along)
{
    const double reach = 0.34 + 0.15 * std::cos(3.0 * kTwoPi * along);
    return {reach * std::cos(2.0 * kTwoPi * along), reach * std::sin(2.0 * kTwoPi * along),
            0.16 * std::sin(3.0 * kTwoPi * along)};
}

double knot_radius(double along, double across)
{
    return 0.075 + 0.012 * std::sin(kTwoPi * (14.0 * along + across)) +
           0.008 * std::cos(kTwoPi * (9.0 * along - 2.0 * across));
}

} // namespace

PhotoScene organic()
{
    PartBuilder builder;
    add_box(builder, {{0.1, 0.0, -0.06}, {2.8, 2.8, 0.06}}, {{0.66F, 0.72F, 0.62F}});
    add_blob(builder, {-0.35, 0.1, 0.62}, body_reach, {{0.86F, 0.66F, 0.56F}});
    add_tube(builder, {knot, knot_radius}, {{0.56F, 0.70F, 0.88F}});
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translate(Eigen::Vector3d(0.78, -0.25, 0.5));
    move.rotate(Eigen::AngleAxisd(1.15, Eigen::Vector3d(0.6, 0.8, 0.0)));
    builder.move_part(move);
    PhotoScene scene;
    scene.parts = builder.take();
    const Eigen::Vector3d target(0.1, 0.0, 0.5);
    add_arc(scene.views, {}, {target, 2.7, 0.7, 0.0, 20.0, 18});
    add_arc(scene.views, {}, {target, 2.3, 1.8, 10.0, 20.0, 18});
    scene.frame = {
        1000.0,
        Eigen::Quaterniond(Eigen::AngleAxisd(2.0, Eigen::Vector3d(-0.7, 0.1, 0.6).normalized())),
        {-400.0, 900.0, 5000.0}};
    return scene;
}

} // namespace vcarve::render
