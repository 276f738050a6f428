#include "io/colmap/colmap_model.h"

#include "io/colmap/colmap_formats.h"
#include "io/colmap/scene_builder.h"

namespace vcarve {

Scene read_colmap_model(const std::filesystem::path& folder, ModelFormat format)
{
    SceneBuilder builder(folder, format);
    if (format == ModelFormat::binary) {
        read_binary_files(folder, builder);
    } else {
        read_text_files(folder, builder);
    }
    return builder.finish();
}

} // namespace vcarve
