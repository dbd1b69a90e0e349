#include "distributed/communicator.hpp"

#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <numeric>
#include <string>
#include <utility>

namespace kinesphere {
namespace {

/// Maximum bytes per MPI message; MPI counts are int, so longer messages are split.
constexpr std::size_t longest_piece = std::size_t{1} << 30;

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

MPI_Comm comm_of(std::optional<int> fortran_handle) {
  return fortran_handle ? MPI_Comm_f2c(*fortran_handle) : MPI_COMM_WORLD;
}

template <class Begin>
void begin_pieces(std::size_t bytes, Begin begin) {
  for (std::size_t at = 0; at < bytes; at += longest_piece)
    begin(at, static_cast<int>(std::min(longest_piece, bytes - at)));
}

}  // namespace

struct Communicator::Handle {
  MPI_Comm comm = MPI_COMM_NULL;
};

class Communicator::Timer {
 public:
  explicit Timer(Traffic& traffic) : traffic_(traffic), begin_(processor_seconds()) {
    ++traffic_.collectives;
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  ~Timer() { traffic_.seconds += processor_seconds() - begin_; }

 private:
  Traffic& traffic_;
  double begin_;
};

Result<void> Communicator::check(std::optional<int> fortran_handle, std::string_view call) {
  const MPI_Comm comm = comm_of(fortran_handle);
  const auto error = [&](const char* what) {
    return Error{ErrorCode::unsupported, "communicator", no_body,
                 std::string(call) + ": communicator " + what};
  };
  if (comm == MPI_COMM_NULL)
    return error("is MPI_COMM_NULL; only the ranks that are in it may make the call");
  int has_two_groups = 0;
  MPI_Comm_test_inter(comm, &has_two_groups);
  if (has_two_groups != 0)
    return error("is an intercommunicator; MPI_Intercomm_merge() makes one group of it");
  return {};
}

Communicator::Communicator(std::optional<int> fortran_handle) : handle_(new Handle) {
  MPI_Comm_dup(comm_of(fortran_handle), &handle_->comm);
  MPI_Comm_rank(handle_->comm, &rank_);
  MPI_Comm_size(handle_->comm, &ranks_);
}

int Communicator::fortran_handle() const { return MPI_Comm_c2f(handle_->comm); }

Communicator::~Communicator() {
  int over = 0;
  MPI_Finalized(&over);
  if (over == 0) MPI_Comm_free(&handle_->comm);
  delete handle_;
}

void Communicator::sum(std::span<std::uint64_t> numbers) {
  const Timer timer(traffic_);
  if (ranks_ > 1)
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T, MPI_SUM,
                  handle_->comm);
  traffic_.bytes += numbers.size_bytes();
}

void Communicator::sum(std::span<double> numbers) {
  const std::vector<Bytes> all = gather(std::as_bytes(numbers));
  std::fill(numbers.begin(), numbers.end(), 0.0);
  for (const Bytes& bytes : all) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      double number = 0.0;
      std::memcpy(&number, bytes.data() + k * sizeof(double), sizeof(double));
      numbers[k] += number;
    }
  }
}

void Communicator::least(std::span<double> numbers) {
  const Timer timer(traffic_);
  if (ranks_ > 1)
    MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MIN,
                  handle_->comm);
  traffic_.bytes += numbers.size_bytes();
}

std::vector<Communicator::Bytes> Communicator::gather(std::span<const std::byte> bytes) {
  const Timer timer(traffic_);
  if (ranks_ == 1) return {Bytes(bytes.begin(), bytes.end())};
  const std::uint64_t here = bytes.size();
  std::vector<std::uint64_t> lengths(static_cast<std::size_t>(ranks_));
  MPI_Allgather(&here, 1, MPI_UINT64_T, lengths.data(), 1, MPI_UINT64_T, handle_->comm);
  if (std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{0}) > longest_piece)
    return exchange(std::vector<Bytes>(lengths.size(), Bytes(bytes.begin(), bytes.end())));
  const std::vector<int> sizes(lengths.begin(), lengths.end());
  std::vector<int> places(sizes.size());
  std::exclusive_scan(sizes.begin(), sizes.end(), places.begin(), 0);
  Bytes all(static_cast<std::size_t>(places.back() + sizes.back()));
  MPI_Allgatherv(bytes.data(), static_cast<int>(here), MPI_BYTE, all.data(), sizes.data(), places.data(),
                 MPI_BYTE, handle_->comm);
  traffic_.bytes += bytes.size() * static_cast<std::size_t>(ranks_ - 1);
  std::vector<Bytes> of_ranks;
  for (std::size_t rank = 0; rank < sizes.size(); ++rank)
    of_ranks.emplace_back(all.begin() + places[rank], all.begin() + places[rank] + sizes[rank]);
  return of_ranks;
}

std::vector<Communicator::Bytes> Communicator::exchange(std::vector<Bytes> outgoing) {
  const Timer timer(traffic_);
  std::vector<Bytes> incoming(outgoing.size());
  const auto own = static_cast<std::size_t>(rank_);
  std::swap(incoming[own], outgoing[own]);
  if (ranks_ == 1) return incoming;
  std::vector<std::uint64_t> sizes;
  sizes.reserve(outgoing.size());
  for (const Bytes& bytes : outgoing) sizes.push_back(bytes.size());
  std::vector<std::uint64_t> sizes_in(sizes.size());
  MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, sizes_in.data(), 1, MPI_UINT64_T, handle_->comm);
  std::vector<MPI_Request> requests;
  for (std::size_t from = 0; from < sizes_in.size(); ++from) {
    if (from == own) continue;
    incoming[from].resize(sizes_in[from]);
    begin_pieces(sizes_in[from], [&](std::size_t at, int size) {
      MPI_Irecv(incoming[from].data() + at, size, MPI_BYTE, static_cast<int>(from), 0, handle_->comm,
                &requests.emplace_back());
    });
  }
  for (std::size_t to = 0; to < outgoing.size(); ++to) {
    if (to == own) continue;
    begin_pieces(outgoing[to].size(), [&](std::size_t at, int size) {
      MPI_Isend(outgoing[to].data() + at, size, MPI_BYTE, static_cast<int>(to), 0, handle_->comm,
                &requests.emplace_back());
      ++traffic_.messages;
    });
    traffic_.bytes += outgoing[to].size();
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return incoming;
}

}  // namespace kinesphere
