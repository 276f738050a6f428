#pragma once

#include "run/digest.h"
#include "vcarve/scene.h"

namespace vcarve {

/// The digest of a scene: of all its views and points, whichever files they were read from and in
/// whatever order the points stand there. Points that are nowhere (is_place()) do not count. Cost:
/// that of the digest of their bytes, and a sort.
Digest digest_of(const Scene& scene);

} // namespace vcarve
