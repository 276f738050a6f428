#include "io/images/find_photographs.h"

#include "base/parallel.h"
#include "io/colmap/model_files.h"
#include "io/images/read_photograph.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve {

namespace fs = std::filesystem;

namespace {

bool leads_out(const fs::path& name)
{
    return name.empty() || name.has_root_path() || std::ranges::count(name, fs::path("..")) > 0;
}

fs::path with_its_name(const fs::path& path)
{
    return is_file(path) ? path : fs::path();
}

fs::path with_another_end(const fs::path& path)
{
    for (const char* const end :
         {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".JPG", ".JPEG", ".PNG", ".TIF", ".TIFF"}) {
        fs::path other = fs::path(path).replace_extension(end);
        if (is_file(other)) return other;
    }
    return {};
}

/// The file of each view, which `find` tells by the path that its name means.
template <typename Find>
std::vector<fs::path> files_of(const Scene& scene, const fs::path& folder, const Find& find)
{
    std::vector<fs::path> files(scene.views.size());
    parallel_for(
        files.size(),
        [&](std::size_t view) {
            const fs::path name = scene.views[view].name;
            if (!leads_out(name)) files[view] = find(folder / name);
        },
        16);
    return files;
}

std::size_t num_missing(const std::vector<fs::path>& files)
{
    return static_cast<std::size_t>(std::ranges::count(files, fs::path()));
}

/// Reads the sizes, and takes out the files that cannot be read.
void measure(Photographs& photographs)
{
    std::vector<std::string> reasons(photographs.of_view.size());
    parallel_for(
        reasons.size(),
        [&](std::size_t view) {
            if (photographs.of_view[view].empty()) return;
            try {
                photographs.sizes[view] = photograph_size(photographs.of_view[view]);
            } catch (const InputError& error) {
                reasons[view] = error.what();
                photographs.of_view[view].clear();
            }
        },
        4);
    std::erase(reasons, "");
    photographs.unreadable = std::move(reasons);
}

} // namespace

Photographs find_photographs(const Scene& scene, const fs::path& folder)
{
    if (!is_folder(folder)) {
        throw InputError(fmt::format("{}: {}, but the folder of the photographs is expected",
                                     folder.string(),
                                     is_file(folder) ? "found a file"
                                                     : "the folder does not exist "
                                                       "or cannot be entered"));
    }
    Photographs found;
    found.folder = folder;
    found.of_view = files_of(scene, folder, with_its_name);
    if (num_missing(found.of_view) == scene.views.size()) {
        found.of_view = files_of(scene, folder, with_another_end);
    }
    found.missing = num_missing(found.of_view);
    if (found.missing == scene.views.size()) {
        throw InputError(fmt::format(
            "{}: found the photograph of none of the {} views, such as {}; expected the folder "
            "that the names of the views are paths in",
            folder.string(), scene.views.size(), scene.views.empty() ? "" : scene.views[0].name));
    }
    found.sizes.resize(found.of_view.size());
    measure(found);
    if (num_missing(found.of_view) == scene.views.size()) throw InputError(found.unreadable[0]);
    return found;
}

std::optional<fs::path> photographs_beside(const fs::path& model)
{
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(model, error); // so that "." has a parent
    if (error) return std::nullopt;
    const auto images_in = [](const fs::path& parent) { return parent / "images"; };
    if (is_folder(images_in(model))) return images_in(model);
    const fs::path parent = folder.parent_path();
    if (folder.filename() == "sparse" && is_folder(images_in(parent))) return images_in(parent);
    const fs::path above = parent.parent_path();
    if (parent.filename() == "sparse" && is_folder(images_in(above))) return images_in(above);
    return std::nullopt;
}

} // namespace vcarve
