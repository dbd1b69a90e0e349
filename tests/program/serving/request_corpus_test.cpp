// Replays the requests by which fuzz_http has reached different code, against a real server.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "program/serving/any_request.hpp"
#include "program/serving/raw_connection.hpp"

namespace kinesphere::program::request_corpus_test {
namespace {

TEST(RequestCorpus, IsAnsweredWithContentAlone) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(KINESPHERE_CORPUS) / "http"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  EXPECT_GT(files.size(), 10u);
  AttackedServer server;
  std::set<int> statuses;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), {}};
    const auto complaint = server.complaint(bytes);
    EXPECT_FALSE(complaint) << file << ": " << *complaint << "\n" << server.response();
    statuses.insert(status_of(server.response()));
  }
  for (const int status : {200, 400, 403, 404, 405, 431, 500})
    EXPECT_EQ(statuses.count(status), 1u) << status;
}

}  // namespace
}  // namespace kinesphere::program::request_corpus_test
