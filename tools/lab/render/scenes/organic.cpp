// Scenes of round shapes.
#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// The radius of the body in a direction: smooth waves on the sphere, without seams or poles.
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

/// A (2, 3) torus knot around z.
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

const Eigen::Array3f kSkin(0.90F, 0.74F, 0.60F);
const Paint kNearlyEven{kSkin, 0.06};

/// Adds a ball, stretched along the axes and slightly dented.
void add_limb(PartBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector3d& radii,
              const Paint& paint)
{
    const auto reach = [&](const Eigen::Vector3d& way) {
        const double dents = 0.03 * std::sin(4.0 * way.x() + 1.0) * std::cos(3.0 * way.z());
        return (1.0 + dents) / way.cwiseQuotient(radii).norm();
    };
    add_blob(builder, middle, reach, paint);
}

/// Adds a sitting figure of one color with a few patches.
void add_figure(PartBuilder& builder)
{
    add_limb(builder, {0.0, 0.0, 0.42}, {0.40, 0.36, 0.44}, kNearlyEven);
    add_limb(builder, {0.02, -0.04, 1.02}, {0.31, 0.29, 0.28}, kNearlyEven);
    add_limb(builder, {0.02, -0.30, 0.96}, {0.14, 0.13, 0.11}, kNearlyEven);
    for (const double side : {-1.0, 1.0}) {
        add_limb(builder, {0.02 + 0.23 * side, 0.0, 1.25}, {0.11, 0.07, 0.11}, kNearlyEven);
        add_limb(builder, {0.40 * side, -0.12, 0.60}, {0.17, 0.14, 0.26}, kNearlyEven);
        add_limb(builder, {0.26 * side, -0.36, 0.16}, {0.16, 0.32, 0.16}, kNearlyEven);
        // Soles and eyes.
        add_limb(builder, {0.26 * side, -0.645, 0.16}, {0.10, 0.05, 0.10}, {{0.80F, 0.46F, 0.40F}});
        add_sphere(builder, {0.02 + 0.11 * side, -0.30, 1.09}, 0.035, {{0.40F, 0.40F, 0.50F}});
    }
    add_limb(builder, {0.02, -0.425, 0.99}, {0.05, 0.03, 0.04}, {{0.40F, 0.40F, 0.50F}}); // nose
    // A belly that protrudes by a finger's breadth, and a patch on the back.
    add_limb(builder, {0.0, -0.13, 0.42}, {0.25, 0.25, 0.27}, {{0.94F, 0.84F, 0.62F}});
    add_limb(builder, {-0.08, 0.15, 0.48}, {0.20, 0.23, 0.24}, {{0.56F, 0.66F, 0.84F}});
    const auto around_neck = [](double along) -> Eigen::Vector3d {
        const double turn_rad = 2.0 * std::numbers::pi * along;
        return {0.235 * std::cos(turn_rad), -0.02 + 0.215 * std::sin(turn_rad),
                0.79 + 0.015 * std::sin(2.0 * turn_rad)};
    };
    add_tube(builder, {around_neck, [](double, double) { return 0.055; }}, {{0.80F, 0.40F, 0.44F}});
}

/// Adds a turned vase with a band of texture around its middle.
void add_vase(PartBuilder& builder, const Eigen::Vector3d& place)
{
    const Paint glaze{{0.66F, 0.78F, 0.82F}, 0.05};
    add_limb(builder, place + Eigen::Vector3d(0.0, 0.0, 0.27), {0.24, 0.24, 0.29}, glaze);
    add_column(builder, {place + Eigen::Vector3d(0.0, 0.0, 0.48), 0.13, 0.09, 0.16}, glaze);
    add_column(builder, {place + Eigen::Vector3d(0.0, 0.0, 0.64), 0.09, 0.15, 0.08}, glaze);
    add_column(builder, {place + Eigen::Vector3d(0.0, 0.0, 0.25), 0.250, 0.249, 0.07},
               {{0.40F, 0.52F, 0.80F}});
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
    scene.frame = {1000.0, turned(2.0, {-0.7, 0.1, 0.6}), {-400.0, 900.0, 5000.0}};
    return scene;
}

PhotoScene smooth()
{
    PartBuilder builder;
    add_column(builder, {{0.2, -0.1, -0.06}, 1.5, 1.5, 0.06}, {{0.66F, 0.56F, 0.46F}}); // table
    add_figure(builder);
    add_vase(builder, {0.95, 0.05, 0.0});
    add_limb(builder, {0.75, -0.75, 0.15}, {0.17, 0.17, 0.16}, {{0.84F, 0.50F, 0.40F}, 0.06});
    PhotoScene scene;
    scene.parts = builder.take();
    const Lens lens{900, 720, 800.0};
    const Eigen::Vector3d target(0.25, -0.1, 0.5);
    add_arc(scene.views, lens, {target, 2.8, 1.0, 0.0, 18.0, 20});
    add_arc(scene.views, lens, {target, 2.3, 2.1, 9.0, 18.0, 20});
    scene.frame = {250.0, turned(2.6, {0.2, 0.9, -0.4}), {-90.0, 10.0, 600.0}};
    return scene;
}

} // namespace vcarve::render
