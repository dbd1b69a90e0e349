// Names of bodies: comparison, printing, hashing and packing.
#include "kinesphere/body_id.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <unordered_map>

namespace kinesphere::body_id_test {
namespace {

TEST(BodyIds, PrintTheirIndexAndWhatGenerationTheyAreOf) {
  EXPECT_EQ(to_string(BodyId{7, 0}), "7");
  EXPECT_EQ(to_string(BodyId{7, 2, 5}), "7 (generation 2)");
  EXPECT_EQ(to_string(no_body), "no_body");
  std::ostringstream out;
  out << BodyId{7, 2} << " and " << BodyId{8, 0};
  EXPECT_EQ(out.str(), "7 (generation 2) and 8");
}

TEST(BodyIds, PackIntoANumberAndBack) {
  for (const BodyId id : {BodyId{0, 0}, BodyId{7, 2}, BodyId{0xfffffffe, 0xffffffff}, no_body})
    EXPECT_EQ(BodyId::unpack(id.pack()), id);
  EXPECT_EQ((BodyId{7, 2, 9}).pack(), 0x200000007u);
  EXPECT_EQ(BodyId::unpack(BodyId{7, 2, 9}.pack()).world, 0u);
}

TEST(BodyIds, CompareAndHashWithoutTheWorldThatGaveThemOut) {
  EXPECT_EQ((BodyId{3, 1, 1}), (BodyId{3, 1, 2}));
  EXPECT_LT((BodyId{3, 1, 2}), (BodyId{3, 2, 1}));
  EXPECT_LT((BodyId{3, 9}), (BodyId{4, 0}));
  std::unordered_map<BodyId, int> table{{{3, 1, 1}, 30}, {{4, 0, 1}, 40}};
  EXPECT_EQ(table.at({3, 1, 2}), 30);
  EXPECT_FALSE(table.contains({3, 0}));
}

}  // namespace
}  // namespace kinesphere::body_id_test
