// What a file does not say: questions, all of which are asked at once.
#pragma once

#include <functional>
#include <string>

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Sets the hint that an error asks for, as its message says it: the columns or rows that it proposes (those
/// that keep what it asks about), a unit, what positions are. Returns false for an error that proposes none.
bool assume_answer(const std::string& question, ColumnHints& hints);

/// Calls `read` with these hints and, as long as it throws a ProgramError that asks for a hint, again with
/// what that proposes. The first question is thrown alone if it is the only one, else all of them in one
/// message. Where it is the order of day and month that is asked for, and one alone fits all dates, that is
/// the hint, and no question.
void ask_all(ColumnHints hints, const std::function<void(const ColumnHints&)>& read);

}  // namespace kinesphere::program
