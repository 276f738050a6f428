#include "io/colmap/find_model.h"

#include "base/text.h"
#include "io/colmap/byte_reader.h"
#include "io/colmap/model_files.h"
#include "io/colmap/text_reader.h"
#include "io/files/foreign_file.h"
#include "io/files/mapped_file.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <system_error>

namespace vcarve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kWhatAModelIs =
    "a COLMAP model is a folder with cameras, images and points3D as .bin or .txt";

/// A folder with a complete model, and its number of points.
struct Component {
    fs::path folder;
    ModelFormat format = ModelFormat::binary;
    std::uint64_t num_points = 0;
};

/// " (3,550 points)"
std::string size_in_brackets(const Component& component)
{
    return " (" + counted(static_cast<std::int64_t>(component.num_points), "points") + ")";
}

std::vector<std::string> missing_files(const fs::path& folder, ModelFormat format)
{
    std::vector<std::string> missing;
    for (const char* stem : kModelFiles) {
        const std::string file = model_file(stem, format);
        if (!is_file(folder / file)) missing.push_back(file);
    }
    return missing;
}

/// The format of the model in `folder`. Empty if the model is not complete; points3D may be missing
/// if `points` is `another`, or if there is a points3D.ply.
std::optional<ModelFormat> format_of(const fs::path& folder, PointsFile points)
{
    constexpr std::array kFormats = {ModelFormat::binary, ModelFormat::text};
    for (const ModelFormat format : kFormats) {
        if (missing_files(folder, format).empty()) return format;
    }
    if (points == PointsFile::of_model && !is_file(folder / kPointsPly)) return std::nullopt;
    for (const ModelFormat format : kFormats) {
        const std::vector<std::string> missing = missing_files(folder, format);
        if (missing == std::vector{model_file(kModelFiles.back(), format)}) return format;
    }
    return std::nullopt;
}

/// The names of all entries of a folder, short names first so that 2 precedes 10.
std::vector<std::string> names_in(const fs::path& folder)
{
    std::vector<std::string> names;
    try {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            names.push_back(entry.path().filename().string());
        }
    } catch (const fs::filesystem_error& failure) {
        throw InputError(fmt::format("{}: the folder cannot be listed ({})", folder.string(),
                                     failure.code().message()));
    }
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return a.size() != b.size() ? a.size() < b.size() : a < b;
    });
    return names;
}

std::uint64_t count_points_binary(const fs::path& path, std::string* fault)
{
    const MappedFile file(path);
    ByteReader reader(file.bytes(), path.string());
    try {
        return reader.read_count(kPointBytes, "points");
    } catch (const InputError& error) {
        if (fault != nullptr) *fault = error.what();
        return 0;
    }
}

std::uint64_t count_points_text(const fs::path& path)
{
    const MappedFile file(path);
    TextReader reader(file.bytes(), path.string());
    std::uint64_t count = 0;
    while (reader.next_record()) {
        ++count;
    }
    return count;
}

} // namespace

std::uint64_t count_points(const fs::path& folder, ModelFormat format, std::string* fault)
{
    const fs::path path = folder / model_file("points3D", format);
    if (!is_file(path)) return 0;
    return format == ModelFormat::binary ? count_points_binary(path, fault)
                                         : count_points_text(path);
}

namespace {

/// The models in the subfolders of a folder, down to `levels` levels.
std::vector<Component> components_in(const fs::path& folder, PointsFile points, int levels = 1)
{
    std::vector<Component> components;
    for (const std::string& name : names_in(folder)) {
        const fs::path path = folder / name;
        if (!is_folder(path)) continue;
        const auto format = format_of(path, points);
        if (format) components.push_back({path, *format, count_points(path, *format)});
        if (levels == 1 || name.starts_with('.')) continue;
        try {
            std::ranges::move(components_in(path, points, levels - 1),
                              std::back_inserter(components));
        } catch (const InputError&) { // skip subfolders that cannot be listed
        }
    }
    return components;
}

FoundModel model_in(const fs::path& folder, ModelFormat format)
{
    FoundModel found{folder, format, {}};
    const auto has_other = [&](ModelFormat other) {
        return missing_files(folder, other).size() < kModelFiles.size();
    };
    if (format == ModelFormat::binary && has_other(ModelFormat::text)) {
        found.notes.push_back(
            fmt::format("{} has .bin and .txt files; reading the .bin files", folder.string()));
    }
    const std::vector<std::string> missing = missing_files(folder, ModelFormat::binary);
    if (format == ModelFormat::text && has_other(ModelFormat::binary) && !missing.empty()) {
        found.notes.push_back(
            fmt::format("{} has .bin and .txt files; reading the .txt files, because it has no {}",
                        folder.string(), fmt::join(missing, " and no ")));
    }
    return found;
}

/// The component with most points; the first one if several tie.
FoundModel largest_of(const std::vector<Component>& components)
{
    constexpr std::size_t kMostNamed = 8;
    const auto largest = std::ranges::max_element(components, {}, &Component::num_points);
    FoundModel found = model_in(largest->folder, largest->format);
    std::vector<std::string> others;
    for (const Component& component : components) {
        if (component.folder == largest->folder) continue;
        others.push_back(component.folder.string() + size_in_brackets(component));
    }
    if (others.size() > kMostNamed) {
        const std::string more = fmt::format("{} more", others.size() - kMostNamed);
        others.resize(kMostNamed);
        others.push_back(more);
    }
    if (!others.empty()) {
        found.notes.push_back(fmt::format("the model has {} components; using the first one with "
                                          "the most points, {}{}; ignored: {}",
                                          components.size(), largest->folder.string(),
                                          size_in_brackets(*largest), fmt::join(others, ", ")));
    }
    return found;
}

/// Whether a name is a number, like the components that COLMAP's mapper writes.
bool is_number(const std::string& name)
{
    return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

/// The model in `folder` itself, with a note if a sibling component is larger.
FoundModel model_itself(const fs::path& folder, ModelFormat format, PointsFile points)
{
    FoundModel found = model_in(folder, format);
    std::error_code error;
    const fs::path real = fs::absolute(folder / "", error).lexically_normal().parent_path();
    if (error) return found; // its parent is unknown
    const std::string own_name = real.filename().string();
    const std::vector<std::string> names = names_in(real.parent_path());
    const auto is_other = [&](const std::string& name) {
        return is_number(name) && name != own_name;
    };
    if (!is_number(own_name) || std::ranges::none_of(names, is_other)) return found;
    const auto name_of = [](const Component& part) { return part.folder.filename().string(); };
    std::vector<Component> parts = components_in(real.parent_path(), points);
    std::erase_if(parts, [&](const Component& part) { return !is_number(name_of(part)); });
    const auto own = std::ranges::find(parts, own_name, name_of);
    const auto largest = std::ranges::max_element(parts, {}, &Component::num_points);
    if (own != parts.end() && largest->num_points > own->num_points) {
        found.notes.push_back(
            fmt::format("{} has {}; the largest component of the model is {}{}", folder.string(),
                        counted(static_cast<std::int64_t>(own->num_points), "points"),
                        largest->folder.string(), size_in_brackets(*largest)));
    }
    return found;
}

/// The model in `folder` itself, or the largest model in its subfolders.
std::optional<FoundModel> model_at(const fs::path& folder, PointsFile points, int levels = 1)
{
    if (!is_folder(folder)) return std::nullopt;
    const auto format = format_of(folder, points);
    if (format) return model_in(folder, *format);
    const std::vector<Component> components = components_in(folder, points, levels);
    if (!components.empty()) return largest_of(components);
    return std::nullopt;
}

/// A phrase for the message about an incomplete model in `folder`; empty if there is none.
std::string incomplete_model(const fs::path& folder)
{
    std::vector<std::string> parts;
    for (const ModelFormat format : {ModelFormat::binary, ModelFormat::text}) {
        const auto missing = missing_files(folder, format);
        if (missing.size() == kModelFiles.size()) continue;
        parts.push_back(
            fmt::format("a model in {} without {}", folder.string(), fmt::join(missing, " and ")));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

/// Files that indicate the purpose of a folder: COLMAP's other files, and clouds or meshes.
std::vector<std::string> telling_files(const fs::path& folder)
{
    std::vector<std::string> telling;
    std::vector<std::string> plys;
    for (const std::string& name : names_in(folder)) {
        if (name == "database.db" || name == "project.ini") telling.push_back(name);
        if (fs::path(name).extension() == ".ply") plys.push_back(name);
    }
    if (plys.size() == 1) telling.push_back(plys.front());
    if (plys.size() > 1) telling.push_back(fmt::format("{} .ply files", plys.size()));
    return telling;
}

/// Throws if `input` is a folder of images. Searches the folder beside it for the model.
void refuse_images(const fs::path& input)
{
    const std::vector<std::string> names = names_in(input);
    if (names.empty() || !std::ranges::all_of(names, has_image_name)) return;
    const fs::path beside = (input / "..").lexically_normal();
    std::optional<FoundModel> model = model_at(beside / "sparse", PointsFile::of_model);
    if (!model) model = model_at(beside, PointsFile::of_model);
    throw InputError(model ? fmt::format("{} is a folder of images; the model is in {}",
                                         input.string(), model->folder.lexically_normal().string())
                           : fmt::format("{} is a folder of images; give the model that "
                                         "COLMAP's mapper made of them, often sparse/0",
                                         input.string()));
}

[[noreturn]] void fail_not_found(const fs::path& input)
{
    refuse_images(input);
    std::vector<fs::path> looked_in{input};
    if (is_folder(input / "sparse")) looked_in.push_back(input / "sparse");

    // Incomplete models and other files, for the message
    std::vector<std::string> found;
    for (const fs::path& folder : looked_in) {
        const std::string own = incomplete_model(folder);
        if (!own.empty()) found.push_back(own);
        for (const std::string& name : names_in(folder)) {
            const std::string part = incomplete_model(folder / name);
            if (!part.empty() && folder / name != input / "sparse") found.push_back(part);
        }
    }
    for (const std::string& name : telling_files(input)) {
        found.push_back(name);
    }
    const std::string instead =
        found.empty() ? "none of these files" : fmt::format("{}", fmt::join(found, ", "));
    const bool lacks_points = instead.find(" without points3D.") != std::string::npos;
    throw InputError(
        fmt::format("{}: no COLMAP model found; searched this folder, sparse and their subfolders "
                    "for cameras, images and points3D (all .bin or all .txt); found {}{}",
                    input.string(), instead,
                    lacks_points ? "; run colmap point_triangulator to compute points from the "
                                   "poses, or give a cloud with --points FILE --rays nearest"
                                 : ""));
}

/// The model in the folder of one of its files, in the format of that file if the folder has all
/// files of it. Empty if it is no model file. Throws InputError if the folder has no complete
/// model.
std::optional<FoundModel> model_of_file(const fs::path& file, PointsFile points)
{
    constexpr std::array kStems = {"cameras", "images", "points3D", "rigs", "frames"};
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    for (const ModelFormat format : {ModelFormat::binary, ModelFormat::text}) {
        const auto is_it = [&](const char* stem) {
            return file.filename() == model_file(stem, format);
        };
        if (std::ranges::none_of(kStems, is_it)) continue;
        const auto in_folder = format_of(folder, points);
        if (!in_folder) fail_not_found(folder);
        FoundModel found =
            model_in(folder, missing_files(folder, format).empty() ? format : *in_folder);
        found.notes.push_back(fmt::format("{} is a file of the model in {}; reading that model",
                                          file.string(), folder.string()));
        return found;
    }
    return std::nullopt;
}

} // namespace

FoundModel find_model(const fs::path& input, PointsFile points)
{
    constexpr int kLevels = 4;
    std::error_code error;
    const fs::file_status status = fs::status(input, error);
    if (!fs::exists(status)) {
        const std::string reason = fs::status_known(status)
                                       ? "does not exist"
                                       : fmt::format("cannot be read ({})", error.message());
        throw InputError(fmt::format("{}: {}; {}", input.string(), reason, kWhatAModelIs));
    }
    if (!is_folder(input)) {
        if (auto found = model_of_file(input, points)) return *found;
        refuse_foreign_name(input);
        const MappedFile file(input); // refuses pages and archives
        throw InputError(fmt::format("{}: is not a folder; {}", input.string(), kWhatAModelIs));
    }
    // First the folder itself, then the workspace's, then subfolders, nearest levels first
    const auto format = format_of(input, points);
    if (format) return model_itself(input, *format, points);
    if (auto found = model_at(input / "sparse", points)) return *found;
    for (const int levels : {1, kLevels}) {
        if (auto found = model_at(input, points, levels)) return *found;
    }
    fail_not_found(input);
}

} // namespace vcarve
