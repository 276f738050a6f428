// Scenes of a few objects in front of a wall: the fixture, a scene with little texture, and a scene
// with few views.
#include "render/raster.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"

namespace vcarve::render {

namespace {

/// A plain wall, on which SIFT finds almost no features.
Paint even(const Eigen::Array3f& tint)
{
    return {tint, 0.04};
}

/// The scene of fixtures/scene: objects on a floor in front of a wall.
Parts still_life()
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.1, -0.1}, {4.0, 3.0, 0.1}}, {{0.80F, 0.74F, 0.64F}}); // floor
    add_box(builder, {{0.0, 1.65, 0.0}, {4.0, 0.1, 2.0}}, {{0.74F, 0.80F, 0.86F}}); // wall
    add_box(builder, {{-0.85, 0.45, 0.0}, {0.7, 0.6, 0.55}, 20.0}, {{0.86F, 0.45F, 0.36F}});
    add_box(builder, {{0.75, 0.75, 0.0}, {0.6, 0.5, 1.05}, -15.0}, {{0.42F, 0.62F, 0.82F}});
    add_box(builder, {{0.05, -0.25, 0.0}, {0.04, 0.7, 0.6}, 55.0},
            {{0.90F, 0.78F, 0.36F}}); // panel
    add_box(builder, {{0.05, 1.1, 0.0}, {0.25, 0.25, 0.3}, 35.0}, {{0.66F, 0.50F, 0.76F}});
    add_sphere(builder, {-0.85, 0.45, 0.82}, 0.27, {{0.46F, 0.76F, 0.50F}}); // on the red box
    add_ring(builder, {0.9, -0.35, 0.32}, {0.24, 0.08}, {{0.92F, 0.62F, 0.72F}});
    return builder.take();
}

Parts half_even_parts()
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.1, -0.1}, {4.0, 3.2, 0.1}}, {{0.72F, 0.78F, 0.70F}});    // floor
    add_box(builder, {{0.0, 1.7, 0.0}, {4.0, 0.1, 1.9}}, even({0.86F, 0.84F, 0.80F})); // wall
    add_box(builder, {{-1.0, 0.7, 0.0}, {0.7, 0.5, 0.9}, 12.0}, even({0.80F, 0.50F, 0.40F}));
    add_box(builder, {{-1.0, 0.7, 0.9}, {0.4, 0.3, 0.3}, -25.0}, {{0.40F, 0.66F, 0.80F}});
    add_box(builder, {{0.0, 1.0, 0.0}, {0.9, 0.45, 0.5}, -8.0}, {{0.84F, 0.72F, 0.40F}});
    add_sphere(builder, {0.1, 1.0, 0.76}, 0.26, even({0.60F, 0.70F, 0.86F}));
    add_column(builder, {{1.1, 0.8, 0.0}, 0.3, 0.18, 1.1}, even({0.88F, 0.86F, 0.70F}));
    add_sphere(builder, {1.1, 0.8, 1.27}, 0.2, {{0.86F, 0.46F, 0.56F}});
    add_column(builder, {{-0.35, -0.3, 0.0}, 0.22, 0.22, 0.35}, {{0.62F, 0.50F, 0.80F}});
    add_box(builder, {{0.45, -0.25, 0.0}, {0.35, 0.35, 0.45}, 30.0}, even({0.50F, 0.80F, 0.60F}));
    add_ring(builder, {1.15, -0.35, 0.3}, {0.22, 0.08}, {{0.92F, 0.62F, 0.42F}});
    add_box(builder, {{-1.15, -0.4, 0.0}, {0.05, 0.6, 0.5}, 40.0}, even({0.86F, 0.60F, 0.70F}));
    return builder.take();
}

} // namespace

PhotoScene fixture_scene()
{
    PhotoScene scene;
    scene.parts = still_life();
    scene.features = 1150; // for a small fixture
    const Eigen::Vector3d target(0.0, 0.35, 0.4);
    add_arc(scene.views, {}, {target, 2.9, 0.9, -72.0, 12.0, 12});
    add_arc(scene.views, {}, {target, 2.6, 1.9, -66.0, 12.0, 12}); // shifted by half a step
    return scene;
}

PhotoScene low_texture()
{
    PhotoScene scene;
    scene.parts = half_even_parts();
    const Eigen::Vector3d target(0.0, 0.5, 0.5);
    add_arc(scene.views, {}, {target, 2.9, 0.8, -75.0, 10.0, 16});
    add_arc(scene.views, {}, {target, 2.7, 1.8, -70.0, 10.0, 15});
    scene.frame = {1.0, turned(1.9, {1.0, 0.4, -0.3}), {12.0, -7.0, 3.0}};
    return scene;
}

PhotoScene few_views()
{
    PhotoScene scene;
    scene.parts = still_life();
    scene.features = 6000;
    const Eigen::Vector3d target(0.0, 0.35, 0.4);
    const Lens lens{1000, 750, 950.0};
    add_arc(scene.views, lens, {target, 2.9, 1.0, -42.0, 21.0, 5});
    add_arc(scene.views, lens, {target, 2.6, 1.9, -21.0, 21.0, 3});
    scene.frame = {20.0, turned(0.8, {-0.2, 1.0, 0.5}), {-3.0, 40.0, 11.0}};
    return scene;
}

} // namespace vcarve::render
