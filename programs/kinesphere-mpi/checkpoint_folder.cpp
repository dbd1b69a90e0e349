#include "checkpoint_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t checkpoints_kept = 2;
constexpr int state_format = 1;
constexpr std::array contact_outputs{"none", "one file", "file per rank"};

[[noreturn]] void fail(const std::string& path, const char* what, int error) {
  throw ProgramError(fmt::format("{}: cannot {}: {}", path, what, std::strerror(error)));
}

/// Keeps a file or folder open for its lifetime.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : path_(path), number_(::open(path.c_str(), flags, 0666)) {
    if (number_ < 0) fail(path_, "write", errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  void write(const char* bytes, std::size_t size) {
    while (size > 0) {
      const ssize_t written = ::write(number_, bytes, size);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path_, "write", errno);
      bytes += written;
      size -= static_cast<std::size_t>(written);
    }
  }
  /// Locks it for its lifetime. Returns false if another process has done so.
  bool lock() { return ::flock(number_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK; }
  void sync() {
    if (::fsync(number_) != 0) fail(path_, "write", errno);
  }

 private:
  std::string path_;
  int number_;
};

void write_to_disk(const std::string& path, const char* bytes, std::size_t size) {
  Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
  file.write(bytes, size);
  file.sync();
}

/// Flushes created, renamed and deleted entries of a folder to the disk.
void sync_folder(const std::string& path) { Descriptor(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC).sync(); }

/// Keeps others from the folder until the result is gone, which the system sees to if the process is killed.
/// Some file systems have no locks of folders; there nothing is kept.
std::shared_ptr<void> locked(const std::string& folder) {
  const auto lock = std::make_shared<Descriptor>(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (!lock->lock())
    throw ProgramError(
        fmt::format("--checkpoint: expected a folder of this run alone, but another one uses {}", folder));
  return lock;
}

std::string checksum_line(const std::string& text) {
  const auto sum =
      ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<unsigned int>(text.size()));
  return fmt::format("{:08x}\n", sum);
}

std::string text_of(const RunState& state) {
  nlohmann::ordered_json json;
  json["format"] = state_format;
  json["scene"] = state.scene;
  json["time"] = state.time;
  json["parts"] = state.parts;
  json["events"] = state.hash[1];
  json["hash"] = state.hash[0];
  json["contacts"] = contact_outputs[static_cast<std::size_t>(state.contacts)];
  json["contact_bytes"] = state.contact_lengths;
  const std::string text = json.dump(1) + '\n';
  return text + checksum_line(text);
}

/// Throws nlohmann::json::exception or ProgramError.
RunState state_of(const std::string& path, const std::string& all) {
  constexpr std::size_t checksum_size = 9;
  const std::size_t size = all.size() - std::min(all.size(), checksum_size);
  const std::string text = all.substr(0, size);
  if (all.substr(size) != checksum_line(text))
    throw ProgramError(fmt::format("{}: expected what a run has written, but it is damaged", path));
  const auto json = nlohmann::json::parse(text);
  if (const int format = json.at("format"); format != state_format)
    throw ProgramError(fmt::format("{}: expected format {}, but got {}", path, state_format, format));
  RunState state;
  json.at("scene").get_to(state.scene);
  json.at("time").get_to(state.time);
  json.at("parts").get_to(state.parts);
  json.at("hash").get_to(state.hash[0]);
  json.at("events").get_to(state.hash[1]);
  json.at("contact_bytes").get_to(state.contact_lengths);
  const std::string contacts = json.at("contacts");
  const auto* const output = std::find(contact_outputs.begin(), contact_outputs.end(), contacts);
  if (output == contact_outputs.end())
    throw ProgramError(fmt::format("{}: expected contacts of a known kind, but got {}", path, contacts));
  state.contacts = static_cast<ContactOutput>(output - contact_outputs.begin());
  return state;
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, "read", errno);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) fail(path, "read", EIO);
  return text;
}

std::string part_path(const std::string& checkpoint, std::uint64_t part) {
  return fmt::format("{}/part-{}", checkpoint, part);
}
std::string state_path(const std::string& checkpoint) { return checkpoint + "/run.json"; }

std::optional<std::uint64_t> number_of(const std::string& name) {
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || stop != name.data() + name.size() || number == 0) return std::nullopt;
  return number;
}

/// Newest first.
std::vector<std::uint64_t> numbers_in(const std::string& folder) {
  std::vector<std::uint64_t> numbers;
  std::error_code error;
  if (!fs::exists(folder, error)) return numbers;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto number = number_of(entry.path().filename().string())) numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end(), std::greater<>());
  return numbers;
}

}  // namespace

CheckpointFolder::CheckpointFolder(const Ranks& ranks, std::string folder)
    : ranks_(ranks), folder_(std::move(folder)) {
  ranks_.on_first(1, [this] { fs::create_directories(folder_); });
  ranks_.on_first(exit_wrong_input, [this] { lock_ = locked(folder_); });
  const std::vector<std::uint64_t> numbers = latest();
  if (!numbers.empty()) next_ = numbers.front() + 1;
}

std::string CheckpointFolder::path(std::uint64_t number) const {
  return fmt::format("{}/{}", folder_, number);
}

void CheckpointFolder::write(const Part& part, const RunState& state) {
  const std::string unfinished = path(next_) + ".tmp";
  try {
    write_unfinished(unfinished, part, state);
  } catch (const SharedError&) {
    // On a full disk the incomplete checkpoint would block other output.
    std::error_code ignored;
    if (ranks_.is_first()) fs::remove_all(unfinished, ignored);
    throw;
  }
  ranks_.on_first(1, [&] {
    fs::rename(unfinished, path(next_));
    sync_folder(folder_);
    const std::vector<std::uint64_t> numbers = numbers_in(folder_);
    for (std::size_t k = checkpoints_kept; k < numbers.size(); ++k) fs::remove_all(path(numbers[k]));
  });
  ++next_;
}

void CheckpointFolder::write_unfinished(const std::string& folder, const Part& part,
                                        const RunState& state) const {
  ranks_.on_first(1, [&] {
    fs::remove_all(folder);
    fs::create_directory(folder);
  });
  ranks_.together(1, [&] {
    write_to_disk(part_path(folder, static_cast<std::uint64_t>(ranks_.rank())),
                  reinterpret_cast<const char*>(part.data()), part.size());
  });
  ranks_.on_first(1, [&] {
    const std::string text = text_of(state);
    write_to_disk(state_path(folder), text.data(), text.size());
    sync_folder(folder);
  });
}

std::vector<std::uint64_t> CheckpointFolder::latest() const {
  std::vector<std::uint64_t> numbers;
  ranks_.on_first(1, [&] { numbers = numbers_in(folder_); });
  std::uint64_t count = numbers.size();
  count = ranks_.largest(count);
  numbers.resize(count);
  ranks_.sum(numbers);
  return numbers;
}

RunState CheckpointFolder::read_state(std::uint64_t number) const {
  const std::string file = state_path(path(number));
  std::string text;
  ranks_.on_first(1, [&] {
    text = read_file(file);
    state_of(file, text);
  });
  return state_of(file, ranks_.from_first(text));
}

std::vector<CheckpointFolder::Part> CheckpointFolder::read_parts(std::uint64_t number,
                                                                 const RunState& state) const {
  std::vector<Part> parts;
  const auto count = static_cast<std::uint64_t>(ranks_.count());
  for (auto part = static_cast<std::uint64_t>(ranks_.rank()); part < state.parts; part += count) {
    try {
      const std::string text = read_file(part_path(path(number), part));
      const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
      parts.emplace_back(bytes, bytes + text.size());
    } catch (const ProgramError& error) {
      fmt::print(stderr, "kinesphere-mpi: rank {}: {}\n", ranks_.rank(), error.what());
    }
  }
  return parts;
}

void CheckpointFolder::set_aside(std::uint64_t number) {
  ranks_.on_first(1, [&] {
    const std::string refused = path(number) + ".refused";
    fs::remove_all(refused);
    fs::rename(path(number), refused);
    sync_folder(folder_);
  });
  next_ = std::min(next_, number);
}

}  // namespace kinesphere::program
