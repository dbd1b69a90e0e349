// Records of Vissim (.fzp) and Viswalk (.pp): comments, names behind $VEHICLE: or $PEDESTRIAN:, rows.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {
namespace {

/// Returns the names of a line $VEHICLE:SIMSEC;NO;...; empty for another line.
std::vector<std::string_view> vissim_names(std::string_view line) {
  for (const std::string_view kind : {"$VEHICLE:", "$PEDESTRIAN:"})
    if (line.starts_with(kind)) return fields_of(line.substr(kind.size()), ';');
  return {};
}

/// Where the attributes are in a row: a column for each coordinate, or one with all of them between blanks.
struct VissimColumns {
  std::size_t id = 0, time = 0;
  std::vector<std::size_t> coordinates;
  bool are_in_one = false;
  std::string_view attribute;  ///< COORDFRONT, for example
};

std::optional<VissimColumns> vissim_columns(const std::vector<std::string_view>& names) {
  const auto place = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto found =
        std::ranges::find_if(names, [&](std::string_view each) { return same_name(each, name); });
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - names.begin()));
  };
  const auto id = place("NO"), time = place("SIMSEC");
  if (!id || !time) return std::nullopt;
  for (const std::string_view attribute : {"COORDFRONT", "COORDCENT", "COORDREAR"}) {
    VissimColumns columns{.id = *id, .time = *time, .coordinates = {}, .attribute = attribute};
    for (const char axis : {'X', 'Y', 'Z'})
      if (const auto column = place(fmt::format("{}{}", attribute, axis)))
        columns.coordinates.push_back(*column);
    if (columns.coordinates.size() >= 2) return columns;
    if (const auto column = place(std::string(attribute))) {
      columns.coordinates = {*column};
      columns.are_in_one = true;
      return columns;
    }
  }
  return std::nullopt;
}

class VissimReader {
 public:
  explicit VissimReader(const RecordingText& recording) : lines_(recording.text), file_(recording.file) {}

  RowTable read() {
    std::vector<std::string_view> names;
    while (names.empty()) {
      const auto line = lines_.next();
      if (!line) fail("the names of attributes behind $VEHICLE: or $PEDESTRIAN:");
      names = vissim_names(*line);
    }
    const auto columns = vissim_columns(names);
    if (!columns)
      fail(
          "the attributes NO, SIMSEC and COORDFRONTX, COORDFRONTY (or COORDFRONT, COORDCENTX, COORDCENTY), "
          "which are chosen where Vissim is told to record vehicles or pedestrians: links and places on them "
          "are no positions");
    table_.format = fmt::format("Vissim ({})", columns->attribute);
    while (const auto line = lines_.next())
      if (!line->empty() && !line->starts_with('*') && !line->starts_with('$'))
        add_row(*columns, *line, names.size());
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::string_view expected) const {
    throw ProgramError(fmt::format("{}:{}: expected {}", file_, lines_.line(), expected));
  }

  void add_row(const VissimColumns& columns, std::string_view line, std::size_t count) {
    const auto fields = fields_of(line, ';');
    if (fields.size() < count) fail(fmt::format("{} fields, but got {}", count, fields.size()));
    std::vector<std::string_view> place;
    if (columns.are_in_one) {
      place = words_of(fields[columns.coordinates.front()]);
    } else {
      for (const std::size_t column : columns.coordinates) place.push_back(fields[column]);
    }
    if (place.size() < 2)
      fail(fmt::format("two or three coordinates as {}, but got {}", columns.attribute,
                       shown_field(fields[columns.coordinates.front()])));
    dimensions_ = dimensions_.value_or(std::min<std::size_t>(place.size(), 3));
    if (place.size() < *dimensions_)
      fail(fmt::format("{} coordinates as {}", *dimensions_, columns.attribute));
    table_.add_row(lines_.line(), fields[columns.id], fields[columns.time], place[0], place[1]);
    if (*dimensions_ == 3) table_.set(table_.column_of("z"), place[2]);
  }

  LineCutter lines_;
  const std::string& file_;
  RowTable table_{"", {"id", "time", "x", "y"}};
  std::optional<std::size_t> dimensions_;
};

}  // namespace

bool is_vissim(std::string_view text) {
  return text.starts_with("$VISION") || text.starts_with("$VEHICLE:") || text.starts_with("$PEDESTRIAN:");
}

RowTable read_vissim(const RecordingText& recording) { return VissimReader(recording).read(); }

}  // namespace kinesphere::program
