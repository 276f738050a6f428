#pragma once

#include "io/colmap/find_model.h"
#include "model/similarity.h"
#include "options/option.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace vcarve {

enum class OffsetWord { none, automatic };
/// The up direction: that of most cameras (up_of), the direction opposite to their view (back_of),
/// z of the output, or unknown.
enum class UpWord { automatic, back, z, none };

/// The transformation of --transform, a scale or a file, from the frame of the model; nothing if
/// `text` is empty. Throws UsageError if a number is not a valid scale, and InputError as
/// read_sim3() and read_nerfstudio_transform().
std::optional<Similarity> transform_of(const std::string& text, const FoundModel& model);

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
