// Runs the tests on all ranks. Rank 0 prints as usual, the others print failures. The run fails if a test has
// failed on any rank. A rank that cannot continue a test stops all ranks, since the others would wait for it.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <sstream>
#include <string>

#include "distributed/communicator.hpp"
#include "kinesphere/distributed/mpi_session.hpp"

namespace kinesphere {
namespace {

class Failures : public testing::EmptyTestEventListener {
 public:
  explicit Failures(const MpiSession& session) : session_(session) {}

  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    if (session_.rank() != 0) {
      std::ostringstream text;
      text << "rank " << session_.rank() << ": " << result << "\n";
      std::fputs(text.str().c_str(), stdout);
    }
    if (result.fatally_failed() && session_.ranks() > 1) {
      std::printf("a test cannot go on on rank %d\n", session_.rank());
      std::fflush(stdout);
      session_.abort(1);
    }
  }

 private:
  const MpiSession& session_;
};

int run_tests(const MpiSession& session) {
  Communicator communicator;
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  if (communicator.rank() != 0) delete listeners.Release(listeners.default_result_printer());
  Failures failures(session);
  listeners.Append(&failures);
  const bool failed = RUN_ALL_TESTS() != 0;
  listeners.Release(&failures);
  // A filter that matches no test is a mistake.
  const bool none = testing::UnitTest::GetInstance()->test_to_run_count() == 0;
  return communicator.sum(std::uint64_t{failed || none}) > 0 ? 1 : 0;
}

}  // namespace
}  // namespace kinesphere

int main(int argc, char** argv) {
  const kinesphere::MpiSession session(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  return kinesphere::run_tests(session);
}
