#include "ranks.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <utility>

namespace kinesphere::program {
namespace {

constexpr std::size_t events_of_a_block = 4096;
constexpr int events_tag = 1;

/// The events of another rank, one block at a time. The last block is not full, and may be empty.
class IncomingEvents {
 public:
  explicit IncomingEvents(int from) : from_(from) { receive(); }

  /// Returns null after the last event.
  const OrderedEvent* next() const { return at_ < block_.size() ? &block_[at_] : nullptr; }
  void advance() {
    if (++at_ == events_of_a_block) receive();
  }

 private:
  void receive() {
    block_.resize(events_of_a_block);
    at_ = 0;
    MPI_Status status;
    MPI_Recv(block_.data(), static_cast<int>(events_of_a_block * sizeof(OrderedEvent)), MPI_BYTE, from_,
             events_tag, MPI_COMM_WORLD, &status);
    int bytes = 0;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    block_.resize(static_cast<std::size_t>(bytes) / sizeof(OrderedEvent));
  }

  int from_;
  std::vector<OrderedEvent> block_;
  std::size_t at_ = 0;
};

void send_to_first(std::span<const OrderedEvent> events) {
  for (;;) {
    const auto block = events.first(std::min(events.size(), events_of_a_block));
    MPI_Send(block.data(), static_cast<int>(block.size_bytes()), MPI_BYTE, 0, events_tag, MPI_COMM_WORLD);
    if (block.size() < events_of_a_block) return;
    events = events.subspan(block.size());
  }
}

/// Returns the message of an exception that `action` throws.
std::optional<std::string> problem_of(const std::function<void()>& action) {
  try {
    action();
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& thrown) {
    return thrown.what();
  }
}

}  // namespace

Ranks::Ranks() {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

void Ranks::together(int exit_code, const std::function<void()>& action) const {
  static_assert(std::is_trivially_copyable_v<OrderedEvent>);
  const std::optional<std::string> problem = problem_of(action);
  int failing = problem ? rank_ : count_;
  MPI_Allreduce(MPI_IN_PLACE, &failing, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (failing == count_) return;
  std::string message = problem.value_or("");
  auto size = static_cast<std::uint64_t>(message.size());
  MPI_Bcast(&size, 1, MPI_UINT64_T, failing, MPI_COMM_WORLD);
  message.resize(size);
  MPI_Bcast(message.data(), static_cast<int>(size), MPI_CHAR, failing, MPI_COMM_WORLD);
  throw SharedError(failing == 0 ? message : fmt::format("rank {}: {}", failing, message), exit_code);
}

void Ranks::on_first(int exit_code, const std::function<void()>& action) const {
  together(
      exit_code, is_first() ? action : [] {});
}

void Ranks::sum(std::span<std::uint64_t> numbers) const {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T, MPI_SUM,
                MPI_COMM_WORLD);
}

std::uint64_t Ranks::largest(std::uint64_t number) const {
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
  return number;
}

std::string Ranks::from_first(const std::string& text) const {
  std::string shared = text;
  auto size = static_cast<std::uint64_t>(shared.size());
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  shared.resize(size);
  MPI_Bcast(shared.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
  return shared;
}

void Ranks::gather_bytes(const void* own, void* all, std::size_t size) const {
  MPI_Allgather(own, static_cast<int>(size), MPI_BYTE, all, static_cast<int>(size), MPI_BYTE, MPI_COMM_WORLD);
}

void Ranks::merge(std::span<const OrderedEvent> own, const std::function<void(const Event&)>& take) const {
  if (!is_first()) return send_to_first(own);
  std::vector<IncomingEvents> incoming;
  incoming.reserve(static_cast<std::size_t>(count_));
  for (int from = 1; from < count_; ++from) incoming.emplace_back(from);
  // A heap with the earliest event at the front.
  using Source = std::pair<const OrderedEvent*, IncomingEvents*>;
  const auto later = [](const Source& a, const Source& b) { return *b.first < *a.first; };
  std::vector<Source> sources;
  if (!own.empty()) sources.emplace_back(own.data(), nullptr);
  for (IncomingEvents& events : incoming)
    if (events.next() != nullptr) sources.emplace_back(events.next(), &events);
  std::make_heap(sources.begin(), sources.end(), later);
  while (!sources.empty()) {
    std::pop_heap(sources.begin(), sources.end(), later);
    auto& [event, from] = sources.back();
    take(event->event);
    if (from != nullptr) {
      from->advance();
      event = from->next();
    } else {
      event = event + 1 < own.data() + own.size() ? event + 1 : nullptr;
    }
    if (event == nullptr) {
      sources.pop_back();
    } else {
      std::push_heap(sources.begin(), sources.end(), later);
    }
  }
}

}  // namespace kinesphere::program
