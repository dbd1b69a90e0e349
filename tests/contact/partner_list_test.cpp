// Lists of partners, mirrored into plain ones.
#include "contact/partner_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "archive/archive.hpp"
#include "archive/heap_counter.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::partner_list_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers content(const PartnerList& list) {
  Numbers numbers;
  for (const ContactRecord& contact : list.all()) numbers.push_back(contact.partner);
  return numbers;
}

/// A partner list and a plain list with equal content.
struct Mirrored {
  PartnerList list;
  Numbers plain;

  void change(Random& random) {
    const auto value = static_cast<std::uint32_t>(random.bits() % 9);
    if (random.bits() % 40 == 0) {
      list.clear();
      plain.clear();
    } else if (random.bits() % 5 < 2) {
      list.erase(value);
      std::erase(plain, value);
    } else {
      list.set({value});
      if (std::find(plain.begin(), plain.end(), value) == plain.end()) plain.push_back(value);
    }
  }
};

TEST(PartnerList, IsInTheOrderOfAddition) {
  Random random(1);
  Mirrored pair;
  for (int step = 0; step < 5000; ++step) {
    pair.change(random);
    ASSERT_EQ(content(pair.list), pair.plain) << "step " << step;
  }
}

TEST(PartnerList, IsCopiedMovedAndReadBack) {
  Random random(2);
  Mirrored pair;
  for (int step = 0; step < 500; ++step) {
    for (int change = 0; change < 5; ++change) pair.change(random);
    PartnerList copy = pair.list;
    ASSERT_EQ(content(copy), pair.plain);
    const PartnerList moved = std::move(copy);
    ASSERT_EQ(content(moved), pair.plain);
    copy = moved;
    copy.set({77});
    ASSERT_EQ(content(moved), pair.plain) << "a copy is independent";
    ByteWriter writer;
    writer(pair.list);
    PartnerList read;
    read.set({5});
    ByteReader reader(writer.bytes());
    reader(read);
    ASSERT_EQ(content(read), pair.plain);
  }
}

TEST(PartnerList, KeepsOneStateForEachPartner) {
  PartnerList list;
  list.set({4});
  list.set({4, {.approach = ApproachState::reported, .jams = 2}});
  ASSERT_EQ(list.all().size(), 1u);
  EXPECT_EQ(list.find(4)->jams, 2);
  EXPECT_EQ(list.find(5), nullptr);
}

TEST(PartnerList, NeedsMemoryForMoreThanTwo) {
  PartnerList list;
  list.set({1});
  list.set({2});
  EXPECT_EQ(heap_bytes(list), 0u);
  list.set({3});
  EXPECT_GT(heap_bytes(list), 0u);
}

}  // namespace
}  // namespace kinesphere::partner_list_test
