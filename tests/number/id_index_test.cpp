// IdIndex finds what a std::map finds, after additions and removals of ids of several kinds.
#include "number/id_index.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "kinesphere/random.hpp"

namespace kinesphere::id_index_test {
namespace {

TEST(IdIndex, FindsWhatAMapFinds) {
  for (const std::uint64_t ids : {12u, 300u, 5'000u})
    for (const int shift : {0, 20, 48}) {
      SCOPED_TRACE(testing::Message() << ids << " ids, multiples of 2^" << shift);
      Random random(45);
      IdIndex index;
      std::map<std::uint64_t, std::uint32_t> all;
      EXPECT_EQ(index.find(0), IdIndex::none);
      for (std::uint32_t step = 0; step < 20'000; ++step) {
        const std::uint64_t id = random.bits() % ids << shift;
        const auto known = all.find(id);
        ASSERT_EQ(index.find(id), known == all.end() ? IdIndex::none : known->second);
        // More additions than removals at first, then fewer, so that the table fills and empties.
        if (random.bits() % 20'000 >= step) {
          ASSERT_EQ(index.add(id, step), all.emplace(id, step).second);
        } else if (known != all.end()) {
          index.remove(id);
          all.erase(known);
        }
        ASSERT_EQ(index.size(), all.size());
      }
      for (std::uint64_t id = 0; id < ids; ++id) {
        const auto known = all.find(id << shift);
        ASSERT_EQ(index.find(id << shift), known == all.end() ? IdIndex::none : known->second);
      }
      index.clear();
      EXPECT_EQ(index.size(), 0u);
      EXPECT_TRUE(index.add(1, 2));
    }
}

}  // namespace
}  // namespace kinesphere::id_index_test
