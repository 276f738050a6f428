#include "cli/input_output.h"

#include "base/text.h"
#include "cli/exit_code.h"
#include "io/colmap/model_files.h"
#include "io/colmap/sim3_text.h"
#include "io/colmap/transforms_json.h"
#include "io/files/output_file.h"
#include "io/input/find_input.h"
#include "model/views.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// Whether two paths name the same file. Missing files are compared by path.
bool is_same_file(const fs::path& a, const fs::path& b)
{
    std::error_code error;
    if (fs::equivalent(a, b, error)) return true;
    const fs::path real = fs::weakly_canonical(a, error);
    return !error && real == fs::weakly_canonical(b, error);
}

[[noreturn]] void refuse(const Output& output, const Output& replaced)
{
    throw UsageError(
        fmt::format("{} would replace {} {}", output.name, replaced.name, replaced.path.string()));
}

void refuse_replacing(const Output& output, std::span<const Output> files)
{
    for (const Output& file : files) {
        std::error_code error;
        if (output.path == file.path || fs::equivalent(output.path, file.path, error)) {
            refuse(output, file);
        }
    }
}

} // namespace

void require_distinct(std::span<const Output> outputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (!is_same_file(outputs[i].path, outputs[k].path)) continue;
            throw UsageError(fmt::format("{} and {} cannot both be written to {}", outputs[i].name,
                                         outputs[k].name, outputs[i].path.string()));
        }
    }
}

OptionList options_of(ConsoleArguments& arguments, const char* quiet_help)
{
    return {
        {kRunStage, {.name = "quiet", .help = quiet_help}, &arguments.quiet},
        {kRunStage,
         {.name = "verbose",
          .help = "Print every stage with all its counts.",
          .level = OptionLevel::advanced},
         &arguments.verbose},
        {kRunStage,
         {.name = "threads",
          .unit = "threads",
          .help = "Use N threads. 0 uses all. Results are the same for any thread count.",
          .max = 1024},
         &arguments.threads},
    };
}

void prepare_outputs(std::span<const Output> outputs, const fs::path& scratch)
{
    std::vector<fs::path> unfinished;
    for (const Output& output : outputs) {
        unfinished.push_back(part_path(output.path));
    }
    if (!scratch.empty()) unfinished.push_back(scratch);
    end_cleanly_on_signals(unfinished);
    for (const Output& output : outputs) {
        require_writable(output.path);
    }
}

void keep_inputs(std::span<const Output> outputs, const ModelArguments& model,
                 std::span<const Output> others)
{
    for (const Output& output : outputs) {
        refuse_replacing(output, others);
    }
    if (std::ranges::none_of(outputs, is_file, &Output::path)) return;
    const FoundInput found = find_input(model.path, model.all_points());
    std::vector<Output> inputs;
    for (const fs::path& file : input_files(model.path, found)) {
        inputs.push_back({"the input", file});
    }
    for (const Output& output : outputs) {
        if (!is_file(output.path)) continue;
        refuse_replacing(output, inputs);
        if (is_image_of_views(output.path, found)) refuse(output, {"the image", output.path});
    }
}

ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading)
{
    ModelInput input = {read_found_model(model.path, model.all_points(), log, reading), {}};
    const FoundModel& found = input.found.model;
    constexpr std::array kFormats = {"binary", "text", "transforms"};
    input.record = {{"model", model.path.string()},
                    {"folder", found.folder.string()},
                    {"format", kFormats.at(static_cast<std::size_t>(found.format))},
                    {"cloud", nullptr},
                    {"points", input.read.points},
                    {"views", input.read.views},
                    {"rays", input.read.rays}};
    if (input.found.scan) input.record["cloud"] = input.found.scan->cloud.string();
    if (input.found.scan && found.folder.empty()) {
        input.record["folder"] = nullptr;
        input.record["format"] = nullptr;
    }
    if (input.found.dense) input.record["cloud"] = input.found.dense->cloud.string();
    return input;
}

std::optional<Similarity> transform_of(const std::string& text, const ModelArguments& model)
{
    if (text.empty()) return std::nullopt;
    double scale = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, scale);
    if (lower_case_end(text) == ".json") {
        const FoundModel found = find_input(model.path, model.all_points()).model;
        const bool has_poses = found.format == ModelFormat::transforms;
        return read_nerfstudio_transform(text, has_poses ? found.folder : fs::path());
    }
    if (error == std::errc::invalid_argument || stop != end) return read_sim3(text);
    if (error != std::errc() || !(scale > 0.0) || !std::isfinite(scale)) {
        throw UsageError(
            fmt::format("--transform takes a file or a scale above 0, not \"{}\"", text));
    }
    return Similarity{.scale = scale, .linear = scale * Eigen::Matrix3d::Identity()};
}

Eigen::Vector3d offset_for(const Scene& model, const WordOrVector& wanted,
                           const std::optional<Similarity>& transform)
{
    if (wanted.word == WordOrVector::kNoWord) return wanted.vector;
    const bool automatic = static_cast<OffsetWord>(wanted.word) == OffsetWord::automatic;
    if (!automatic) return Eigen::Vector3d::Zero();
    if (!transform) return round_offset(model);
    Scene moved;
    moved.positions = model.positions;
    moved.offset = model.offset;
    move_positions(*transform, moved.positions, moved.offset);
    return round_offset(moved);
}

Eigen::Vector3d up_for(const Scene& model, const WordOrVector& wanted,
                       const std::optional<Similarity>& transform)
{
    if (wanted.word == WordOrVector::kNoWord) {
        if (wanted.vector.stableNormalized().isZero())
            throw UsageError("--up takes a direction, not 0,0,0");
        return wanted.vector.stableNormalized();
    }
    const auto word = static_cast<UpWord>(wanted.word);
    if (word == UpWord::none) return Eigen::Vector3d::Zero();
    if (word == UpWord::z) return Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up =
        word == UpWord::back ? back_of(model).value_or(up_of(model)) : up_of(model);
    return transform ? (transform->linear * up).normalized() : up;
}

Similarity turned_upright(const std::optional<Similarity>& transform, const Eigen::Vector3d& up)
{
    Similarity turned = transform.value_or(Similarity());
    const auto turn = Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
    turned.linear = turn * turned.linear;
    turned.translation = turn * turned.translation;
    return turned;
}

TriMesh transformed(TriMesh mesh, const Similarity& to)
{
    move_positions(to, mesh.positions, mesh.offset);
    const Eigen::Matrix3d rotation = to.linear / to.scale;
    for (Eigen::Vector3f& normal : mesh.normals) {
        normal = (rotation * normal.cast<double>()).stableNormalized().cast<float>();
    }
    return mesh;
}

} // namespace vcarve::cli
