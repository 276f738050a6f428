#pragma once

#include "io/colmap/colmap_model.h"
#include "model/scene_check.h"

#include <filesystem>
#include <optional>

namespace vcarve {

/// How large a model is, before it is read: from the counts its files begin with, and from the
/// bytes they have. Nothing for a text model, whose size only shows when it is read, and for files
/// that are missing or contradict themselves, which reading will tell of. Cost: none.
std::optional<SceneSize> size_before_reading(const std::filesystem::path& folder,
                                             ModelFormat format);

} // namespace vcarve
