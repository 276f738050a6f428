#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kHalfX = 5.5;
constexpr double kHalfY = 3.5;
constexpr double kHeight = 4.2;
constexpr double kWall = 0.25;
constexpr double kGallery = 2.0; ///< height of the floor of the gallery
const Eigen::Array3f kStone(0.84F, 0.80F, 0.72F);

/// Adds a wall along x with deep niches, facing -y, turned about the center of the hall.
void add_wall(PartBuilder& builder, double width, const Eigen::Vector2d& turn_and_reach,
              const Eigen::Array3f& tint)
{
    const auto niche = [](std::size_t i, std::size_t k) {
        return i % 2 == 1 && k == 1 ? 0.18 : 0.0;
    };
    std::vector<double> x{-0.5 * width};
    for (const double share : {-0.32, -0.18, 0.22, 0.36, 0.5}) {
        x.push_back(share * width);
    }
    add_board(builder, {x, {0.0, 0.9, 2.9, kHeight}, kWall, niche}, {tint, 1.0, 1.3});
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.rotate(Eigen::AngleAxisd(turn_and_reach[0], Eigen::Vector3d::UnitZ()));
    move.translate(Eigen::Vector3d(0.0, turn_and_reach[1], 0.0));
    builder.move_part(move);
}

/// Adds the floor and four walls, without a ceiling.
void add_shell(PartBuilder& builder)
{
    const double wide = 2.0 * (kHalfX + kWall);
    const double deep = 2.0 * (kHalfY + kWall);
    add_box(builder, {{0.0, 0.0, -kWall}, {wide, deep, kWall}}, {{0.68F, 0.60F, 0.52F}, 1.0, 1.3});
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    add_wall(builder, wide, {0.0, kHalfY}, {0.86F, 0.80F, 0.68F});
    add_wall(builder, deep, {kQuarter, kHalfX}, {0.76F, 0.82F, 0.80F});
    add_wall(builder, wide, {2.0 * kQuarter, kHalfY}, {0.84F, 0.76F, 0.78F});
    add_wall(builder, deep, {3.0 * kQuarter, kHalfX}, {0.78F, 0.80F, 0.70F});
}

/// Adds two rows of columns with plinths and capitals.
void add_columns(PartBuilder& builder)
{
    for (const double x : {-3.4, -1.2, 1.0, 3.2}) {
        for (const double y : {-1.9, 1.9}) {
            add_box(builder, {{x, y, 0.0}, {0.50, 0.50, 0.22}}, {kStone});
            add_column(builder, {{x, y, 0.22}, 0.19, 0.16, kHeight - 0.52}, {kStone});
            add_box(builder, {{x, y, kHeight - 0.30}, {0.44, 0.44, 0.30}}, {kStone});
        }
    }
}

/// Adds a gallery with a railing, halfway up the wall at +x.
void add_gallery(PartBuilder& builder)
{
    constexpr double kEdge = 4.2;
    constexpr double kThickness = 0.14;
    const double middle = 0.5 * (kEdge + kHalfX);
    add_box(builder,
            {{middle, 0.0, kGallery - kThickness}, {kHalfX - kEdge, 2.0 * kHalfY, kThickness}},
            {{0.72F, 0.58F, 0.44F}});
    for (const double y : {-2.4, -0.4, 1.6}) {
        add_column(builder, {{kEdge + 0.15, y, 0.0}, 0.08, 0.08, kGallery - 0.1}, {kStone});
    }
    const Paint iron{{0.52F, 0.54F, 0.60F}};
    constexpr double kRailEnd = 2.3; // the stairs end beyond it
    const double x = kEdge + 0.06;
    for (const double z : {0.5, 1.0}) {
        add_bar(builder, {{x, -kHalfY, kGallery + z}, {x, kRailEnd, kGallery + z}, 0.05}, iron);
    }
    for (double y = -3.3; y <= kRailEnd; y += 0.55) {
        add_bar(builder, {{x, y, kGallery - 0.05}, {x, y, kGallery + 1.0}, 0.04}, iron);
    }
}

/// Adds stairs along the wall at +y, up to the gallery.
void add_stairs(PartBuilder& builder)
{
    constexpr int kSteps = 9;
    constexpr double kTread = 0.30;
    const Paint paint{{0.80F, 0.74F, 0.66F}};
    for (int i = 0; i < kSteps; ++i) {
        const double x = 4.2 - kTread * (kSteps - 0.5 - i);
        add_box(builder, {{x, 3.0, 0.0}, {kTread, 1.0, kGallery * (i + 1) / (kSteps + 1)}}, paint);
    }
}

void add_crates(PartBuilder& builder)
{
    const Eigen::Array3f wood(0.82F, 0.64F, 0.42F);
    add_box(builder, {{-4.6, -2.6, 0.0}, {0.9, 0.8, 0.7}, 8.0}, {wood});
    add_box(builder, {{-4.7, -2.6, 0.7}, {0.6, 0.6, 0.5}, -15.0}, {wood});
    add_box(builder, {{-3.7, -2.9, 0.0}, {0.6, 0.6, 0.5}, 25.0}, {{0.60F, 0.70F, 0.80F}});
    add_box(builder, {{-4.8, 0.6, 0.0}, {0.5, 1.9, 0.42}, 2.0}, {{0.62F, 0.50F, 0.44F}}); // bench
    add_box(builder, {{0.0, -3.0, 0.0}, {1.6, 0.5, 0.45}, -3.0}, {{0.62F, 0.50F, 0.44F}});
    add_column(builder, {{-4.9, 2.8, 0.0}, 0.35, 0.35, 0.9}, {{0.50F, 0.64F, 0.76F}}); // barrels
    add_column(builder, {{-4.1, 3.0, 0.0}, 0.35, 0.35, 0.9}, {{0.76F, 0.50F, 0.46F}});
    add_box(builder, {{-0.1, 0.1, 0.0}, {1.3, 0.9, 0.35}, 12.0}, {kStone}); // in the middle
    add_sphere(builder, {-0.1, 0.1, 0.75}, 0.42, {{0.86F, 0.70F, 0.56F}});
    add_box(builder, {{4.9, -2.3, kGallery}, {0.5, 0.5, 0.4}, 30.0}, {wood});
    add_box(builder, {{2.3, -2.9, 0.0}, {0.8, 0.7, 1.1}, -20.0}, {{0.70F, 0.76F, 0.52F}});
}

/// A path between columns and center: first looking outward, then across. Then a path along the
/// gallery.
void walk(std::vector<Pinhole>& views)
{
    const Lens lens{960, 720, 600.0};
    constexpr int kAround = 20;
    for (int i = 0; i < kAround; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * i / kAround;
        const Eigen::Vector3d out(std::cos(turn_rad), std::sin(turn_rad), 0.0);
        const Eigen::Vector3d center(2.6 * out.x(), 1.1 * out.y(), 1.5);
        views.push_back(looking_at(lens, center, center + out + Eigen::Vector3d(0.0, 0.0, 0.05)));
        const Eigen::Vector3d aside(3.6 * out.x(), 2.5 * out.y(), i % 2 == 0 ? 1.4 : 1.7);
        const Eigen::Vector3d target(-1.2 * out.x(), -0.8 * out.y(), 1.2);
        views.push_back(looking_at(lens, aside, target));
    }
    for (int i = 0; i < 7; ++i) {
        const double y = -2.4 + 0.8 * i;
        views.push_back(looking_at(lens, {4.9, y, kGallery + 1.5}, {-1.0, 0.3 * y, 0.8}));
    }
}

} // namespace

PhotoScene hall()
{
    PartBuilder builder;
    add_shell(builder);
    add_columns(builder);
    add_gallery(builder);
    add_stairs(builder);
    add_crates(builder);
    PhotoScene scene;
    scene.parts = builder.take();
    walk(scene.views);
    scene.grain.noise = 6.0;
    scene.frame = {2.0, turned(2.3, {0.5, 0.5, -0.6}), {-30.0, 14.0, 9.0}};
    return scene;
}

} // namespace vcarve::render
