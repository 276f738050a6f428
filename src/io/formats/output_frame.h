#pragma once

#include "model/similarity.h"
#include "options/option.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <optional>

namespace vcarve {

enum class OffsetWord { none, automatic };
/// The up direction: that of most cameras (up_of), the direction opposite to their view (back_of),
/// z of the output, or unknown.
enum class UpWord { automatic, back, z, none };

/// --up, the up direction of a mesh file.
Option up_option(WordOrVector& up);

/// The offset of --offset, to be subtracted from coordinates after `transform`. The words are those
/// of OffsetWord.
Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted,
                           const std::optional<Similarity>& transform);

/// The up direction of --up in coordinates after `transform`; zero for UpWord::none. The words are
/// those of UpWord. Throws UsageError if the vector is zero.
Eigen::Vector3d up_for(const Scene& model, const WordOrVector& wanted,
                       const std::optional<Similarity>& transform);

/// `transform`, followed by a rotation of `up` to z.
Similarity turned_upright(const std::optional<Similarity>& transform, const Eigen::Vector3d& up);

/// Transforms positions and normals of a mesh.
TriMesh transformed(TriMesh mesh, const Similarity& to);

} // namespace vcarve
