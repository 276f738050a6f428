#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A house of plain walls under a textured roof.
struct House {
    Eigen::Vector2d place;
    double turn_deg;
    Eigen::Vector3d size; ///< of the walls
    double gable = 0.0;   ///< height of the ridge, along x, above the walls; 0 for a flat roof
    double wall_contrast = 0.0;
};

const std::array kHouses{
    House{{-2.25, -2.20}, 4.0, {0.95, 0.65, 0.45}, 0.30},
    House{{-0.80, -2.30}, -6.0, {0.80, 0.80, 1.10}},
    House{{0.70, -2.15}, 8.0, {1.00, 0.60, 0.40}, 0.28},
    House{{2.20, -2.25}, 94.0, {0.90, 0.70, 0.55}, 0.34},
    House{{-2.30, -0.85}, 86.0, {0.85, 0.60, 0.60}, 0.26},
    House{{-0.85, -0.75}, 2.0, {0.70, 0.90, 0.75}},
    House{{0.75, -0.80}, -3.0, {0.75, 0.75, 1.60}},
    House{{2.30, -0.70}, 12.0, {0.80, 0.80, 0.50}, 0.0, 0.02},
    House{{-2.15, 0.75}, -8.0, {1.05, 0.70, 0.90}},
    House{{0.85, 0.70}, 92.0, {1.00, 0.65, 0.50}, 0.32, 0.9},
    House{{2.25, 0.85}, 5.0, {0.90, 0.60, 0.42}, 0.30},
    House{{-2.25, 2.20}, 10.0, {0.80, 0.65, 0.48}, 0.36, 0.02},
    House{{-1.10, 2.30}, 88.0, {0.75, 0.60, 0.38}, 0.25},
    House{{0.35, 2.20}, -5.0, {1.20, 0.55, 0.85}, 0.0, 0.8},
    House{{1.60, 2.35}, 3.0, {0.65, 0.65, 1.30}},
    House{{2.60, 2.10}, -12.0, {0.60, 0.75, 0.55}, 0.24},
};

/// Positions and radii.
const std::vector<Eigen::Vector3d> kTrees{
    {-0.75, 0.45, 0.28}, {-0.30, 0.95, 0.22},  {-1.00, 1.05, 0.25}, {-0.45, 0.30, 0.18},
    {1.55, -1.50, 0.20}, {-1.55, -1.60, 0.24}, {1.55, 0.10, 0.17},  {-1.60, 1.55, 0.20},
    {3.00, -1.40, 0.26}, {-3.05, 0.05, 0.22},  {2.95, 1.50, 0.18}};

/// Positions and headings in degrees.
const std::vector<Eigen::Vector3d> kCars{{-1.55, -0.70, 90.0}, {0.00, -1.50, 2.0},
                                         {0.05, -0.30, 88.0},  {1.55, 1.30, 91.0},
                                         {-0.10, -2.60, 93.0}, {2.30, 1.45, -4.0}};

Eigen::Isometry3d onto(const House& house)
{
    Eigen::Isometry3d move(Eigen::Translation3d(house.place.x(), house.place.y(), 0.0));
    move.rotate(Eigen::AngleAxisd(house.turn_deg * kDegree, Eigen::Vector3d::UnitZ()));
    return move;
}

/// Adds the walls, including the triangles under the ridge, around the origin.
void add_gabled_walls(PartBuilder& builder, const House& house, const Paint& paint)
{
    const Eigen::Vector3d half = 0.5 * house.size;
    builder.begin_part(paint);
    std::array<std::array<std::uint32_t, 5>, 2> ends;
    for (int i = 0; i < 2; ++i) {
        const double x = i == 0 ? -half.x() : half.x();
        ends[i] = {builder.vertex({x, -half.y(), 0.0}), builder.vertex({x, half.y(), 0.0}),
                   builder.vertex({x, half.y(), house.size.z()}),
                   builder.vertex({x, 0.0, house.size.z() + house.gable}),
                   builder.vertex({x, -half.y(), house.size.z()})};
    }
    const auto& [near, far] = ends;
    builder.quad({near[0], near[4], near[2], near[1]});
    builder.triangle(near[4], near[3], near[2]);
    builder.quad({far[0], far[1], far[2], far[4]});
    builder.triangle(far[4], far[2], far[3]);
    for (int k = 0; k < 5; ++k) {
        const int next = (k + 1) % 5;
        builder.quad({near[k], near[next], far[next], far[k]});
    }
}

/// Adds two slabs that meet at the ridge and overhang the walls, and a chimney.
void add_gabled_roof(PartBuilder& builder, const House& house, const Paint& paint)
{
    constexpr double kThickness = 0.04;
    constexpr double kOver = 0.06;
    const double slope = std::atan2(house.gable, 0.5 * house.size.y());
    const double reach = std::hypot(house.gable, 0.5 * house.size.y()) + kOver;
    for (const double side : {-1.0, 1.0}) {
        add_box(builder,
                {{0.0, 0.5 * side * reach, -0.01}, {house.size.x() + kOver, reach, kThickness}},
                paint);
        Eigen::Isometry3d move = onto(house);
        move.translate(Eigen::Vector3d(0.0, 0.0, house.size.z() + house.gable));
        move.rotate(Eigen::AngleAxisd(-side * slope, Eigen::Vector3d::UnitX()));
        builder.move_part(move);
    }
    const double ridge = house.size.z() + house.gable;
    add_box(builder, {{0.25 * house.size.x(), 0.08, ridge - 0.2}, {0.10, 0.10, 0.34}},
            {{0.72F, 0.42F, 0.36F}});
    builder.move_part(onto(house));
}

/// Adds a slab with a low rim and a hut.
void add_flat_roof(PartBuilder& builder, const House& house, const Paint& paint)
{
    constexpr double kRim = 0.05;
    const Eigen::Vector3d& size = house.size;
    add_box(builder, {{0.0, 0.0, size.z() - 0.02}, {size.x(), size.y(), 0.04}}, paint);
    builder.move_part(onto(house));
    for (const double side : {-0.5, 0.5}) {
        add_box(builder, {{side * (size.x() - kRim), 0.0, size.z()}, {kRim, size.y(), 0.07}},
                paint);
        builder.move_part(onto(house));
        add_box(builder, {{0.0, side * (size.y() - kRim), size.z()}, {size.x(), kRim, 0.07}},
                paint);
        builder.move_part(onto(house));
    }
    add_box(builder, {{-0.15, 0.12, size.z()}, {0.24, 0.20, 0.16}}, {{0.70F, 0.70F, 0.74F}});
    builder.move_part(onto(house));
}

void add_house(PartBuilder& builder, const House& house, int number)
{
    const auto shade = static_cast<float>(0.03 * (number % 5));
    const Paint walls{{0.94F - shade, 0.90F - shade, 0.80F}, house.wall_contrast};
    if (house.gable > 0.0) {
        add_gabled_walls(builder, house, walls);
        builder.move_part(onto(house));
        add_gabled_roof(builder, house, {{0.86F, 0.50F + shade, 0.40F}});
        return;
    }
    add_box(builder, {{0.0, 0.0, 0.0}, house.size}, walls);
    builder.move_part(onto(house));
    add_flat_roof(builder, house, {{0.66F + shade, 0.68F, 0.72F}});
}

void add_tree(PartBuilder& builder, const Eigen::Vector2d& place, double radius)
{
    const double trunk = 1.1 * radius;
    add_column(builder, {{place.x(), place.y(), 0.0}, 0.03, 0.02, trunk + 0.2 * radius},
               {{0.56F, 0.46F, 0.36F}});
    const auto crown = [&](const Eigen::Vector3d& way) {
        const double bumps = std::sin(7.0 * way.x() + 9.0 * place.x()) * std::sin(6.0 * way.y()) +
                             0.6 * std::cos(9.0 * way.z() + 5.0 * place.y());
        return radius * (1.0 + 0.12 * bumps);
    };
    add_blob(builder, {place.x(), place.y(), trunk + 0.8 * radius}, crown, {{0.48F, 0.72F, 0.40F}});
}

/// Adds trees, a free-standing wall and cars.
void add_streets(PartBuilder& builder)
{
    for (const Eigen::Vector3d& tree : kTrees) {
        add_tree(builder, tree.head<2>(), tree.z());
    }
    add_box(builder, {{-0.65, 1.45, 0.0}, {1.3, 0.05, 0.22}, 4.0}, {{0.80F, 0.76F, 0.70F}});
    for (const Eigen::Vector3d& car : kCars) {
        add_box(builder, {{car.x(), car.y(), 0.03}, {0.34, 0.15, 0.07}, car.z()},
                {{0.86F, 0.36F, 0.34F}});
        add_box(builder, {{car.x(), car.y(), 0.10}, {0.18, 0.14, 0.06}, car.z()},
                {{0.40F, 0.44F, 0.50F}});
    }
}

/// A grid of nadir views, then a ring of oblique views.
void add_flight(std::vector<Pinhole>& views)
{
    const Lens lens{960, 720, 760.0};
    for (int row = -2; row <= 2; ++row) {
        for (int column = -2; column <= 2; ++column) {
            const Eigen::Vector3d center(1.15 * column, 1.05 * row, 4.3 + 0.05 * column);
            views.push_back(looking_at(lens, center, {center.x(), center.y() + 0.04, 0.0}));
        }
    }
    constexpr int kAskew = 22;
    for (int i = 0; i < kAskew; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * i / kAskew;
        const Eigen::Vector3d out(std::cos(turn_rad), std::sin(turn_rad), 0.0);
        const Eigen::Vector3d target = (i % 2 == 0 ? 0.2 : 0.9) * out;
        views.push_back(looking_at(lens, target + 3.2 * out + Eigen::Vector3d(0.0, 0.0, 3.5),
                                   target + Eigen::Vector3d(0.0, 0.0, 0.2)));
    }
}

} // namespace

PhotoScene city()
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.0, -0.1}, {11.0, 10.6, 0.1}}, {{0.66F, 0.66F, 0.62F}});
    for (std::size_t i = 0; i < kHouses.size(); ++i) {
        add_house(builder, kHouses[i], static_cast<int>(i));
    }
    add_streets(builder);
    PhotoScene scene;
    scene.parts = builder.take();
    add_flight(scene.views);
    scene.pair_reach = 3.0;
    scene.frame = {12.0, turned(0.4, {0.1, -0.1, 1.0}), {2400.0, -1300.0, 85.0}};
    return scene;
}

} // namespace vcarve::render
