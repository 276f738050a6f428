#include "io/input/find_input.h"

#include "vcarve/error.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace vcarve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFused = "fused.ply";

bool is_file(const fs::path& path)
{
    std::error_code error;
    return fs::is_regular_file(path, error);
}

bool is_ply_file(const fs::path& path)
{
    return path.extension() == ".ply" && is_file(path);
}

/// The file of --visibility, or the one beside the cloud; none where none is to be read.
fs::path visibility_of(const fs::path& cloud, const PointsOptions& options)
{
    if (options.sights == SightsFrom::nearest) return {};
    if (!options.visibility.empty()) return options.visibility;
    fs::path beside = cloud;
    return beside += ".vis";
}

FoundInput sparse_input(FoundModel model, const PointsOptions& options)
{
    if (!options.visibility.empty()) {
        throw UsageError(fmt::format("--visibility {} tells which views saw the points of a cloud, "
                                     "but the sparse points of {} are taken",
                                     options.visibility.string(), model.folder.string()));
    }
    if (options.sights == SightsFrom::nearest) {
        throw UsageError(
            fmt::format("--sights nearest is for the points of a cloud, but the sparse "
                        "points of {} are taken",
                        model.folder.string()));
    }
    std::vector<std::string> notes = model.notes;
    return {std::move(model), std::nullopt, std::move(notes)};
}

/// Which cloud was taken, as a sentence.
std::string note_on(const DenseFiles& files)
{
    if (files.visibility.empty()) {
        return fmt::format("the points are those of {}; no file tells which views saw them, so the "
                           "nearest views of {} are taken before which no other point stands",
                           files.cloud.string(), files.model.string());
    }
    return fmt::format("the points are those of {}, seen by the views of {}", files.cloud.string(),
                       files.model.string());
}

FoundInput dense_input(FoundModel model, const fs::path& cloud, const PointsOptions& options)
{
    if (options.sights == SightsFrom::nearest && !options.visibility.empty()) {
        throw UsageError(fmt::format("--sights nearest reads no file, so it cannot go with "
                                     "--visibility {}",
                                     options.visibility.string()));
    }
    const fs::path visibility = visibility_of(cloud, options);
    if (!is_file(cloud)) {
        throw InputError(fmt::format("{}: the file does not exist, so there are no dense points to "
                                     "take with the views of {}",
                                     cloud.string(), model.folder.string()));
    }
    if (options.sights == SightsFrom::file && !is_file(visibility)) {
        throw InputError(fmt::format("{}: the file does not exist, which tells which views saw the "
                                     "points of {}, as COLMAP's stereo_fusion writes it "
                                     "(--visibility names another, --sights nearest does without)",
                                     visibility.string(), cloud.string()));
    }
    std::vector<std::string> notes = model.notes;
    DenseFiles files{model.folder, model.format, cloud, visibility};
    notes.push_back(note_on(files));
    return {std::move(model), std::move(files), std::move(notes)};
}

/// A cloud of the workspace around a model, for which the user could have asked.
void mention_other_cloud(const fs::path& input, FoundInput& found)
{
    for (const char* folder : {"dense", "dense/0"}) {
        const fs::path workspace = input / folder;
        if (!is_file(workspace / kFused)) continue;
        found.notes.push_back(fmt::format("the sparse points are taken; {} means those of {}",
                                          workspace.string(), (workspace / kFused).string()));
        return;
    }
}

FoundInput look_for_points(FoundModel model, const fs::path& input, const PointsOptions& options)
{
    const fs::path fused = input / kFused;
    if (!is_file(fused)) {
        FoundInput found = sparse_input(std::move(model), options);
        mention_other_cloud(input, found);
        return found;
    }
    const bool is_told = !options.visibility.empty() || options.sights == SightsFrom::nearest;
    if (is_told || is_file(visibility_of(fused, options))) {
        FoundInput found = dense_input(std::move(model), fused, options);
        found.notes.back() += "; --points sparse takes the sparse ones";
        return found;
    }
    FoundInput found = sparse_input(std::move(model), options);
    found.notes.push_back(fmt::format("the sparse points are taken and {} is left out, for there "
                                      "is no {} to tell which views saw its points; --sights "
                                      "nearest does without",
                                      fused.string(), visibility_of(fused, options).string()));
    return found;
}

} // namespace

FoundInput find_input(const fs::path& input, const PointsOptions& options)
{
    if (is_ply_file(input)) {
        if (!options.points.empty()) {
            throw UsageError(fmt::format("--points {} chooses points for a model, but {} is a "
                                         "cloud itself",
                                         options.points, input.string()));
        }
        const fs::path folder = input.has_parent_path() ? input.parent_path() : fs::path(".");
        return dense_input(find_model(folder), input, options);
    }
    FoundModel model = find_model(input);
    if (options.points.empty()) return look_for_points(std::move(model), input, options);
    if (options.points == "sparse") return sparse_input(std::move(model), options);
    const fs::path cloud = options.points == "dense" ? input / kFused : fs::path(options.points);
    return dense_input(std::move(model), cloud, options);
}

} // namespace vcarve
