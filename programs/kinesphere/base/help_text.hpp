// The text of --help, and words for misspelt ones.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// Its header takes longer to compile than most sources.
namespace CLI {
class App;
class FormatterBase;
}  // namespace CLI

namespace kinesphere::program {

/// Returns the formatter of help: 80 columns, broken at words.
std::shared_ptr<CLI::FormatterBase> make_help_formatter();

/// Ends the help of a command with examples. `lines`: what is typed, each of at most 78 characters.
void add_examples(CLI::App& command, std::initializer_list<std::string_view> lines);

/// Returns the word of `known` that a misspelt one most likely means: it begins so, or differs in a third of
/// its letters at most. Empty if there is none.
std::string_view meant_word(std::string_view word, const std::vector<std::string>& known);

/// Returns the text in lines of at most `width` characters, broken at blanks and, where a word is too long,
/// behind | and commas. Lines that begin with a blank stay as they are.
std::vector<std::string> broken_lines(std::string_view text, std::size_t width);

}  // namespace kinesphere::program
