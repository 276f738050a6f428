#include "render/still_life.h"

#include "render/shapes.h"

namespace vcarve::render {

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

} // namespace vcarve::render
