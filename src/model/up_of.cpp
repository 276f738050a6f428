#include "model/up_of.h"

namespace vcarve {

using Eigen::Vector3d;

Vector3d up_of(const Scene& scene)
{
    const auto up = mean_direction(scene, [&](const View& view) -> Vector3d {
        if (scene.cameras[view.camera].measures_range) return Vector3d::UnitZ();
        return view.cam_from_world.conjugate() * -Vector3d::UnitY();
    });
    if (up) return *up;
    const auto back = mean_direction(scene, [&](const View& view) -> Vector3d {
        return view.cam_from_world.conjugate() * -Vector3d::UnitZ();
    });
    return back.value_or(Vector3d::UnitZ());
}

} // namespace vcarve
