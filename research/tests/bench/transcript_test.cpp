// Transcripts: runs that are recorded and played again.
#include "research/bench/speed/transcript.hpp"

#include <gtest/gtest.h>

#include "program/support.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/speed/step_recording.hpp"

namespace kinesphere::program::transcript_test {
namespace {

Scene scene(SceneResponse response) {
  SceneParameters parameters = first_experiment(400, 1.0);
  parameters.response = response;
  return require(make_scene(parameters));
}

TEST(Transcript, HoldsTheRunThatAnyoneElseSees) {
  const Scene bouncing = scene(SceneResponse::bounce);
  for (const NamedDetector& detector : {world_engine(), paper_engine()}) {
    const Transcript transcript = write_down(bouncing, detector.make);
    const SceneResult plain = require(run_scene(bouncing, detector.make));
    EXPECT_EQ(transcript.result.contact_hash, plain.contact_hash);
    EXPECT_EQ(transcript.result.counters.probes, plain.counters.probes);
    EXPECT_EQ(transcript.bodies.size(), 400u);
    EXPECT_GT(transcript.kicks.size(), 100u);
    EXPECT_GT(play(transcript, detector.make).detecting, 0.0) << "or it would have thrown";
  }
}

TEST(Transcript, IsForTheDetectorThatItWasWrittenFor) {
  const Transcript transcript = write_down(scene(SceneResponse::bounce), world_engine().make);
  EXPECT_THROW(play(transcript, paper_engine().make), ProgramError);
}

TEST(Recall, FineStepsMissLessAndSweptOnesNothing) {
  const Scene passing = scene(SceneResponse::pass_through);
  const ContactCounts truth = count_contacts(passing, world_engine().make);
  ASSERT_GT(total(truth), 100u);
  const std::uint64_t coarse = missed(truth, contacts_at_steps(passing, 0.5, 2, SphereTest::at_steps));
  const std::uint64_t fine = missed(truth, contacts_at_steps(passing, 0.01, 100, SphereTest::at_steps));
  EXPECT_GT(coarse, fine);
  EXPECT_LT(missed(truth, contacts_at_steps(passing, 0.01, 100, SphereTest::swept)), 1 + fine);
}

}  // namespace
}  // namespace kinesphere::program::transcript_test
