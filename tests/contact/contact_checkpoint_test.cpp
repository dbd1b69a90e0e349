// A checkpoint restores a body's contacts; static bodies are updated later.
#include "contact/contact_checkpoint.hpp"

#include <gtest/gtest.h>

namespace kinesphere::contact_checkpoint_test {
namespace {

/// Body 3 is static.
class ContactCheckpointTest : public ::testing::Test {
 protected:
  ContactCheckpointTest() {
    for (std::uint32_t body = 0; body < 4; ++body) book.add(body, 0.0);
    book.set_shape(3, true);
  }

  void touch(std::uint32_t a, std::uint32_t b, bool touching) {
    book.set_touching({.kind = EventKind::contact_begin, .first = {a, 0}, .second = {b, 0}}, touching);
  }
  void sense(std::uint32_t a, std::uint32_t b, bool within) {
    book.set_touching({.kind = EventKind::sensor_enter, .first = {a, 0}, .second = {b, 0}, .distance = 2.0},
                      within);
  }
  std::vector<ContactCheckpoint> keep_all() const {
    std::vector<ContactCheckpoint> checkpoint;
    for (std::uint32_t body = 0; body < 4; ++body) checkpoint.push_back(ContactCheckpoint::of(book, body));
    return checkpoint;
  }
  std::vector<std::uint32_t> partners_of(std::uint32_t body) const {
    std::vector<std::uint32_t> partners;
    for (const ContactRecord& contact : book.partners_of(body)) partners.push_back(contact.partner);
    return partners;
  }

  WorldDefinition definition;
  ContactGraph book{definition};
};

TEST_F(ContactCheckpointTest, PutBackWhatTheBodyTouchedAndSensed) {
  const Event wall{.kind = EventKind::wall_begin, .first = {0, 0}, .wall = Wall::x_lower};
  touch(0, 1, true);
  sense(0, 2, true);
  book.set_touching(wall, true);
  const std::vector<ContactCheckpoint> checkpoint = keep_all();
  book.set_touching(wall, false);
  touch(0, 1, false);
  touch(0, 2, true);
  sense(0, 2, false);
  for (std::uint32_t body = 0; body < 4; ++body) checkpoint[body].restore(book, body);
  EXPECT_EQ(partners_of(0), std::vector<std::uint32_t>{1});
  EXPECT_EQ(partners_of(1), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(partners_of(2).empty());
  EXPECT_TRUE(book.touches_wall(0, Wall::x_lower));
  ASSERT_EQ(book.overlaps_of(2).size(), 1u);
  EXPECT_EQ(book.overlaps_of(0, 2).front().distance, 2.0);
  EXPECT_TRUE(book.is_valid(4, Box{{-1, -1, -1}, {1, 1, 1}}));
}

TEST_F(ContactCheckpointTest, PutBackAloneLeavesLinks) {
  touch(0, 1, true);
  const ContactCheckpoint checkpoint = ContactCheckpoint::of(book, 0);
  touch(0, 1, false);
  checkpoint.restore_alone(book, 0);
  EXPECT_TRUE(partners_of(0).empty());
}

TEST_F(ContactCheckpointTest, TellFixedBodiesWhatHasChangedSideBySide) {
  touch(0, 3, true);
  sense(1, 3, true);
  book.start_side_by_side(true);
  const std::vector<ContactCheckpoint> checkpoint = keep_all();
  touch(0, 3, false);
  touch(2, 3, true);
  sense(1, 3, false);
  sense(0, 3, true);
  EXPECT_EQ(partners_of(3), std::vector<std::uint32_t>{0}) << "not yet";
  EXPECT_TRUE(book.touch(3, 2)) << "the other knows";
  EXPECT_FALSE(book.touch(3, 0));
  for (std::uint32_t body = 0; body < 3; ++body) checkpoint[body].update_static(book, body);
  book.stop_side_by_side();
  EXPECT_EQ(partners_of(3), std::vector<std::uint32_t>{2});
  ASSERT_EQ(book.overlaps_of(3).size(), 1u);
  EXPECT_EQ(book.overlaps_of(3).front().partner, 0u);
  EXPECT_TRUE(book.is_valid(4, {}));
}

}  // namespace
}  // namespace kinesphere::contact_checkpoint_test
