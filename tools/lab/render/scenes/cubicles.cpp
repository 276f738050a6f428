#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSide = 1.9;      ///< of a cubicle
constexpr double kAisle = 1.4;     ///< between the two rows
constexpr double kPartition = 1.3; ///< height
constexpr double kThin = 0.045;
const std::array kMiddles{-kSide, 0.0, kSide}; ///< centers of the cubicles of a row, along x

Paint cloth(bool plain, const Eigen::Array3f& tint)
{
    return {tint, plain ? 0.0 : 0.9};
}

/// The furniture of a cubicle around the center of its floor, open towards -y, then moved.
class Cubicle {
  public:
    Cubicle(PartBuilder& builder, const Eigen::Isometry3d& move) : builder_(builder), move_(move) {}

    void add_desk(const Paint& paint)
    {
        box({{0.0, 0.55, 0.70}, {1.7, 0.65, 0.035}}, paint);
        for (const double x : {-0.82, 0.82}) {
            box({{x, 0.55, 0.0}, {0.04, 0.6, 0.70}}, paint);
        }
        box({{0.58, 0.52, 0.0}, {0.40, 0.50, 0.58}}, {{0.62F, 0.64F, 0.68F}});          // drawers
        box({{-0.60, 0.50, 0.735}, {0.22, 0.30, 0.05}, 14.0}, {{0.90F, 0.88F, 0.80F}}); // papers
        column({{0.62, 0.42, 0.735}, 0.04, 0.045, 0.11}, {{0.86F, 0.44F, 0.38F}});      // mug
    }

    void add_screen(double x, double turn_deg, double contrast)
    {
        const Paint gray{{0.46F, 0.47F, 0.50F}, 0.5};
        column({{x, 0.68, 0.735}, 0.12, 0.12, 0.015}, gray);
        box({{x, 0.69, 0.74}, {0.05, 0.03, 0.22}, turn_deg}, gray);
        box({{x, 0.66, 0.86}, {0.58, 0.03, 0.36}, turn_deg}, {{0.40F, 0.52F, 0.70F}, contrast});
    }

    void add_chair(const Eigen::Vector2d& place, double turn_deg, const Paint& paint)
    {
        const double x = place.x();
        const double y = place.y();
        const Paint black{{0.42F, 0.42F, 0.46F}, 0.6};
        for (int i = 0; i < 5; ++i) {
            const double turn_rad = (turn_deg + 72.0 * i) * kDegree;
            bar({{x, y, 0.07},
                 {x + 0.28 * std::cos(turn_rad), y + 0.28 * std::sin(turn_rad), 0.03},
                 0.035},
                black);
        }
        column({{x, y, 0.05}, 0.03, 0.03, 0.38}, black);
        box({{x, y, 0.42}, {0.46, 0.46, 0.07}, turn_deg}, paint);
        const Eigen::Vector2d back = place + 0.22 * Eigen::Vector2d(std::sin(turn_deg * kDegree),
                                                                    -std::cos(turn_deg * kDegree));
        bar({{back.x(), back.y(), 0.44}, {back.x(), back.y(), 0.66}, 0.04}, black);
        box({{back.x(), back.y(), 0.62}, {0.42, 0.05, 0.40}, turn_deg}, paint);
    }

    void add_shelf()
    {
        box({{-0.55, 0.83, 1.05}, {0.6, 0.2, 0.03}}, {{0.74F, 0.62F, 0.48F}});
        box({{-0.65, 0.83, 1.08}, {0.3, 0.16, 0.17}}, {{0.80F, 0.46F, 0.42F}});
    }

  private:
    void box(const StandingBox& box, const Paint& paint)
    {
        add_box(builder_, box, paint);
        builder_.move_part(move_);
    }
    void column(const Column& column, const Paint& paint)
    {
        add_column(builder_, column, paint);
        builder_.move_part(move_);
    }
    void bar(const Bar& bar, const Paint& paint)
    {
        add_bar(builder_, bar, paint);
        builder_.move_part(move_);
    }

    PartBuilder& builder_;
    Eigen::Isometry3d move_;
};

/// Adds partitions between and behind the cubicles of a row, and half as wide in front of them.
void add_partitions(PartBuilder& builder, double side)
{
    const Eigen::Array3f blue(0.62F, 0.72F, 0.84F);
    const Eigen::Array3f sand(0.86F, 0.80F, 0.68F);
    const double front = 0.5 * kAisle;
    for (int i = 0; i < 4; ++i) {
        const double x = (i - 1.5) * kSide;
        add_box(builder, {{x, side * (front + 0.5 * kSide), 0.0}, {kThin, kSide, kPartition}},
                cloth(i == 1 || (i == 3 && side > 0.0), blue));
    }
    for (std::size_t i = 0; i < kMiddles.size(); ++i) {
        const bool plain = (i == 2) == (side > 0.0);
        add_box(builder, {{kMiddles[i], side * (front + kSide), 0.0}, {kSide, kThin, kPartition}},
                cloth(plain, sand));
        add_box(
            builder,
            {{kMiddles[i] - 0.28 * kSide, side * front, 0.0}, {0.44 * kSide, kThin, kPartition}},
            cloth(i == 0, sand));
    }
}

void add_cubicle(PartBuilder& builder, double x, double side)
{
    Eigen::Isometry3d move(Eigen::Translation3d(x, 0.5 * side * (kAisle + kSide), 0.0));
    if (side < 0.0) move.rotate(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
    const double turn_deg = 25.0 * x + 30.0 * side;
    Cubicle cubicle(builder, move);
    cubicle.add_desk({{0.84F, 0.74F, 0.58F}, x > 0.0 ? 0.9 : 0.5});
    cubicle.add_screen(-0.10, 8.0 * side + 3.0 * x, x == 0.0 ? 0.0 : 0.8);
    if (x * side > 0.0) cubicle.add_screen(0.52, -18.0, 0.0);
    cubicle.add_chair({0.1 * x, -0.05 + 0.1 * side}, turn_deg, {{0.50F, 0.62F, 0.56F}, 0.8});
    if (x >= 0.0) cubicle.add_shelf();
}

/// Adds a carpet, two outer walls with windows, and other furniture.
void add_office(PartBuilder& builder)
{
    add_box(builder, {{0.0, 0.0, -0.1}, {9.6, 9.2, 0.1}}, {{0.58F, 0.60F, 0.66F}});
    const auto window = [](std::size_t i, std::size_t k) {
        return i % 2 == 1 && k == 1 ? 0.1 : 0.0;
    };
    const Board wall{
        {-4.7, -3.6, -1.8, -0.9, 0.9, 1.8, 3.6, 4.7}, {0.0, 0.9, 2.1, 2.5}, 0.2, window};
    add_board(builder, wall, {{0.88F, 0.86F, 0.80F}, 0.7});
    builder.move_part(Eigen::Isometry3d(Eigen::Translation3d(0.0, 4.5, 0.0)));
    add_board(builder, wall, {{0.80F, 0.86F, 0.84F}, 0.7});
    Eigen::Isometry3d move(Eigen::Translation3d(-4.7, 0.0, 0.0));
    move.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
    builder.move_part(move);
    add_box(builder, {{3.35, 1.2, 0.0}, {0.45, 0.9, 1.1}}, {{0.70F, 0.72F, 0.74F}}); // cabinet
    add_box(builder, {{3.30, -1.6, 0.0}, {0.5, 0.5, 0.95}, 6.0}, {{0.86F, 0.86F, 0.84F}, 0.3});
    add_column(builder, {{-3.3, -0.5, 0.0}, 0.15, 0.19, 0.35}, {{0.70F, 0.48F, 0.38F}}); // plant
    const auto leaves = [](const Eigen::Vector3d& way) {
        return 0.32 *
               (1.0 + 0.3 * std::sin(6.0 * way.x()) * std::sin(7.0 * way.y() + 2.0 * way.z()));
    };
    add_blob(builder, {-3.3, -0.5, 0.65}, leaves, {{0.44F, 0.68F, 0.40F}});
}

/// Views around the block, over the partitions, and from the aisle into both rows.
void walk(std::vector<Pinhole>& views)
{
    const Lens lens{960, 720, 620.0};
    constexpr int kRound = 24;
    for (int i = 0; i < kRound; ++i) {
        const double turn_rad = 2.0 * std::numbers::pi * i / kRound;
        const Eigen::Vector3d out(std::cos(turn_rad), std::sin(turn_rad), 0.0);
        views.push_back(looking_at(lens, {4.1 * out.x(), 3.7 * out.y(), i % 2 == 0 ? 1.6 : 1.85},
                                   {0.9 * out.x(), 0.6 * out.y(), 0.75}));
    }
    for (int i = 0; i < 8; ++i) {
        const double x = -2.8 + 0.8 * i;
        for (const double side : {-1.0, 1.0}) {
            views.push_back(looking_at(lens, {x, -0.45 * side, 1.65}, {0.9 * x, 1.7 * side, 0.75}));
        }
    }
    for (int i = 0; i < 6; ++i) {
        const double way = i % 2 == 0 ? 1.0 : -1.0;
        const double x = way * (-3.2 + 0.5 * i);
        views.push_back(looking_at(lens, {x, 0.1 * (i - 3), 1.7}, {x + 2.5 * way, 0.0, 0.9}));
    }
}

} // namespace

PhotoScene cubicles()
{
    PartBuilder builder;
    add_office(builder);
    for (const double side : {-1.0, 1.0}) {
        add_partitions(builder, side);
        for (const double x : kMiddles) {
            add_cubicle(builder, x, side);
        }
    }
    PhotoScene scene;
    scene.parts = builder.take();
    walk(scene.views);
    scene.frame = {0.1, turned(0.7, {-0.8, 0.2, 0.4}), {1.0, 0.5, -0.3}};
    return scene;
}

} // namespace vcarve::render
