#include "io/work/job.h"

#include "base/validate.h"
#include "base/version.h"
#include "io/colmap/model_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace vcarve {

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

JobFact file_fact(const std::string& name, const std::filesystem::path& path)
{
    const Digest digest = digest_of_file(path);
    return {name, fmt::format("{} bytes with the digest {}", std::filesystem::file_size(path),
                              digest_text(digest))};
}

Job input_facts(const FoundInput& input)
{
    if (input.scan) {
        const auto& place = input.scan->scanner;
        return {file_fact("the scan", input.scan->cloud),
                {"--scanner", place ? fmt::format("{}", fmt::join(*place, ",")) : "file"}};
    }
    Job facts;
    const bool is_dense = input.dense.has_value();
    const auto& folder = is_dense ? input.dense->model : input.model.folder;
    const ModelFormat format = is_dense ? input.dense->format : input.model.format;
    for (const char* const stem : kModelFiles) {
        if (is_dense && std::string_view(stem) == "points3D") continue; // is not read then
        const std::string name = model_file(stem, format);
        facts.push_back(file_fact(name, folder / name));
    }
    if (!is_dense) return facts;
    facts.push_back(file_fact("the cloud", input.dense->cloud));
    if (input.dense->visibility.empty()) {
        facts.push_back({"--sights", "nearest"});
    } else {
        facts.push_back(file_fact("the visibility", input.dense->visibility));
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
