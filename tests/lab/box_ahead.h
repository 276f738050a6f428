#pragma once

#include "render/raster.h"
#include "render/shapes.h"

namespace vcarve::render {

/// A box of edge 2 whose near side fills the middle 4 x 4 of 8 x 6 pixels of view_ahead().
inline TriMesh box_ahead()
{
    PartBuilder builder;
    add_box(builder, {{0.0, 0.0, 4.0}, {2.0, 2.0, 2.0}}, {});
    return builder.take().mesh;
}

/// From the origin along z.
inline Pinhole view_ahead()
{
    Pinhole view;
    view.focal_px = {8.0, 8.0};
    view.principal_px = {4.0, 3.0};
    view.width_px = 8;
    view.height_px = 6;
    return view;
}

} // namespace vcarve::render
