#pragma once

#include "model/similarity.h"
#include "options/option.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace vcarve::cli {

enum class OffsetWord { none, automatic };
/// What is up: as the cameras stand (up_of), z of what is written, or not to be asked.
enum class UpWord { automatic, z, none };

/// What the value of --transform says, a scale or a file; nothing of an empty one. Throws
/// UsageError of a number that is no scale, and InputError as read_sim3() does.
std::optional<Similarity> transform_of(const std::string& text);

/// What --offset says is to be subtracted from what is written of a model, once that is
/// transformed. The words are those of OffsetWord.
Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted,
                           const std::optional<Similarity>& transform);

/// What points up in what is written of a model, once that is transformed; zero of UpWord::none.
Eigen::Vector3d up_for(const Scene& model, UpWord wanted,
                       const std::optional<Similarity>& transform);

/// A surface in another frame.
TriMesh transformed(TriMesh mesh, const Similarity& to);

} // namespace vcarve::cli
