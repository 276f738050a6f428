#include "io/work/job.h"

#include "base/validate.h"
#include "base/version.h"
#include "io/colmap/model_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <system_error>

namespace vcarve {

namespace {

/// A file of the input, and what it is called whatever its name.
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
        if (is_dense && std::string_view(stem) == "points3D") continue; // is not read then
        const std::string name = model_file(stem, format);
        files.push_back({name, folder / name});
    }
    if (!is_dense) return files;
    files.push_back({"the cloud", input.dense->cloud});
    if (!input.dense->visibility.empty()) {
        files.push_back({"the visibility", input.dense->visibility});
    }
    return files;
}

/// 0 of one that is not there, which reading will tell of.
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
        facts.push_back({"--sights", input.dense->visibility.empty() ? "nearest" : "file"});
    }
    return facts;
}

void OptionFacts::stage(const char* title)
{
    shapes_result_ = std::string_view(title) != "Run";
}

void OptionFacts::add(const OptionInfo& info, std::string value)
{
    if (shapes_result_) facts_.push_back({fmt::format("--{}", info.name), std::move(value)});
}

void OptionFacts::number(double& value, const OptionInfo& info)
{
    add(info, fmt::format("{}", value)); // all digits
}

void OptionFacts::count(int& value, const OptionInfo& info)
{
    add(info, fmt::format("{}", value));
}

void OptionFacts::bytes(std::int64_t& value, const OptionInfo& info)
{
    add(info, fmt::format("{}", value));
}

void OptionFacts::flag(bool& value, const OptionInfo& info)
{
    add(info, value ? "yes" : "no");
}

void OptionFacts::choice(int& value, std::span<const char* const> names, const OptionInfo& info)
{
    add(info, names[static_cast<std::size_t>(value)]);
}

void OptionFacts::word_or_vector(WordOrVector& value, std::span<const char* const> words,
                                 const OptionInfo& info)
{
    const bool is_word = value.word != WordOrVector::kNoWord;
    add(info, is_word ? std::string(words[static_cast<std::size_t>(value.word)])
                      : fmt::format("{}", fmt::join(value.vector, ",")));
}

void OptionFacts::region(RegionChoice& value, const OptionInfo& info)
{
    if (value.kind != RegionChoice::Kind::file) {
        add(info, region_text(value));
    } else if (shapes_result_) {
        facts_.push_back(file_fact(fmt::format("--{}", info.name), value.file));
    }
}

} // namespace vcarve
