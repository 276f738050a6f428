#include "io/colmap/text_reader.h"

#include "base/text.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace vcarve {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\r\v\f";

bool is_blank(char c)
{
    return kBlanks.find(c) != std::string_view::npos;
}

bool continues_utf8(char c)
{
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

} // namespace

std::string printable(std::string_view text)
{
    constexpr std::size_t kMost = 60;
    std::string shown(text.substr(0, kMost));
    if (text.size() > kMost) {
        // Cut between UTF-8 characters
        std::size_t end = kMost;
        while (end > 0 && continues_utf8(text[end])) {
            --end;
        }
        shown.resize(end);
        shown += "...";
    }
    return control_free(shown);
}

TextReader::TextReader(std::span<const char> bytes, std::string name)
    : unread_(bytes.data(), bytes.size()), size_(bytes.size()), name_(std::move(name))
{
    if (unread_.starts_with(kByteOrderMark)) unread_.remove_prefix(kByteOrderMark.size());
}

bool TextReader::next_line()
{
    while (!unread_.empty()) {
        const std::size_t length = std::min(unread_.find('\n'), unread_.size());
        line_ = unread_.substr(0, length);
        unread_.remove_prefix(std::min(length + 1, unread_.size()));
        ++line_number_;
        if (at_line_end() || line_.front() != '#') return true;
    }
    line_ = {};
    return false;
}

bool TextReader::next_record()
{
    while (next_line()) {
        if (!at_line_end()) return true;
    }
    return false;
}

bool TextReader::at_line_end()
{
    while (!line_.empty() && is_blank(line_.front())) {
        line_.remove_prefix(1);
    }
    return line_.empty();
}

std::string_view TextReader::rest()
{
    at_line_end();
    return line_.substr(0, line_.find_last_not_of(kBlanks) + 1);
}

std::string_view TextReader::read_word(const char* what)
{
    if (at_line_end()) fail(fmt::format("the line ends, expected {}", what));
    const auto end = std::find_if(line_.begin(), line_.end(), is_blank);
    const std::string_view word(line_.begin(), end);
    line_.remove_prefix(word.size());
    return word;
}

template <typename T>
T TextReader::read_number(const char* what, const char* kind)
{
    const std::string_view word = read_word(what);
    std::string_view digits = word;
    // std::from_chars rejects a plus sign
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
        fail(fmt::format("found '{}', expected {} ({})", printable(word), what, kind));
    }
    return value;
}

double TextReader::read_double(const char* what)
{
    return read_number<double>(what, "a number");
}

std::uint8_t TextReader::read_uint8(const char* what)
{
    return read_number<std::uint8_t>(what, "an integer from 0 to 255");
}

std::uint32_t TextReader::read_uint32(const char* what)
{
    return read_number<std::uint32_t>(what, "an unsigned 32-bit integer");
}

std::uint64_t TextReader::read_uint64(const char* what)
{
    return read_number<std::uint64_t>(what, "an unsigned 64-bit integer");
}

/// Reads the next word if it is a negative integer. Returns whether it is.
bool TextReader::take_none()
{
    if (at_line_end() || line_.front() != '-') return false;
    const std::size_t end = std::min(line_.find_first_not_of("0123456789", 1), line_.size());
    if (end == 1 || (end < line_.size() && !is_blank(line_[end]))) return false;
    line_.remove_prefix(end);
    return true;
}

std::uint32_t TextReader::read_uint32_or_none(const char* what)
{
    return take_none() ? ~std::uint32_t{0} : read_uint32(what);
}

std::uint64_t TextReader::read_uint64_or_none(const char* what)
{
    return take_none() ? ~std::uint64_t{0} : read_uint64(what);
}

void TextReader::fail(const std::string& sentence) const
{
    throw InputError(fmt::format("{}: line {}: {}", name_, line_number_, sentence));
}

} // namespace vcarve
