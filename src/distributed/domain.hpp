// One rank's part of a distributed world: the engine's tables with the rank's own bodies and copies of others
// nearby, and what ranks tell each other so that each runs its islands as one world would.
//
// Whenever time moves on, for each rank:
//   - known space contains the capsules of all its own bodies;
//   - the rank has an exact copy of each body whose capsule may come into known space, with all hot pairs and
//     links that it has with bodies that are known here.
// So all that can happen to an own body before windows end is known where it is owned. A part of a phase
// (part.cpp) ends when all ranks that own a body of an island have run the same island, with the same bodies:
// then each has what one world would have (docs/distributed.md has the proof).
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "archive/archive.hpp"
#include "distributed/communicator.hpp"
#include "distributed/known_space.hpp"
#include "distributed/parcel.hpp"
#include "distributed/partition.hpp"
#include "engine/islands.hpp"
#include "engine/starting.hpp"
#include "kinesphere/distributed/distributed_world.hpp"

namespace kinesphere {

class DistributedWorld::Domain final : private Answerer, private Mover {
 public:
  Domain(const WorldDefinition& definition, Motion& motion);

  Communicator& communicator() { return communicator_; }
  const Tables& tables() const { return tables_; }
  double time() const { return everybody_.time(); }
  /// Every rank says whether it can go on: the error of the first that cannot, the same on all. After one
  /// there is no going on.
  Result<void> agree(const Result<void>& here);

  Result<void> add(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion);
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  Result<void> run(double until, const Respond* respond, const OrderedSink& sink, Workers* workers);

  // checkpoint.cpp: the whole of it as bytes.
  Result<std::vector<std::byte>> save();
  static Result<std::unique_ptr<Domain>> restore(std::span<const std::vector<std::byte>> parts,
                                                 Motion& motion);

  std::uint64_t own_bodies() const { return roster_.size() - copies_.size(); }
  const Counters& counters() const { return everybody_.work().counters; }
  const EventHash& hash() const { return hash_; }
  RankFigures figures() const;

 private:
  class Checkpoint;
  using Bytes = Communicator::Bytes;
  /// Of a body, where it has been added or has come to.
  struct Entry {
    int owner = 0;
    std::uint32_t in_motion = 0;
    float cost = 0.0f;         ///< what it has taken since space was divided last
    std::vector<int> holders;  ///< other ranks that have a copy, of an own body
  };
  /// Whom a body touches and senses that is not known here. By name.
  struct Links {
    std::vector<std::uint32_t> partners;
    std::vector<Crossing> crossings;
  };
  /// Bodies that another rank has in one island: names and, for those that are registered, where they are.
  struct JoinList {
    struct Member {
      std::uint32_t name;
      std::int32_t owner;
      bool is_registered;
      Box box;

      template <class Self, class Archive>
      static void transfer(Self& self, Archive& archive) {
        auto& [named, whose, registered, place] = self;
        archive(named, whose, registered, place);
      }
    };
    std::vector<Member> together;
    /// The island takes for granted that these are in none.
    std::vector<std::uint32_t> counted_on;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [members, relied_upon] = self;
      archive(members, relied_upon);
    }
  };
  struct Round;

  Bodies& bodies() { return tables_.bodies; }
  const Bodies& bodies() const { return tables_.bodies; }
  int rank() const { return communicator_.rank(); }
  std::size_t ranks() const { return static_cast<std::size_t>(communicator_.ranks()); }
  bool is_own(std::uint32_t number) const { return is_copy_[number] == 0; }
  std::uint32_t name_of(std::uint32_t number) const { return bodies().table().name_of(number); }
  std::optional<std::uint32_t> find(std::uint32_t name) const;

  /// The error of the first rank that has one here, the same on all; the world goes on as it was.
  Result<void> first_error(const Result<void>& here);

  // The mover of the bodies that are known here, and who answers events.
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  Departure departure(BodyId body) const override;
  void depart(BodyId body, const Departure& departure) override;
  Result<Answer> answer(const Event& event) override;
  void turn(const Event& event, const Answer& answer) override { kinesphere::turn(*this, event, answer); }
  Departure departure(BodyId body) override { return std::as_const(*this).departure(body); }

  Result<void> resume(const Checkpoint& common, std::vector<Checkpoint>& parts);

  // bodies.cpp: bodies come and go.
  Parcel pack(std::uint32_t number) const;
  Parcel pack_as_it_began(std::uint32_t number);
  Parcel::Due due_of(const HotPair& pair, std::uint32_t number) const;
  std::uint32_t stamp_as_it_began(std::uint32_t number) const;
  HotPair pair_as_it_began(const Parcel::Due& due, std::uint32_t number, std::uint32_t other) const;
  void add_due(std::vector<Parcel>& parcels, std::span<const std::uint32_t> numbers);
  /// The bodies are known from now on, or as the parcels have them; returns what has to be begun with, of
  /// which the pairs may be due at any time.
  Result<Beginning> install(std::vector<Parcel>& parcels);
  Result<std::uint32_t> install(Parcel& parcel);
  void link(const Parcel& parcel);
  void drop(std::uint32_t number);
  Box box_of(std::uint32_t number) const { return tables_.windows.box_of(number, time()); }
  Box box_of(const BodyKick& kick) const;
  bool covers(const Box& box) const {
    return known_[static_cast<std::size_t>(rank())].covers(box, bodies().space());
  }

  // start.cpp: windows start.
  Result<void> check_names();
  Result<void> settle_arrivals(Shift& shift);
  Result<void> start_windows(Shift& shift, bool all, std::span<const std::uint32_t> joining);
  void divide_space(std::span<const Windows::Starter> starters);
  Parcel pack_to_start(const Windows::Starter& starter) const;
  Result<void> migrate(std::vector<Windows::Starter>& starters);
  Result<void> receive(std::vector<ByteWriter>& writers, std::vector<Windows::Starter>& starters);
  Result<void> spread(std::vector<Windows::Starter>& starters, bool anew);
  bool is_held(std::uint32_t number, int by) const;
  std::vector<std::uint32_t> own_bodies_in(std::span<const Box> boxes) const;
  std::vector<int> union_of(const std::vector<int>& held);
  std::size_t moving_copies() const;
  std::size_t registered_copies() const;

  // part.cpp: a part of a phase.
  Result<double> run_part(double until, double latest);
  bool is_ready(const Group& group) const;
  bool is_ours(const Group& group) const;
  std::vector<int> owners_of(const Group& group) const;
  Result<bool> share();
  void hold(std::uint32_t number, int by, Round& round);
  Bytes bytes_for(std::size_t to, const Round& round);
  void take_in(const std::vector<Bytes>& incoming);
  void use_lists();
  void note_news(Round& round);
  void note_asks(const Group& group, Round& round);
  void note_list(const Group& group, std::optional<std::uint32_t> met, Round& round);
  void note_kicks(const Group& group, Round& round);
  Result<void> finish_part();
  Result<void> push();

  // domain.cpp: runs.
  Result<void> go(double until, const OrderedSink& sink, Shift& shift);
  void tell(const OrderedSink& sink);

  Communicator communicator_;
  Motion& motion_;
  Tables tables_;
  Island everybody_;
  std::vector<FoundPairs> found_;
  Partition partition_;
  std::vector<KnownSpace> known_;  ///< of all ranks

  std::unordered_map<std::uint32_t, std::uint32_t> roster_;  ///< numbers by names
  std::vector<Entry> entries_;                               ///< by number
  std::vector<std::uint8_t> is_copy_;                        ///< by number
  std::vector<std::uint32_t> places_;                        ///< by number, 0; for add_due() alone
  std::vector<std::uint32_t> copies_;                        ///< of others, in no order
  std::unordered_map<std::uint32_t, Links> dangling_;        ///< by name
  std::vector<std::uint32_t>
      new_names_;  ///< of bodies that were added, not compared yet with those of others
  std::unordered_set<std::uint32_t> compared_names_;

  // During a run.
  const Respond* respond_ = nullptr;
  Islands* islands_of_run_ = nullptr;
  std::deque<OrderedEvent> events_;  ///< that are to be told
  // During a part of a phase.
  Islands* islands_ = nullptr;
  std::vector<JoinList> lists_;        ///< that wait for bodies to become known, or to be in an island
  std::vector<std::uint32_t> asking_;  ///< groups that have asked for space
  /// While a checkpoint is read: hot pairs of own bodies with those of others, which have yet to come.
  std::unordered_map<std::uint32_t, std::vector<Parcel::Due>> loose_;
  bool resuming_ = false;
  // What is to be said in the next round: space to be asked for; names to be asked for, of these ranks, and
  // those that have been asked for.
  std::vector<Box> asks_;
  std::vector<std::pair<int, std::uint32_t>> wanted_;
  std::vector<std::pair<int, std::uint32_t>> owed_;
  bool failed_ = false;
  std::optional<Error> here_;  ///< of this rank: the others do not know yet

  EventHash hash_;
  std::uint64_t parts_ = 0;
  std::uint64_t rounds_ = 0;
  std::uint64_t partitions_ = 0;
};

}  // namespace kinesphere
