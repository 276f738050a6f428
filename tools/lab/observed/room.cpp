#include "observed/observe.h"
#include "render/raster.h"
#include "render/shapes.h"

#include <cmath>
#include <numbers>

namespace vcarve::observed {

namespace {

using Eigen::Vector3d;
using render::add_box;
using render::add_column;
using render::Paint;
using render::PartBuilder;

constexpr double kHalfX = 2.6;
constexpr double kHalfY = 2.1;
constexpr double kHeight = 2.5;

void add_shell(PartBuilder& builder)
{
    constexpr double kWall = 0.2;
    constexpr double kPlain = 0.1; // a few stains
    const double wide = 2.0 * (kHalfX + kWall);
    const double deep = 2.0 * (kHalfY + kWall);
    add_box(builder, {{0.0, 0.0, -kWall}, {wide, deep, kWall}}, {{0.62F, 0.50F, 0.38F}, 0.5});
    add_box(builder, {{0.0, 0.0, kHeight}, {wide, deep, kWall}}, {{0.95F, 0.95F, 0.94F}, kPlain});
    const Paint wall{{0.88F, 0.86F, 0.80F}, kPlain};
    for (const double side : {-1.0, 1.0}) {
        add_box(builder,
                {{side * (kHalfX + 0.5 * kWall), 0.0, 0.0}, {kWall, 2.0 * kHalfY, kHeight}}, wall);
        add_box(builder, {{0.0, side * (kHalfY + 0.5 * kWall), 0.0}, {wide, kWall, kHeight}}, wall);
    }
}

void add_table(PartBuilder& builder, const Vector3d& place, const Paint& paint)
{
    add_box(builder, {place + Vector3d(0.0, 0.0, 0.70), {1.3, 0.8, 0.05}}, paint);
    for (const double x : {-0.58, 0.58}) {
        for (const double y : {-0.33, 0.33}) {
            add_box(builder, {place + Vector3d(x, y, 0.0), {0.08, 0.08, 0.70}}, paint);
        }
    }
}

/// Adds a shelf that is open towards -y.
void add_shelf(PartBuilder& builder, const Vector3d& place, const Paint& paint)
{
    for (const double x : {-0.6, 0.6}) {
        add_box(builder, {place + Vector3d(x, 0.0, 0.0), {0.05, 0.35, 1.7}}, paint);
    }
    for (int level = 0; level < 4; ++level) {
        add_box(builder, {place + Vector3d(0.0, 0.0, 0.05 + 0.53 * level), {1.2, 0.35, 0.05}},
                paint);
    }
}

void add_sofa(PartBuilder& builder, const Vector3d& place, const Paint& paint)
{
    add_box(builder, {place, {0.85, 1.8, 0.42}}, paint);
    add_box(builder, {place + Vector3d(-0.32, 0.0, 0.42), {0.22, 1.8, 0.42}}, paint);
    for (const double y : {-0.8, 0.8}) {
        add_box(builder, {place + Vector3d(0.1, y, 0.42), {0.65, 0.2, 0.2}}, paint);
    }
}

void add_furniture(PartBuilder& builder)
{
    add_table(builder, {1.1, 0.9, 0.0}, {{0.74F, 0.58F, 0.40F}});
    add_column(builder, {{1.3, 0.9, 0.75}, 0.10, 0.14, 0.3}, {{0.45F, 0.70F, 0.66F}, 1.5});
    add_shelf(builder, {-1.2, 1.9, 0.0}, {{0.68F, 0.56F, 0.44F}});
    add_sofa(builder, {-2.1, -0.4, 0.0}, {{0.48F, 0.56F, 0.72F}});
    add_box(builder, {{0.7, -1.83, 0.0}, {1.4, 0.5, 0.85}}, {{0.78F, 0.70F, 0.56F}});
    add_box(builder, {{0.8, -2.08, 1.2}, {0.9, 0.04, 0.7}}, {{0.60F, 0.68F, 0.48F}, 1.5});
    add_box(builder, {{-0.2, -0.3, 0.0}, {1.9, 1.3, 0.01}}, {{0.60F, 0.24F, 0.26F}}); // rug
    add_box(builder, {{-0.6, -0.2, 0.01}, {0.6, 0.45, 0.4}, 25.0}, {{0.58F, 0.44F, 0.38F}});
    add_column(builder, {{2.1, -1.4, 0.0}, 0.22, 0.22, 0.5}, {{0.72F, 0.48F, 0.60F}});
}

} // namespace

ObservedScene inside_a_room()
{
    PartBuilder builder;
    add_shell(builder);
    add_furniture(builder);
    ObservedScene scene{.name = "room", .parts = builder.take(), .views = {}, .points = 2000};
    const render::Lens wide{1000, 750, 600.0};
    // Views across the center of the room, then outward views from around the center.
    render::add_arc(scene.views, wide, {{0.0, 0.0, 0.8}, 1.5, 1.5, 10.0, 24.0, 15});
    constexpr int kOutwards = 15;
    for (int i = 0; i < kOutwards; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * (i + 0.5) / kOutwards;
        const Vector3d out(std::cos(turn_rad), std::sin(turn_rad), 0.0);
        const double tilt = i % 2 == 0 ? -0.3 : 0.1;
        const Vector3d center = 0.6 * out + 1.45 * Vector3d::UnitZ();
        scene.views.push_back(looking_at(wide, center, center + out + tilt * Vector3d::UnitZ()));
    }
    return scene;
}

} // namespace vcarve::observed
