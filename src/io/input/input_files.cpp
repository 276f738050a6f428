#include "io/input/input_files.h"

#include "io/colmap/model_files.h"
#include "io/files/foreign_file.h"
#include "io/files/path_kind.h"

#include <algorithm>
#include <system_error>

namespace vcarve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kNamesBesideModels[] = {
    "rigs.bin",      "rigs.txt",    "frames.bin",  "frames.txt",      "points3D.ply", "fused.ply",
    "fused.ply.vis", "database.db", "project.ini", "transforms.json", "sparse_pc.ply"};

void add_if_there(const fs::path& path, std::vector<fs::path>& files)
{
    if (is_file(path)) files.push_back(path);
}

void add_all_below(const fs::path& folder, std::vector<fs::path>& files)
{
    std::error_code error;
    constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
    for (fs::recursive_directory_iterator entry(folder, kFollow, error), end;
         !error && entry != end; entry.increment(error)) {
        add_if_there(entry->path(), files);
    }
}

/// What COLMAP keeps in the folder of a model or a workspace.
void add_of_folder(const fs::path& folder, std::vector<fs::path>& files)
{
    for (const char* const stem : kModelFiles) {
        add_if_there(folder / model_file(stem, ModelFormat::binary), files);
        add_if_there(folder / model_file(stem, ModelFormat::text), files);
    }
    for (const char* const name : kNamesBesideModels) {
        add_if_there(folder / name, files);
    }
    add_all_below(folder / "images", files);
    add_all_below(folder / "stereo", files);
}

void add_cloud(const fs::path& cloud, std::vector<fs::path>& files)
{
    files.push_back(cloud);
    add_if_there(cloud.string() + ".vis", files);
}

} // namespace

std::vector<fs::path> input_files(const fs::path& input, const FoundInput& found)
{
    std::vector<fs::path> files;
    std::error_code error;
    fs::path folder =
        fs::weakly_canonical(fs::is_directory(input, error) ? input : input.parent_path(), error);
    add_of_folder(folder, files);
    // sparse/0 lies two folders below the project
    folder = fs::weakly_canonical(found.model.folder, error);
    for (int i = 0; i < 3 && folder.has_filename(); ++i) {
        add_of_folder(folder, files);
        folder = folder.parent_path();
    }
    if (found.model.format == ModelFormat::transforms) files.push_back(found.model.folder);
    if (found.dense) {
        add_cloud(found.dense->cloud, files);
        if (!found.dense->visibility.empty()) files.push_back(found.dense->visibility);
    }
    if (found.scan) add_cloud(found.scan->cloud, files);
    return files;
}

bool is_image_of_views(const fs::path& file, const FoundInput& found)
{
    if (!has_image_name(file) || found.model.folder.empty()) return false;
    std::error_code error;
    const std::string path = fs::weakly_canonical(file, error).string();
    const auto views = read_colmap_views(found.model.folder, found.model.format).views;
    return std::ranges::any_of(views,
                               [&](const View& view) { return path.ends_with("/" + view.name); });
}

} // namespace vcarve
