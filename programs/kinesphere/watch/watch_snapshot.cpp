// The state of a watch in a file, from which a later run continues.
#include "watch/watch_snapshot.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <ostream>
#include <streambuf>

#include "base/output_file.hpp"
#include "base/program_error.hpp"
#include "watch/checksum.hpp"

namespace kinesphere::program {
namespace {

/// The file begins with this title, the length of the rest and its checksum, each as at least eight
/// hexadecimal digits; then comes CBOR. Increase the number when the fields change.
constexpr std::string_view snapshot_title = "kinesphere watch snapshot 13\n";

std::string heading(std::uint64_t size, std::uint32_t check) {
  return fmt::format("{}{:016x} {:08x}\n", snapshot_title, size, check);
}
std::string heading(std::string_view content) { return heading(content.size(), checksum(content)); }

/// A stream buffer that passes its output to a function.
class CallingBuffer final : public std::streambuf {
 public:
  using Take = std::function<void(std::string_view)>;
  explicit CallingBuffer(Take take) : take_(std::move(take)) {}

 protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    take_({text, static_cast<std::size_t>(size)});
    return size;
  }
  int_type overflow(int_type character) override {
    const char written = traits_type::to_char_type(character);
    take_({&written, 1});
    return character;
  }

 private:
  Take take_;
};

/// Writes CBOR piece by piece, which saves a copy of the whole state.
void write_cbor(const nlohmann::json& json, CallingBuffer::Take take) {
  CallingBuffer buffer(std::move(take));
  std::ostream stream(&buffer);
  nlohmann::json::to_cbor(json, stream);
}

}  // namespace

void write_snapshot(const std::string& path, WatchSnapshot snapshot) {
  auto& [options, format, place, line, reader, watcher, alerts, alerts_place] = snapshot;
  const nlohmann::json json{{"options", options},
                            {"format", format},
                            {"stream", place.stream},
                            {"position", place.position},
                            {"check", place.check},
                            {"line", {line.number, line.is_passed_over}},
                            {"reader", std::move(reader)},
                            {"watcher", std::move(watcher)},
                            {"alerts", alerts},
                            {"alerts_place", {alerts_place.bytes, alerts_place.check}}};
  std::uint64_t size = 0;
  std::uint32_t check = 0;
  write_cbor(json, [&](std::string_view piece) {
    size += piece.size();
    check = checksum(piece, check);
  });
  // The incomplete file of a killed run is overwritten.
  OutputFile file(OutputPlace{path, 0});
  file.write(heading(size, check));
  write_cbor(json, [&](std::string_view piece) { file.write(piece); });
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
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) throw ProgramError(fmt::format("{}: cannot read", path));
  const std::string_view content = std::string_view(text).substr(std::min(heading("").size(), text.size()));
  if (!text.starts_with(snapshot_title))
    throw ProgramError(fmt::format("{}: expected a snapshot of this version of kinesphere watch", path));
  if (!text.starts_with(heading(content)))
    throw ProgramError(fmt::format("{}: expected a snapshot of kinesphere watch, but it is damaged", path));
  try {
    auto json = nlohmann::json::from_cbor(content);
    return WatchSnapshot{.options = json.at("options"),
                         .format = json.at("format"),
                         .place = {json.at("stream"), json.at("position"), json.at("check")},
                         .line = {json.at("line").at(0), json.at("line").at(1)},
                         .reader = json.at("reader"),
                         .watcher = std::move(json.at("watcher")),
                         .alerts = json.at("alerts"),
                         .alerts_place = {json.at("alerts_place").at(0), json.at("alerts_place").at(1)}};
  } catch (const nlohmann::json::exception&) {
    throw ProgramError(fmt::format("{}: expected a snapshot of kinesphere watch, but it is none", path));
  }
}

void check_options(const std::string& path, const GivenOptions& then, const GivenOptions& now) {
  const auto text = [](const std::string& given) { return given.empty() ? "not given" : "'" + given + "'"; };
  for (std::size_t k = 0; k < std::min(then.size(), now.size()); ++k)
    if (then[k] != now[k])
      throw ProgramError(
          fmt::format("{}: expected it as it was for the snapshot {}, where it was {}, but it is {}",
                      now[k].first, path, text(then[k].second), text(now[k].second)));
  if (then.size() != now.size())
    throw ProgramError(fmt::format("{}: expected a snapshot of kinesphere watch, but it is none", path));
}

}  // namespace kinesphere::program
