#pragma once

#include "vcarve/option_visitor.h"

#include <string>
#include <vector>

namespace vcarve::cli {

enum class OptionKind { number, count, bytes, flag, choice, vector, region, path, name };

/// One option as the user meets it.
struct OptionRow {
    std::string stage; ///< heading it stands under
    OptionKind kind = OptionKind::flag;
    std::string name; ///< kebab-case, without dashes; "no-NAME" for a flag that is on by default
    std::string unit; ///< empty for a pure number
    std::string help;
    std::string accepted; ///< to be read after "takes"; empty for a flag
    std::string range;    ///< "1 to 64", "2 or more"; empty where only the sign is restricted
    std::string initial;  ///< the default as one would type it; empty where there is none
    std::vector<std::string> choices; ///< words that may stand for the value
};

/// Lists the options of options structs, in order, with their present values as the defaults.
class OptionTable final : public OptionVisitor {
  public:
    void stage(const char* title) override { stage_ = title; }
    void number(double& value, const OptionInfo& info) override;
    void count(int& value, const OptionInfo& info) override;
    void bytes(std::int64_t& value, const OptionInfo& info) override;
    void flag(bool& value, const OptionInfo& info) override;
    void choice(int& value, std::span<const char* const> names, const OptionInfo& info) override;
    void word_or_vector(WordOrVector& value, std::span<const char* const> words,
                        const OptionInfo& info) override;
    void region(RegionChoice& value, const OptionInfo& info) override;

    /// An option whose value is a path.
    void path(const OptionInfo& info);
    /// An option whose value is one of `words`, the first by default, or a name.
    void word_or_name(std::span<const char* const> words, const OptionInfo& info);

    const std::vector<OptionRow>& rows() const { return rows_; }

  private:
    OptionRow& add(OptionKind kind, const OptionInfo& info);

    std::string stage_;
    std::vector<OptionRow> rows_;
};

/// What stands for the value in help texts: "<px>", "strict|cut", "FILE"; empty for a flag.
std::string placeholder(const OptionRow& row);

/// The row of that name, or null.
const OptionRow* find_row(const std::vector<OptionRow>& rows, std::string_view name);

} // namespace vcarve::cli
