#include "io/images/find_photographs.h"

#include "base/parallel.h"
#include "base/progress.h"
#include "base/text.h"
#include "io/files/foreign_file.h"
#include "io/files/mapped_file.h"
#include "io/images/read_photograph.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>

namespace vcarve {

namespace fs = std::filesystem;

namespace {

bool leads_out(const fs::path& name)
{
    return name.empty() || name.has_root_path() || std::ranges::count(name, fs::path("..")) > 0;
}

/// The possible paths of a view's name in `folder`, the most likely first.
std::vector<fs::path> readings_of(const std::string& name, const fs::path& folder)
{
    std::vector<fs::path> readings = {name};
    if (std::ranges::count(name, '\\') > 0) {
        std::string with_slashes = name;
        std::ranges::replace(with_slashes, '\\', '/');
        readings.emplace_back(with_slashes);
    }
    // Paths such as images/a.png in transforms.json are relative to its folder.
    const std::size_t count = readings.size();
    for (std::size_t i = 0; i < count; ++i) {
        const fs::path reading = readings[i].lexically_normal();
        if (reading.begin() == reading.end()) continue;
        const fs::path& first = *reading.begin();
        if (first != folder.filename() && first != "images") continue;
        readings.push_back(reading.lexically_relative(first));
    }
    std::erase_if(readings, leads_out);
    return readings;
}

/// Finds photographs in a folder by names that differ in case or file extension.
class SimilarNames {
  public:
    /// Excludes the files in `taken`, which is sorted. Cost: lists the folder.
    SimilarNames(const fs::path& folder, const std::vector<fs::path>& taken)
    {
        std::vector<fs::path> files;
        std::error_code error;
        for (fs::recursive_directory_iterator at(folder, error), end; at != end && !error;
             at.increment(error)) {
            if (!has_image_name(at->path())) continue;
            if (!std::ranges::binary_search(taken, at->path())) files.push_back(at->path());
        }
        std::ranges::sort(files);
        for (const fs::path& file : files) {
            const fs::path name = file.lexically_relative(folder);
            files_.emplace(lower_case(name.generic_string()), file);
            files_.emplace(lower_case(fs::path(name).replace_extension().generic_string()), file);
        }
    }

    fs::path find(const fs::path& name) const
    {
        for (const fs::path& key :
             {name, has_image_name(name) ? fs::path(name).replace_extension() : name}) {
            const auto found = files_.find(lower_case(key.lexically_normal().generic_string()));
            if (found != files_.end()) return found->second;
        }
        return {};
    }

  private:
    std::map<std::string, fs::path> files_; ///< the first file in name order for each key
};

/// The file of each view, empty if it has none.
std::vector<fs::path> files_of(const Scene& scene, const fs::path& folder)
{
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(folder, error); // so that "." has a name
    std::vector<fs::path> files(scene.views.size());
    parallel_for(
        files.size(),
        [&](std::size_t view) {
            for (const fs::path& name : readings_of(scene.views[view].name, whole)) {
                if (files[view].empty() && is_file(folder / name)) files[view] = folder / name;
            }
        },
        16);
    if (std::ranges::count(files, fs::path()) == 0) return files;
    std::vector<fs::path> taken = files;
    std::ranges::sort(taken);
    const SimilarNames similar(folder, taken);
    for (std::size_t view = 0; view < files.size(); ++view) {
        for (const fs::path& name : readings_of(scene.views[view].name, whole)) {
            if (files[view].empty()) files[view] = similar.find(name);
        }
    }
    return files;
}

std::size_t num_missing(const std::vector<fs::path>& files)
{
    return static_cast<std::size_t>(std::ranges::count(files, fs::path()));
}

/// Whether a photograph can be a scaled image of the camera, with rounded sides.
bool has_shape_of(const Camera& camera, const PhotographSize& photo)
{
    constexpr double kShare = 0.01;
    const double width = camera.width_px;
    const double height = camera.height_px;
    const double difference = std::abs(photo.width_px * height - photo.height_px * width);
    return difference <= std::max(2.0 * (width + height), kShare * photo.width_px * height);
}

/// Reads the sizes, and removes unusable files.
void measure(const Scene& scene, const char* kind, Photographs& photographs)
{
    std::vector<std::string> reasons(photographs.of_view.size());
    parallel_for(
        reasons.size(),
        [&](std::size_t view) {
            fs::path& file = photographs.of_view[view];
            if (file.empty()) return;
            try {
                const PhotographSize size = photograph_size(file);
                const Camera& camera = scene.cameras[scene.views[view].camera];
                if (camera.width_px > 0 && camera.height_px > 0 && !has_shape_of(camera, size)) {
                    throw InputError(fmt::format(
                        "{}: found {} x {} pixels, but the camera's images have {} x {}; a "
                        "{} may be scaled, but not cropped or rotated",
                        file.string(), size.width_px, size.height_px, camera.width_px,
                        camera.height_px, kind));
                }
                photographs.sizes[view] = size;
            } catch (const InputError& error) {
                reasons[view] = error.what();
                file.clear();
            }
        },
        4);
    std::erase(reasons, "");
    photographs.unusable = std::move(reasons);
}

/// `kind` is "photograph" or "mask".
Photographs find_pictures(const Scene& scene, const fs::path& folder, const char* kind)
{
    if (!is_folder(folder)) {
        throw InputError(fmt::format("{}: {}; expected the folder of the {}s", folder.string(),
                                     is_file(folder) ? "found a file"
                                                     : "the folder does not exist "
                                                       "or cannot be opened",
                                     kind));
    }
    Photographs found;
    found.folder = folder;
    found.of_view = files_of(scene, folder);
    found.missing = num_missing(found.of_view);
    if (found.missing == scene.views.size()) {
        throw InputError(
            fmt::format("{}: found no {} of the {} views, such as {}; expected the folder that the "
                        "names of the views are relative to",
                        folder.string(), kind, scene.views.size(),
                        scene.views.empty() ? "" : scene.views[0].name));
    }
    found.sizes.resize(found.of_view.size());
    measure(scene, kind, found);
    if (num_missing(found.of_view) == scene.views.size()) throw InputError(found.unusable[0]);
    return found;
}

} // namespace

Photographs find_photographs(const Scene& scene, const fs::path& folder)
{
    return find_pictures(scene, folder, "photograph");
}

Photographs find_masks(const Scene& scene, const fs::path& folder)
{
    return find_pictures(scene, folder, "mask");
}

namespace {

void note_missing(const Photographs& found, const char* kind, Log& log)
{
    if (found.missing > 0) {
        log.note(fmt::format("{} of {} have no {} in {}", grouped_digits(size_of(found.missing)),
                             counted(size_of(found.of_view.size()), "views"), kind,
                             found.folder.string()));
    }
    note_unusable(found.unusable, log);
}

fs::path folder_of(const Options& options, const fs::path& model, Log& log)
{
    if (!options.images.empty()) return options.images;
    const std::optional<fs::path> beside = model.empty() ? std::nullopt : photographs_beside(model);
    if (!beside) {
        throw UsageError(fmt::format("found no folder `images` beside {}; name the folder of the "
                                     "photographs with --images",
                                     model.empty() ? "the points" : model.string()));
    }
    log.note(fmt::format("using the photographs in {}", beside->string()));
    return *beside;
}

/// Throws InputError if the largest photograph needs more than half of `most` bytes.
void require_photo_memory(const Photographs& photographs, std::int64_t most)
{
    constexpr std::int64_t kBytesOfPixel = 8; // with its pyramid, while it is decoded
    std::int64_t needed = 1;
    for (const PhotographSize& size : photographs.sizes) {
        needed = std::max(needed, kBytesOfPixel * size.width_px * size.height_px);
    }
    if (most <= 0 || 2 * needed <= most) return;
    throw InputError(fmt::format("{}: the largest photograph needs {} of memory, so --max-memory "
                                 "must be at least {}, but is {}; raise it, or scale the "
                                 "photographs down",
                                 photographs.folder.string(), byte_size_text(needed),
                                 byte_size_text(2 * needed), byte_size_text(most)));
}

} // namespace

RunImages find_images(const Scene& scene, const Options& options, const fs::path& model, Log& log)
{
    RunImages found;
    if (!options.masks.folder.empty()) {
        found.masks = find_masks(scene, options.masks.folder);
        note_missing(*found.masks, "mask", log);
    }
    if (!reads_photographs(options)) return found;
    found.photographs = find_photographs(scene, folder_of(options, model, log));
    note_missing(*found.photographs, "photograph", log);
    require_photo_memory(*found.photographs, options.memory.limit);
    if (found.masks) found.photographs->masks = found.masks->of_view;
    return found;
}

void note_unusable(const std::vector<std::string>& sentences, Log& log)
{
    constexpr std::size_t kMostNamed = 5;
    if (sentences.empty()) return;
    if (sentences.size() == 1) return log.note(sentences[0]);
    std::string names;
    for (std::size_t i = 1; i < std::min(sentences.size(), kMostNamed); ++i) {
        const std::string path = sentences[i].substr(0, sentences[i].find(": "));
        names += fmt::format("{}{}", i == 1 ? "" : ", ", fs::path(path).filename().string());
    }
    const char* const more = sentences.size() > kMostNamed ? ", ..." : "";
    log.note(fmt::format("{} cannot be used. {}. The others are {}{}",
                         counted(size_of(sentences.size()), "photographs"), sentences[0], names,
                         more));
}

std::optional<fs::path> photographs_beside(const fs::path& model)
{
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(model, error); // so that "." has a parent
    if (error) return std::nullopt;
    if (lower_case_end(model) == ".json") return folder.parent_path();
    const auto images_in = [](const fs::path& parent) { return parent / "images"; };
    if (is_folder(images_in(model))) return images_in(model);
    if (is_file(model / kTransforms) || is_file(model / kTransformsTrain)) return folder;
    fs::path parent = folder.parent_path();
    if (folder.filename() != "sparse") {
        if (parent.filename() != "sparse") return std::nullopt;
        parent = parent.parent_path();
    }
    if (is_folder(images_in(parent))) return images_in(parent);
    const fs::path above = parent.parent_path();
    if (parent.filename() == "colmap" && is_folder(images_in(above))) return images_in(above);
    return std::nullopt;
}

} // namespace vcarve
