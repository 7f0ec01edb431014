// A world over many ranks as bytes, a share a rank, and a world made of such shares on any number of ranks: bodies come
// as if all of them had moved, and what is kept of a pair waits for the next step.
#include <algorithm>
#include <cstring>
#include <utility>

#include "mpi/world_implementation.h"

namespace tact::mpi {

namespace {

constexpr std::uint64_t kMagic = 0x6b6e617274636174;  // "tactrank"
constexpr std::uint64_t kVersion = 3;                 // of the bytes, and of all that they hold

[[noreturn]] void refuse(const char* what) { throw Error(ErrorCode::bad_state, what); }

// Before the content of each share.
struct Head {
  std::uint64_t magic = kMagic, version = kVersion;
  std::uint64_t shares = 0;    // of all ranks
  std::uint64_t of_all = 0;    // the sum of their checksums
  std::uint64_t checksum = 0;  // of this one
};

// What the bytes cannot be is their fault.
template <class Work>
void reading(const Work& work) try {
  work();
} catch (const Error& error) {
  if (error.code() == ErrorCode::bad_state || error.code() == ErrorCode::out_of_memory) throw;
  refuse(error.what());
}

}  // namespace

struct World::Implementation::Share {
  Head head = {};
  std::span<const std::byte> common = {};   // what every share has
  std::span<const std::byte> content = {};  // what is of its rank
};

// What all ranks hold alike.
Bytes World::Implementation::common_bytes() {
  ByteWriter writer;
  writer.put_all(WorldParts::settings_bytes(local.settings()));
  writer.put_all(parts.steps());
  writer.put(hash_of_shared(), std::uint64_t{held.shared.size()});
  for (const auto& [key, id] : held.shared) {
    writer.put(key);
    writer.put_all(parts.shape(id));
    writer.put_all(parts.rest(id));
  }
  return std::move(writer.bytes());
}

// A pair goes with its host; of those that have ended, the next step tells the end.
Bytes World::Implementation::content_of_share() {
  std::map<std::uint64_t, std::vector<SavedPair>> pairs;
  std::vector<SavedPair> ended;
  for (SavedPair& pair : parts.all_pairs()) {
    const bool has_ended = pair.bytes.empty();
    auto& to = has_ended ? ended : pairs[held.host_of(held.find(pair.key_a), held.find(pair.key_b))];
    to.push_back(std::move(pair));
  }
  for (const WaitingPair& one : waiting) (held.own.contains(one.host) ? pairs[one.host] : ended).push_back(one.pair);
  ByteWriter writer;
  writer.put_all(common_bytes());
  writer.put(std::uint64_t{held.own.size()});
  for (const auto& [key, body] : held.own) {
    writer.put(key);
    pack_body(key, pairs[key], writer);
    pack_state(key, writer);
  }
  writer.put(std::uint64_t{ended.size()});
  for (const SavedPair& pair : ended) put(pair, writer);
  writer.put(std::uint64_t{exclusions.size()});
  for (const Exclusion& one : exclusions) one.put(writer);
  return std::move(writer.bytes());
}

std::vector<std::byte> World::save() const {
  Implementation& i = implementation();
  i.send_meshes();
  Bytes content;
  Head head{.shares = static_cast<std::uint64_t>(i.channel.size())};
  const std::exception_ptr failure = Channel::failure_of([&] {
    content = i.content_of_share();
    head.checksum = WorldParts::checksum(content);
  });
  for (const std::uint64_t checksum : i.channel.gather(head.checksum, failure)) head.of_all += checksum;
  Bytes share;
  i.channel.together([&] {
    share.resize(sizeof head + content.size());
    std::memcpy(share.data(), &head, sizeof head);
    std::memcpy(share.data() + sizeof head, content.data(), content.size());
  });
  return share;
}

namespace {

template <class Share>
Share read_share(std::span<const std::byte> bytes) {
  Share share;
  if (bytes.size() < sizeof share.head) refuse("not a share of a world over many ranks");
  std::memcpy(&share.head, bytes.data(), sizeof share.head);
  if (share.head.magic != kMagic) refuse("not a share of a world over many ranks");
  if (share.head.version != kVersion) refuse("a share of another version");
  const std::span<const std::byte> content = bytes.subspan(sizeof share.head);
  if (WorldParts::checksum(content) != share.head.checksum) refuse("a share is damaged: its checksum is another");
  ByteReader reader(content);
  share.common = reader.get_bytes();
  share.content = reader.rest();
  return share;
}

// Whether the ranks have all shares of one save, each once.
template <class Share>
void check_all(const std::vector<Share>& shares, Channel& channel) {
  std::uint64_t count = 0, of_all = 0, own = 0;
  for (const std::uint64_t number : channel.gather(shares.size())) count += number;
  for (const Share& share : shares) own += share.head.checksum;
  for (const std::uint64_t number : channel.gather(own)) of_all += number;
  channel.together([&] {
    if (count == 0) refuse("no rank was given a share");
    for (const Share& share : shares) {
      if (share.head.shares != count || share.head.of_all != of_all)
        refuse("the ranks were not given each share of one save once");
    }
  });
}

}  // namespace

void World::Implementation::take_common(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  reader.get_bytes();  // the settings
  parts.set_steps(reader.get_bytes());
  const auto hash = reader.get<std::uint64_t>();
  for (auto count = reader.get<std::uint64_t>(); count > 0; --count) {
    const auto key = reader.get<std::uint64_t>();
    const auto shape = reader.get_bytes(), rest = reader.get_bytes();
    const BodyId id = parts.put(shape, rest, false);
    held.hold(id, {Held::Role::shared, channel.rank(), order_of_new(id, key)});
    held.shared[key] = id;
  }
  removed_shared = hash - hash_of_shared();
}

// Into a world that is new; `states` are of the program.
void World::Implementation::take_shares(std::span<const Share> shares, States& states) {
  std::vector<Arrival> arrivals;
  for (const Share& share : shares) {
    ByteReader reader(share.content);
    for (auto count = reader.get<std::uint64_t>(); count > 0; --count) {
      const auto key = reader.get<std::uint64_t>();
      unpack_body(key, reader, arrivals);
      new_keys.push_back(key);
      if (reader.get<bool>()) states.push_back({key, reader.get_bytes()});
    }
    for (auto count = reader.get<std::uint64_t>(); count > 0; --count) {
      SavedPair pair = get_pair(reader);
      waiting.push_back({pair.key_a, std::move(pair)});
    }
    for (auto count = reader.get<std::uint64_t>(); count > 0; --count) exclusions.push_back(Exclusion::get(reader));
    if (!reader.at_end()) refuse("a share goes on after its end");
  }
  take_in(std::move(arrivals));
  parts.settle();
  needs_near = owners_changed = sends_all = true;
}

// The program's state of its bodies: that of now goes and the other comes, or all is as it was.
void World::Implementation::exchange_states(const World::Implementation& last, const States& states) {
  if (!body_state.pack) return;
  std::map<std::uint64_t, Bytes> before;
  channel.together([&] {
    for (const auto& [key, body] : last.held.own) before[key] = body_state.pack(key);
  });
  for (const auto& [key, bytes] : before) body_state.drop(key);
  std::size_t taken = 0;
  const std::exception_ptr failure = Channel::failure_of([&] {
    for (; taken < states.size(); ++taken) body_state.unpack(states[taken].first, states[taken].second);
  });
  try {
    channel.gather(0, failure);
  } catch (...) {
    for (std::size_t i = 0; i < taken; ++i) body_state.drop(states[i].first);
    for (const auto& [key, bytes] : before) body_state.unpack(key, bytes);
    throw;
  }
}

void World::restore(std::span<const std::span<const std::byte>> given) {
  using Share = Implementation::Share;
  Implementation& i = implementation();
  std::vector<Share> shares;
  i.channel.together([&] {
    for (const std::span<const std::byte> bytes : given) reading([&] { shares.push_back(read_share<Share>(bytes)); });
  });
  check_all(shares, i.channel);
  // A rank without a share has what all hold alike from the first that has one.
  const auto counts = i.channel.gather(shares.size());
  const std::vector<std::uint64_t> all(counts.begin(), counts.end());
  const auto first = std::ranges::find_if(all, [](std::uint64_t count) { return count > 0; }) - all.begin();
  const auto messages = i.channel.exchange([&](Outbox& outbox) {
    for (int rank = 0; first == i.channel.rank() && rank < i.channel.size(); ++rank) {
      if (all[rank] == 0) outbox.to(rank).put_all(shares.front().common);
    }
  });
  Settings settings = i.settings;
  std::span<const std::byte> common;
  i.channel.together([&] {
    reading([&] {
      common = shares.empty() ? ByteReader(messages.front().bytes).get_bytes() : shares.front().common;
      settings.world = WorldParts::settings_of(ByteReader(common).get_bytes(), settings.world);
      tact::World trial(settings.world);
    });
  });
  auto restored = std::make_unique<Implementation>(i.channel.comm(), settings);
  Implementation::States states;
  i.channel.together([&] {
    reading([&] {
      restored->body_state = i.body_state;
      restored->take_common(common);
      restored->take_shares(shares, states);
    });
  });
  restored->update_directory();
  restored->exchange_states(i, states);
  implementation_ = std::move(restored);
}

}  // namespace tact::mpi
