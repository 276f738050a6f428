#include "render/heap.h"
#include "render/scenes/scenes.h"
#include "render/shapes.h"
#include "render/stands.h"

namespace vcarve::render {

namespace {

Eigen::Quaterniond turned(double angle_rad, const Eigen::Vector3d& axis)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized()));
}

/// Two rings of views around a table that carries a heap.
PhotoScene heap_on_table(const Heap& heap)
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.0, -0.08}, {2.6, 2.6, 0.08}}, {{0.74F, 0.66F, 0.56F}});
    add_heap(builder, heap);
    PhotoScene scene;
    scene.parts = builder.take();
    const Eigen::Vector3d target(0.0, 0.0, 0.3);
    add_arc(scene.views, {}, {target, 2.6, 1.0, 0.0, 20.0, 18});
    add_arc(scene.views, {}, {target, 2.1, 1.9, 10.0, 20.0, 18});
    return scene;
}

} // namespace

PhotoScene clutter()
{
    PhotoScene scene = heap_on_table({40, 0.36, 0.14, 0.50, 7});
    scene.frame = {0.01, turned(2.4, {0.5, 0.2, 0.9}), {0.02, 0.05, -0.03}};
    return scene;
}

PhotoScene noisy()
{
    PhotoScene scene = heap_on_table({25, 0.38, 0.18, 0.55, 23});
    scene.grain = {0.8, 12.0};
    scene.frame = {0.1, turned(0.7, {-0.6, 0.7, 0.1}), {-1.0, 0.4, 0.2}};
    return scene;
}

} // namespace vcarve::render
