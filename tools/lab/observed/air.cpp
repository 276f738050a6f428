#include "observed/observe.h"
#include "render/raster.h"
#include "render/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace vcarve::observed {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using render::PartBuilder;

constexpr double kHalfSide = 20.0;

double ground_height(double x, double y)
{
    return 1.4 * std::sin(0.11 * x + 0.5) * std::cos(0.13 * y - 0.3) + 0.5 * std::sin(0.31 * y);
}

void add_ground(PartBuilder& builder)
{
    constexpr int kSteps = 24;
    builder.begin_part({{0.42F, 0.56F, 0.30F}});
    const std::uint32_t first = builder.next_vertex();
    for (int i = 0; i <= kSteps; ++i) {
        for (int k = 0; k <= kSteps; ++k) {
            const double x = kHalfSide * (2.0 * i / kSteps - 1.0);
            const double y = kHalfSide * (2.0 * k / kSteps - 1.0);
            builder.vertex({x, y, ground_height(x, y)});
        }
    }
    const auto at = [&](int i, int k) { return first + i * (kSteps + 1) + k; };
    for (int i = 0; i < kSteps; ++i) {
        for (int k = 0; k < kSteps; ++k) {
            builder.quad({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    }
}

/// A house of plain walls under a roof of tiles.
struct House {
    Vector2d place;
    double turn_deg;
    Vector3d size;       ///< of the walls above the ground
    double gable;        ///< height of the ridge, along x, above the walls; 0 for a flat roof
    double contrast = 0; ///< of the walls
};

const std::array kHouses{House{{-12.0, -11.0}, 12.0, {9.0, 6.5, 4.0}, 2.6},
                         House{{2.0, -12.5}, -8.0, {8.0, 8.0, 8.5}, 0.0},
                         House{{13.0, -9.0}, 80.0, {8.5, 6.0, 3.8}, 2.4},
                         House{{-12.5, 3.5}, 95.0, {9.5, 6.0, 4.5}, 2.2, 0.5},
                         House{{10.5, 5.5}, 5.0, {10.0, 7.0, 5.5}, 2.8},
                         House{{-2.0, 13.5}, -15.0, {9.0, 5.5, 3.6}, 2.5}};

/// A corner of a gabled house: `end` is -1 or 1 along x, `around` 0 to 4, where 3 is the ridge.
Vector3d corner(const House& house, double end, int around)
{
    constexpr double kCellar = -3.0; // walls reach below the ground everywhere
    const Vector3d half = 0.5 * house.size;
    const double x = end * half.x();
    const std::array<Vector3d, 5> corners{Vector3d{x, -half.y(), kCellar},
                                          {x, half.y(), kCellar},
                                          {x, half.y(), house.size.z()},
                                          {x, 0.0, house.size.z() + house.gable},
                                          {x, -half.y(), house.size.z()}};
    return corners.at(around);
}

void add_quad(PartBuilder& builder, const std::array<Vector3d, 4>& corners)
{
    std::array<std::uint32_t, 4> v{};
    for (int i = 0; i < 4; ++i) {
        v[i] = builder.vertex(corners[i]);
    }
    builder.quad(v);
}

void add_triangle(PartBuilder& builder, const std::array<Vector3d, 3>& corners)
{
    const auto& [a, b, c] = corners;
    const std::uint32_t first = builder.vertex(a);
    builder.vertex(b);
    builder.triangle(first, first + 1, builder.vertex(c));
}

/// Adds the side of the house between two of its edges along x.
void add_side(PartBuilder& builder, const House& house, int from, int to)
{
    add_quad(builder, {corner(house, -1, from), corner(house, -1, to), corner(house, 1, to),
                       corner(house, 1, from)});
}

void add_house(PartBuilder& builder, const House& house)
{
    const double ground = ground_height(house.place.x(), house.place.y());
    Eigen::Isometry3d move(Eigen::Translation3d(house.place.x(), house.place.y(), ground));
    move.rotate(Eigen::AngleAxisd(house.turn_deg * std::numbers::pi / 180.0, Vector3d::UnitZ()));
    builder.begin_part({{0.92F, 0.90F, 0.84F}, house.contrast});
    for (const double end : {-1.0, 1.0}) {
        const auto at = [&](int around) { return corner(house, end, around); };
        if (end < 0) {
            add_quad(builder, {at(0), at(4), at(2), at(1)});
            if (house.gable > 0.0) add_triangle(builder, {at(4), at(3), at(2)});
        } else {
            add_quad(builder, {at(0), at(1), at(2), at(4)});
            if (house.gable > 0.0) add_triangle(builder, {at(4), at(2), at(3)});
        }
    }
    add_side(builder, house, 1, 2);
    add_side(builder, house, 4, 0);
    builder.move_part(move);
    builder.begin_part({{0.62F, 0.30F, 0.22F}});
    add_side(builder, house, 2, 3);
    add_side(builder, house, 3, 4);
    builder.move_part(move);
}

void add_trees_and_a_wall(PartBuilder& builder)
{
    const std::array<Vector3d, 5> trees{Vector3d{-4.0, -5.0, 1.3},
                                        {3.0, 0.5, 1.6},
                                        {-4.5, 6.0, 1.4},
                                        {16.0, 14.0, 1.7},
                                        {-16.0, 13.0, 1.5}}; // positions and radii
    for (const Vector3d& tree : trees) {
        const double ground = ground_height(tree.x(), tree.y());
        render::add_column(builder,
                           {{tree.x(), tree.y(), ground - 0.5}, tree.z(), 0.2, 3.4 * tree.z()},
                           {{0.26F, 0.42F, 0.20F}, 1.5});
    }
    render::add_box(builder, {{4.0, 16.0, -2.0}, {10.0, 0.5, 5.0}, 8.0}, {{0.6F, 0.58F, 0.55F}});
}

/// Strips of nadir views, then a ring of oblique views.
void add_flight(std::vector<render::Pinhole>& views)
{
    const render::Lens lens{1000, 750, 900.0};
    constexpr double kHeight = 27.0;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 5; ++column) {
            const Vector3d center(8.0 * (column - 2), 9.0 * (row - 1.5), kHeight + 0.3 * column);
            views.push_back(looking_at(lens, center, {center.x(), center.y() + 0.4, 0.0}));
        }
    }
    render::add_arc(views, lens, {{0.0, 0.0, 1.0}, 24.0, 20.0, 15.0, 30.0, 12});
}

} // namespace

ObservedScene from_the_air()
{
    PartBuilder builder;
    add_ground(builder);
    for (const House& house : kHouses) {
        add_house(builder, house);
    }
    add_trees_and_a_wall(builder);
    ObservedScene scene{.name = "air", .parts = builder.take(), .views = {}, .points = 2000};
    add_flight(scene.views);
    return scene;
}

} // namespace vcarve::observed
