#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

namespace vcarve::render {

namespace {

constexpr double kWindowDepth = 0.13;
constexpr double kDoorDepth = 0.22;
const std::vector<double> kColumns{-2.1, -1.7, -1.2, -0.75, -0.25, 0.25, 0.75, 1.2, 1.7, 2.1};
const std::vector<double> kRows{0.0, 0.1, 0.35, 0.95, 1.25, 1.8, 2.1, 2.6, 2.9};

/// Windows in every other column and row, and a door below the middle ones.
double recess(std::size_t column, std::size_t row)
{
    if (column == 4 && row >= 1 && row <= 2) return kDoorDepth;
    if (column % 2 == 1 && row % 2 == 0 && row >= 2 && row <= 6) return kWindowDepth;
    if (column == 4 && row == 6) return kWindowDepth;
    return 0.0;
}

void add_window_fittings(PartBuilder& builder, std::size_t column, std::size_t row)
{
    const Eigen::Array3f white(0.92F, 0.92F, 0.88F);
    const double x = 0.5 * (kColumns[column] + kColumns[column + 1]);
    const double width = kColumns[column + 1] - kColumns[column];
    const double low = kRows[row];
    const double height = kRows[row + 1] - low;
    // The cross is in front of the pane, and the sill protrudes from the wall.
    add_box(builder, {{x, kWindowDepth - 0.02, low}, {0.04, 0.04, height}}, {white});
    add_box(builder, {{x, kWindowDepth - 0.02, low + 0.6 * height}, {width, 0.04, 0.04}}, {white});
    add_box(builder, {{x, -0.03, low - 0.05}, {width + 0.12, 0.14, 0.05}}, {{0.7F, 0.7F, 0.72F}});
}

void add_porch(PartBuilder& builder)
{
    const Eigen::Array3f stone(0.84F, 0.82F, 0.76F);
    add_box(builder, {{0.0, -0.25, 0.0}, {1.1, 0.5, 0.1}}, {stone}); // step
    for (const double x : {-0.42, 0.42}) {
        add_box(builder, {{x, -0.38, 0.1}, {0.16, 0.16, 0.06}}, {stone});
        add_column(builder, {{x, -0.38, 0.16}, 0.065, 0.055, 0.82}, {stone});
        add_box(builder, {{x, -0.38, 0.98}, {0.16, 0.16, 0.05}}, {stone});
    }
    add_box(builder, {{0.0, -0.23, 1.03}, {1.15, 0.5, 0.1}}, {stone}); // roof
}

Parts house_front()
{
    PartBuilder builder;
    add_box(builder, {{0.0, -0.2, -0.08}, {4.8, 1.2, 0.08}}, {{0.62F, 0.62F, 0.64F}}); // street
    add_board(builder, {kColumns, kRows, 0.4, recess}, {{0.86F, 0.70F, 0.52F}});
    for (std::size_t column = 0; column + 1 < kColumns.size(); ++column) {
        for (std::size_t row = 2; row + 1 < kRows.size(); ++row) {
            if (recess(column, row) == kWindowDepth) add_window_fittings(builder, column, row);
        }
    }
    add_box(builder, {{0.0, 0.1, 2.9}, {4.4, 0.6, 0.12}}, {{0.80F, 0.80F, 0.82F}}); // cornice
    add_box(builder, {{0.0, -0.02, 1.05}, {4.2, 0.08, 0.06}}, {{0.80F, 0.80F, 0.82F}});
    for (const double x : {-2.02, 2.02}) {
        add_column(builder, {{x, -0.06, 0.0}, 0.08, 0.08, 2.9}, {{0.72F, 0.76F, 0.80F}});
    }
    add_porch(builder);
    add_box(builder, {{-1.45, -0.6, 0.0}, {0.7, 0.25, 0.3}, 8.0}, {{0.46F, 0.66F, 0.42F}});
    add_column(builder, {{1.5, -0.7, 0.0}, 0.04, 0.04, 1.5}, {{0.44F, 0.46F, 0.50F}}); // lamp post
    add_sphere(builder, {1.5, -0.7, 1.58}, 0.11, {{0.94F, 0.90F, 0.70F}});
    return builder.take();
}

} // namespace

PhotoScene facade()
{
    PhotoScene scene;
    scene.parts = house_front();
    const Lens lens{1000, 750, 700.0};
    for (int i = 0; i < 15; ++i) {
        const double x = -2.8 + 0.4 * i;
        const Eigen::Vector3d low(x, -3.0 + 0.08 * x * x, 0.55);
        const Eigen::Vector3d high(x + 0.2, -2.8 + 0.08 * x * x, 1.7);
        scene.views.push_back(looking_at(lens, low, {0.45 * x, 0.0, 1.25}));
        scene.views.push_back(looking_at(lens, high, {0.45 * x, 0.0, 1.15}));
    }
    scene.frame = {3.5, turned(0.9, {0.1, 0.2, 1.0}), {120.0, 45.0, 310.0}};
    return scene;
}

} // namespace vcarve::render
