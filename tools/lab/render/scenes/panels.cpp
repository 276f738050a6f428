#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

#include <numbers>

namespace vcarve::render {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// An upright board on the floor, with columns x rows windows.
struct Panel {
    double x, y;
    double turn_deg;
    double lean_deg;
    double width, height, thickness;
    int columns = 0;
    int rows = 0;
};

/// The bounds of `count` equal windows between low and high, and of the bars around them.
std::vector<double> bars(double low, double high, int count)
{
    constexpr double kBarToWindow = 0.4;
    const double window = (high - low) / (count + kBarToWindow * (count + 1));
    std::vector<double> result{low};
    for (int i = 0; i < count; ++i) {
        result.push_back(result.back() + kBarToWindow * window);
        result.push_back(result.back() + window);
    }
    result.push_back(high);
    return result;
}

void add_panel(PartBuilder& builder, const Panel& panel, const Paint& paint)
{
    const auto recess = [&](std::size_t i, std::size_t k) {
        return i % 2 == 1 && k % 2 == 1 ? panel.thickness : 0.0;
    };
    add_board(builder,
              {bars(-panel.width / 2, panel.width / 2, panel.columns),
               bars(0.0, panel.height, panel.rows), panel.thickness, recess},
              paint);
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translate(Eigen::Vector3d(panel.x, panel.y, 0.0));
    move.rotate(Eigen::AngleAxisd(panel.turn_deg * kDegree, Eigen::Vector3d::UnitZ()));
    move.rotate(Eigen::AngleAxisd(-panel.lean_deg * kDegree, Eigen::Vector3d::UnitX()));
    builder.move_part(move);
}

} // namespace

PhotoScene panels()
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.0, -0.05}, {3.2, 3.2, 0.05}}, {{0.70F, 0.72F, 0.78F}});
    add_panel(builder, {0.0, 0.0, 15.0, 0.0, 0.9, 0.8, 0.030}, {{0.88F, 0.56F, 0.40F}});
    add_panel(builder, {-0.75, -0.35, 70.0, 0.0, 0.8, 0.6, 0.022, 1, 1}, {{0.50F, 0.74F, 0.84F}});
    add_panel(builder, {0.70, -0.55, -40.0, 12.0, 0.7, 0.7, 0.025}, {{0.84F, 0.80F, 0.46F}});
    add_panel(builder, {0.85, 0.45, 100.0, 0.0, 0.9, 0.9, 0.035, 2, 2}, {{0.66F, 0.54F, 0.82F}});
    add_panel(builder, {-0.10, 0.85, -10.0, 0.0, 1.0, 0.7, 0.022, 3, 1}, {{0.52F, 0.80F, 0.56F}});
    add_panel(builder, {-0.95, 0.55, -55.0, 18.0, 0.6, 0.8, 0.040}, {{0.90F, 0.64F, 0.70F}});
    add_panel(builder, {-0.20, -0.85, -70.0, 0.0, 0.5, 0.45, 0.022}, {{0.80F, 0.70F, 0.60F}});
    add_panel(builder, {0.15, -1.15, 5.0, 8.0, 0.6, 0.35, 0.025, 2, 1}, {{0.60F, 0.84F, 0.80F}});
    add_panel(builder, {-1.20, 0.05, 95.0, 0.0, 0.5, 0.9, 0.030}, {{0.86F, 0.60F, 0.50F}});
    add_panel(builder, {0.45, 1.15, 50.0, 0.0, 0.5, 0.5, 0.025}, {{0.74F, 0.78F, 0.50F}});
    PhotoScene scene;
    scene.parts = builder.take();
    const Eigen::Vector3d target(0.0, 0.0, 0.3);
    add_arc(scene.views, {}, {target, 2.9, 1.0, 0.0, 20.0, 18});
    add_arc(scene.views, {}, {target, 2.5, 1.9, 10.0, 20.0, 18});
    scene.frame = {100.0, turned(1.1, {0.3, -0.8, 0.5}), {250.0, -80.0, 33.0}};
    return scene;
}

} // namespace vcarve::render
