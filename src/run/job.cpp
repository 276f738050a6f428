#include "run/job.h"

#include "base/version.h"
#include "io/colmap/model_files.h"
#include "model/scene_check.h"
#include "options/declared.h"
#include "run/stage_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <system_error>

namespace vcarve {

namespace {

/// A file of the input, with a name that does not depend on its path.
struct ReadFile {
    std::string name;
    std::filesystem::path path;
};

std::vector<ReadFile> files_of(const FoundInput& input)
{
    if (input.scan) return {{"the scan", input.scan->cloud}};
    const bool is_dense = input.dense.has_value();
    const auto& folder = is_dense ? input.dense->model : input.model.folder;
    const ModelFormat format = is_dense ? input.dense->format : input.model.format;
    std::vector<ReadFile> files;
    for (const char* const stem : kModelFiles) {
        if (is_dense && std::string_view(stem) == "points3D") continue; // not read
        const std::filesystem::path path = model_path(folder, stem, format);
        if (files.empty() || files.back().path != path) files.push_back({path.filename(), path});
    }
    if (!is_dense) return files;
    files.push_back(
        {input.dense->are_sparse ? "the sparse cloud" : "the cloud", input.dense->cloud});
    if (!input.dense->visibility.empty()) {
        files.push_back({"the visibility", input.dense->visibility});
    }
    return files;
}

template <typename T>
void add(RunningDigest& digest, const T& value)
{
    if constexpr (kIsPlain<T>) {
        digest.add({reinterpret_cast<const char*>(&value), sizeof(T)});
    } else if constexpr (kIsArray<T>) {
        add(digest, std::uint64_t{value.size()});
        for (const auto& item : value) {
            add(digest, item);
        }
    } else {
        for_each_field(value, [&](const auto& field) { add(digest, field); });
    }
}

/// The order of points by id, because models list their points in any order.
std::vector<std::size_t> order_by_id(const std::vector<std::uint64_t>& ids)
{
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t point) { return ids[point]; });
    return order;
}

/// The size in bytes; 0 if the file is missing, which reading it reports.
double size_of_file(const std::filesystem::path& path)
{
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    return error ? 0.0 : static_cast<double>(bytes);
}

} // namespace

std::string job_text(const Job& job)
{
    std::string text;
    for (const JobFact& fact : job) {
        text += fmt::format("{}\t{}\n", fact.name, fact.value);
    }
    return text;
}

Digest digest_of(const Job& job)
{
    return digest_of(job_text(job));
}

Digest digest_of(const Scene& scene)
{
    RunningDigest digest;
    add(digest, scene.cameras);
    add(digest, scene.views);
    add(digest, scene.offset);
    for (const std::size_t point : order_by_id(scene.point_ids)) {
        if (!is_valid_position(scene.positions[point])) continue;
        add(digest, scene.point_ids[point]);
        add(digest, scene.positions[point]);
        add(digest, scene.colors[point]);
        add(digest, scene.errors_px[point]);
        if (!scene.normals.empty()) add(digest, scene.normals[point]);
        for (const std::uint32_t view : scene.tracks[point]) {
            add(digest, view);
        }
    }
    return digest.value();
}

JobFact program_fact()
{
    return {"the program",
            fmt::format("colmap-vcarve {}, {}", program_version(), versions().compiler)};
}

JobFact file_fact(const std::string& name, const std::filesystem::path& path,
                  const Progress& progress)
{
    const Digest digest = digest_of_file(path, progress);
    return {name, fmt::format("{} bytes with the digest {}", std::filesystem::file_size(path),
                              digest_text(digest))};
}

Job input_facts(const FoundInput& input, const Progress& progress)
{
    const std::vector<ReadFile> files = files_of(input);
    double all = 0.0;
    for (const ReadFile& file : files) {
        all += size_of_file(file.path);
    }
    Job facts;
    double done = 0.0;
    for (const ReadFile& file : files) {
        const double end = done + size_of_file(file.path);
        const Progress part = all > 0.0 ? progress.part(done / all, end / all) : progress;
        facts.push_back(file_fact(file.name, file.path, part));
        done = end;
    }
    if (input.scan) {
        const auto& place = input.scan->scanner;
        facts.push_back({"--scanner", place ? fmt::format("{}", fmt::join(*place, ",")) : "file"});
    } else if (input.dense) {
        facts.push_back({"--rays", input.dense->visibility.empty() ? "nearest" : "file"});
    } else if (input.rays != RaysFrom::automatic) {
        facts.push_back({"--rays", input.rays == RaysFrom::nearest ? "nearest" : "file"});
    }
    return facts;
}

Job option_facts(Options options)
{
    Job facts;
    for (const Option& option : options_of(options)) {
        if (option.stage == kRunStage || option.stage == kPhotoStage) continue;
        const std::string name = "--" + option.info.name;
        const auto* const* region = std::get_if<RegionChoice*>(&option.value);
        const bool is_file = region != nullptr && (*region)->kind == RegionChoice::Kind::file;
        facts.push_back(is_file ? file_fact(name, (*region)->file)
                                : JobFact{name, value_text(option)});
    }
    if (options.dense.dense) {
        facts.push_back({"--dense-size", std::to_string(options.dense.size_px)});
    }
    return facts;
}

Job image_facts(const std::string& kind, const Photographs& images, const Progress& progress)
{
    Job facts;
    const auto all = static_cast<double>(images.of_view.size());
    for (std::size_t view = 0; view < images.of_view.size(); ++view) {
        progress.report(static_cast<double>(view), all);
        const std::filesystem::path& file = images.of_view[view];
        if (file.empty()) continue;
        facts.push_back(file_fact(
            fmt::format("{} {}", kind, file.lexically_relative(images.folder).string()), file));
    }
    return facts;
}

std::vector<std::string> comments_of(const Digest& scene, Options options)
{
    std::vector<std::string> comments = {"made by colmap-vcarve " + versions().program,
                                         "input " + digest_text(scene)};
    Options usual;
    const auto with_photos_last = [](OptionList list) {
        std::stable_partition(list.begin(), list.end(),
                              [](const Option& option) { return option.stage != kPhotoStage; });
        return list;
    };
    const std::vector<std::string> changed =
        changed_options(with_photos_last(options_of(options)), with_photos_last(options_of(usual)));
    comments.insert(comments.end(), changed.begin(), changed.end());
    return comments;
}

std::vector<std::string> changed_options(const OptionList& options, const OptionList& defaults)
{
    std::vector<std::string> changed;
    for (std::size_t i = 0; i < options.size(); ++i) {
        const Option& option = options[i];
        const std::string value = value_text(option);
        if (option.stage == kRunStage || value == value_text(defaults[i])) continue;
        const std::string name = "option " + option.info.name;
        const bool may_be_path = std::holds_alternative<std::filesystem::path*>(option.value) ||
                                 std::holds_alternative<RegionChoice*>(option.value) ||
                                 std::holds_alternative<std::string*>(option.value);
        const bool is_path = may_be_path && std::ranges::count(option.info.words, value) == 0 &&
                             value.find_first_not_of("0123456789.,+-e") != std::string::npos;
        changed.push_back(is_flag(option) ? name : name + "=" + (is_path ? "FILE" : value));
    }
    return changed;
}

} // namespace vcarve
