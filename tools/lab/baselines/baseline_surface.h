#pragma once

#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// The methods that Akgunduz, Zetu and Banerjee (2000, section 2) compare with strict carving. They
/// use the points only, not the views.
enum class Baseline { alpha_shape, sculpture };

/// The surface of a baseline, from the same points and cells as ours. It uses the labels of the
/// baseline, keeps all faces, and has the same cleanup; other steps have their default options.
/// `alpha` is a multiple of smallest_whole_alpha(). Throws InputError if the scene has too few
/// points for a surface, or if `alpha` is smaller than every cell.
TriMesh baseline_surface(Scene model, Baseline baseline, double alpha = 1.0);

} // namespace vcarve
