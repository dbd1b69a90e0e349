// The state of a watch in a file, from which a later run continues.
#include "watch/watch_snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>

#include "archive/archive.hpp"
#include "archive/envelope.hpp"
#include "base/output_file.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

/// Raise the version when the fields change, or when a watch would continue differently from equal fields.
constexpr Envelope envelope{
    {'K', 'i', 'n', 'W', 'a', 't', '\r', '\n'}, 15, "watch", "watch", "snapshot", ErrorCode::bad_snapshot};
/// Snapshots of 1.0 begin with this text.
constexpr std::string_view earlier_title = "kinesphere watch snapshot ";

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) throw ProgramError(fmt::format("{}: cannot read", path));
  return text;
}

}  // namespace

void write_snapshot(const std::string& path, WatchSnapshot snapshot) {
  ByteWriter content;
  content(snapshot);
  // A large state is in memory several times as it is.
  snapshot = {};
  const std::vector<std::byte> bytes = envelope.seal(content.bytes());
  // The incomplete file of a killed run is overwritten.
  OutputFile file(OutputPlace{path, 0});
  file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  file.sync();
  file.commit();
}

std::optional<WatchSnapshot> read_snapshot(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return std::nullopt;
  // Some things that are not regular files have no end.
  if (!error && !std::filesystem::is_regular_file(status))
    throw ProgramError(fmt::format("--snapshot: expected a file, but {} is something else", path));
  const std::string text = read_file(path);
  if (text.starts_with(earlier_title))
    throw ProgramError(fmt::format("{}: expected a snapshot of this version of kinesphere watch", path));
  const auto content = envelope.open(std::as_bytes(std::span(text)));
  if (!content)
    throw ProgramError(fmt::format("{}: expected a snapshot of this version of kinesphere watch: {}", path,
                                   message_of(content.error())));
  ByteReader reader(*content);
  WatchSnapshot snapshot;
  reader(snapshot);
  if (reader.failed() || reader.remaining() != 0) refuse_snapshot(path);
  return snapshot;
}

void refuse_snapshot(const std::string& path) {
  throw ProgramError(fmt::format("{}: expected a snapshot of kinesphere watch, but it is none", path));
}

void check_options(const std::string& path, const GivenOptions& then, const GivenOptions& now) {
  const auto text = [](const std::string& given) { return given.empty() ? "not given" : "'" + given + "'"; };
  for (std::size_t k = 0; k < std::min(then.size(), now.size()); ++k)
    if (then[k] != now[k])
      throw ProgramError(
          fmt::format("{}: expected it as it was for the snapshot {}, where it was {}, but it is {}",
                      now[k].first, path, text(then[k].second), text(now[k].second)));
  if (then.size() != now.size()) refuse_snapshot(path);
}

}  // namespace kinesphere::program
