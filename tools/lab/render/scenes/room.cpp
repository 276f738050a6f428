#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kHalfX = 2.5;
constexpr double kHalfY = 2.0;
constexpr double kHeight = 2.4;
constexpr double kWall = 0.2;

/// Adds four walls, a floor and a ceiling, with a deep window and a recessed doorway.
void add_shell(PartBuilder& builder)
{
    const double wide = 2.0 * (kHalfX + kWall);
    const double deep = 2.0 * (kHalfY + kWall);
    add_box(builder, {{0.0, 0.0, -kWall}, {wide, deep, kWall}}, {{0.66F, 0.54F, 0.42F}});
    add_box(builder, {{0.0, 0.0, kHeight}, {wide, deep, kWall}}, {{0.90F, 0.90F, 0.88F}});
    add_box(builder, {{-kHalfX - 0.5 * kWall, 0.0, 0.0}, {kWall, deep, kHeight}},
            {{0.80F, 0.84F, 0.74F}});
    add_box(builder, {{0.0, -kHalfY - 0.5 * kWall, 0.0}, {wide, kWall, kHeight}},
            {{0.84F, 0.76F, 0.80F}});
    const auto window = [](std::size_t i, std::size_t k) { return i == 1 && k == 1 ? 0.15 : 0.0; };
    add_board(builder, {{-kHalfX, -0.8, 0.9, kHalfX}, {0.0, 0.9, 2.0, kHeight}, kWall, window},
              {{0.74F, 0.82F, 0.88F}});
    builder.move_part(Eigen::Isometry3d(Eigen::Translation3d(0.0, kHalfY, 0.0)));
    const auto door = [](std::size_t i, std::size_t k) { return i == 1 && k == 0 ? 0.12 : 0.0; };
    add_board(builder, {{-kHalfY, -0.3, 0.6, kHalfY}, {0.0, 2.0, kHeight}, kWall, door},
              {{0.86F, 0.82F, 0.70F}});
    Eigen::Isometry3d move(Eigen::Translation3d(kHalfX, 0.0, 0.0));
    move.rotate(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
    builder.move_part(move);
}

void add_table(PartBuilder& builder, const Eigen::Vector3d& place, const Paint& paint)
{
    add_box(builder, {place + Eigen::Vector3d(0.0, 0.0, 0.70), {1.2, 0.7, 0.04}}, paint);
    for (const double x : {-0.54, 0.54}) {
        for (const double y : {-0.29, 0.29}) {
            add_box(builder, {place + Eigen::Vector3d(x, y, 0.0), {0.06, 0.06, 0.70}}, paint);
        }
    }
}

/// Adds a shelf, open towards -y, with boards every 0.4.
void add_shelf(PartBuilder& builder, const Eigen::Vector3d& place, const Paint& paint)
{
    for (const double x : {-0.5, 0.5}) {
        add_box(builder, {place + Eigen::Vector3d(x, 0.0, 0.0), {0.03, 0.3, 1.8}}, paint);
    }
    for (int level = 0; level < 5; ++level) {
        const double z = 0.05 + 0.43 * level;
        add_box(builder, {place + Eigen::Vector3d(0.0, 0.0, z), {1.0, 0.3, 0.03}}, paint);
    }
    add_box(builder, {place + Eigen::Vector3d(-0.2, 0.02, 0.51), {0.3, 0.2, 0.28}, 6.0},
            {{0.80F, 0.40F, 0.36F}});
    add_box(builder, {place + Eigen::Vector3d(0.25, 0.02, 0.94), {0.25, 0.2, 0.2}, -9.0},
            {{0.40F, 0.60F, 0.80F}});
    add_sphere(builder, place + Eigen::Vector3d(-0.25, 0.0, 1.07), 0.1, {{0.86F, 0.80F, 0.40F}});
}

void add_sofa(PartBuilder& builder, const Eigen::Vector3d& place, const Paint& paint)
{
    add_box(builder, {place, {0.85, 1.7, 0.4}}, paint);
    add_box(builder, {place + Eigen::Vector3d(-0.33, 0.0, 0.4), {0.2, 1.7, 0.4}}, paint);
    for (const double y : {-0.76, 0.76}) {
        add_box(builder, {place + Eigen::Vector3d(0.1, y, 0.4), {0.65, 0.18, 0.2}}, paint);
    }
    add_sphere(builder, place + Eigen::Vector3d(-0.05, 0.45, 0.55), 0.17, {{0.90F, 0.60F, 0.66F}});
}

void add_furniture(PartBuilder& builder)
{
    add_table(builder, {1.3, 1.4, 0.0}, {{0.76F, 0.60F, 0.40F}});
    add_column(builder, {{1.5, 1.4, 0.74}, 0.08, 0.12, 0.25}, {{0.50F, 0.74F, 0.70F}});
    add_box(builder, {{1.05, 1.35, 0.74}, {0.3, 0.22, 0.05}, 20.0}, {{0.82F, 0.46F, 0.44F}});
    add_shelf(builder, {-1.6, 1.83, 0.0}, {{0.70F, 0.58F, 0.46F}});
    add_sofa(builder, {-2.0, -0.5, 0.0}, {{0.50F, 0.58F, 0.74F}});
    add_box(builder, {{0.6, -1.7, 0.0}, {1.2, 0.5, 0.8}}, {{0.80F, 0.72F, 0.58F}}); // sideboard
    add_column(builder, {{0.3, -1.7, 0.8}, 0.1, 0.06, 0.35}, {{0.88F, 0.56F, 0.40F}});
    add_box(builder, {{0.9, -1.97, 1.15}, {0.6, 0.05, 0.5}}, {{0.62F, 0.70F, 0.50F}}); // picture
    add_column(builder, {{2.1, -1.5, 0.0}, 0.16, 0.16, 0.03}, {{0.40F, 0.40F, 0.44F}});
    add_column(builder, {{2.1, -1.5, 0.03}, 0.025, 0.025, 1.4}, {{0.40F, 0.40F, 0.44F}});
    add_column(builder, {{2.1, -1.5, 1.4}, 0.24, 0.12, 0.3}, {{0.92F, 0.86F, 0.66F}}); // lamp
    add_box(builder, {{0.1, 0.1, 0.0}, {0.7, 0.45, 0.3}, 25.0}, {{0.60F, 0.46F, 0.40F}});
    add_column(builder, {{2.0, 0.9, 0.0}, 0.2, 0.2, 0.45}, {{0.74F, 0.50F, 0.62F}}); // stool
}

} // namespace

PhotoScene room()
{
    PartBuilder builder;
    add_shell(builder);
    add_furniture(builder);
    PhotoScene scene;
    scene.parts = builder.take();
    const Lens wide{1000, 750, 640.0};
    // Views across the center of the room, up to the ceiling, and outward from around the center.
    add_arc(scene.views, wide, {{0.0, 0.0, 0.9}, 1.25, 1.4, 0.0, 20.0, 18});
    add_arc(scene.views, wide, {{0.0, 0.0, 2.1}, 1.5, 0.7, 0.0, 36.0, 10});
    constexpr int kOutwards = 16;
    for (int i = 0; i < kOutwards; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * (i + 0.5) / kOutwards;
        const Eigen::Vector3d out(std::cos(turn_rad), std::sin(turn_rad), 0.0);
        const double tilt = i % 2 == 0 ? -0.25 : 0.12;
        const Eigen::Vector3d center = 0.7 * out + 1.6 * Eigen::Vector3d::UnitZ();
        scene.views.push_back(
            looking_at(wide, center, center + out + tilt * Eigen::Vector3d::UnitZ()));
    }
    scene.frame = {0.3, turned(1.5, {0.9, -0.3, 0.2}), {5.0, 6.0, -2.0}};
    return scene;
}

} // namespace vcarve::render
