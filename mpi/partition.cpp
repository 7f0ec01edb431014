#include "mpi/partition.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

namespace tact::mpi {

namespace {

constexpr int kWordsOfKey = 2;  // of 32 bits: ids of Zoltan have no more where it was built so

void check(int code, const char* what) {
  if (code != ZOLTAN_OK && code != ZOLTAN_WARN)
    throw Error(ErrorCode::backend_failure,
                "Zoltan: " + std::string(what) + " failed with code " + std::to_string(code));
}

// Then Zoltan's communicators are gone.
bool is_finalized() {
  int is_over = 0;
  MPI_Finalized(&is_over);
  return is_over != 0;
}

void put_key(std::uint64_t key, ZOLTAN_ID_PTR words) {
  words[0] = static_cast<ZOLTAN_ID_TYPE>(key >> 32);
  words[1] = static_cast<ZOLTAN_ID_TYPE>(key & 0xffffffffu);
}

std::uint64_t key_in(const ZOLTAN_ID_TYPE* words) {
  return std::uint64_t{words[0]} << 32 | (std::uint64_t{words[1]} & 0xffffffffu);
}

// What Zoltan asks for, called with the sites.
using Sites = std::span<const Site>;

int site_count(void* sites, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(static_cast<Sites*>(sites)->size());
}

void list_sites(void* sites, int, int, ZOLTAN_ID_PTR keys, ZOLTAN_ID_PTR places, int weights, float* work, int* error) {
  *error = ZOLTAN_OK;
  const Sites& all = *static_cast<Sites*>(sites);
  for (std::size_t i = 0; i < all.size(); ++i) {
    put_key(all[i].key, keys + kWordsOfKey * i);
    places[i] = static_cast<ZOLTAN_ID_TYPE>(i);
    if (weights > 0) work[i] = static_cast<float>(all[i].work);
  }
}

int dimension(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

void list_middles(void* sites, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR places, int, double* middles,
                  int* error) {
  *error = ZOLTAN_OK;
  for (int i = 0; i < count; ++i) std::ranges::copy((*static_cast<Sites*>(sites))[places[i]].middle, middles + 3 * i);
}

// Lists that Zoltan allocates.
struct Lists {
  Lists() = default;
  Lists(const Lists&) = delete;
  Lists& operator=(const Lists&) = delete;
  ~Lists() { Zoltan_LB_Free_Part(&keys, &places, &ranks, &parts); }
  int count = 0;
  ZOLTAN_ID_PTR keys = nullptr, places = nullptr;
  int *ranks = nullptr, *parts = nullptr;
};

}  // namespace

Keys::Keys(std::span<const std::uint64_t> keys)
    : words_(kWordsOfKey * std::max<std::size_t>(keys.size(), 1)), owners_(keys.size(), -1) {
  owners_.reserve(1);  // so that there is a place
  for (std::size_t i = 0; i < keys.size(); ++i) put_key(keys[i], &words_[kWordsOfKey * i]);
}

Shipment::Shipment(std::vector<Parcel> given) : parcels(std::move(given)), words({}) {
  for (const Parcel& parcel : parcels) {
    places.push_back(static_cast<ZOLTAN_ID_TYPE>(keys.size()));
    keys.push_back(parcel.key);
    ranks.push_back(parcel.rank);
  }
  words = Keys(keys);
}

Directory::Directory(const Channel& channel) {
  constexpr int kDefaultTable = 0, kSilent = 0;
  check(Zoltan_DD_Create(&directory_, channel.comm(), kWordsOfKey, 0, 0, kDefaultTable, kSilent), "a directory");
}
Directory::~Directory() {
  if (!is_finalized()) Zoltan_DD_Destroy(&directory_);
}

void Directory::add(Keys& keys) {
  check(Zoltan_DD_Update(directory_, keys.words(), nullptr, nullptr, nullptr, keys.count()), "adding to a directory");
}

void Directory::remove(Keys& keys) {
  check(Zoltan_DD_Remove(directory_, keys.words(), keys.count()), "removing from a directory");
}

// What is not there is a warning.
void Directory::find(Keys& keys) const {
  std::ranges::fill(keys.owners(), -1);
  check(Zoltan_DD_Find(directory_, keys.words(), nullptr, nullptr, nullptr, keys.count(), keys.owners().data()),
        "looking into a directory");
}

Partition::Partition(const Channel& channel, Partitioner partitioner)
    : channel_(channel), found_(static_cast<std::size_t>(channel.size())) {
  float version = 0.0f;
  check(Zoltan_Initialize(0, nullptr, &version), "its start");
  zoltan_ = Zoltan_Create(channel.comm());
  if (zoltan_ == nullptr) throw Error(ErrorCode::backend_failure, "Zoltan: its start failed");
  const std::pair<const char*, const char*> parameters[] = {
      {"DEBUG_LEVEL", "0"},     {"LB_METHOD", partitioner == Partitioner::rcb ? "RCB" : "HSFC"},
      {"NUM_GID_ENTRIES", "2"}, {"NUM_LID_ENTRIES", "1"},
      {"OBJ_WEIGHT_DIM", "1"},  {"RETURN_LISTS", "EXPORT"},
      {"KEEP_CUTS", "1"},       {"RCB_REUSE", "1"}};
  for (const auto& [name, value] : parameters) {
    if (partitioner == Partitioner::rcb || std::string_view(name) != "RCB_REUSE")
      check(Zoltan_Set_Param(zoltan_, name, value), name);
  }
}

Partition::~Partition() {
  if (!is_finalized()) Zoltan_Destroy(&zoltan_);
}

// Without a body Zoltan keeps no space, and the next cut would go by what it does not have: the last one stays.
std::vector<int> Partition::cut(Sites sites) {
  std::array<std::uint64_t, 1> most{sites.size()};
  channel_.largest(most);
  if (most[0] == 0) return {};
  Zoltan_Set_Num_Obj_Fn(zoltan_, site_count, &sites);
  Zoltan_Set_Obj_List_Fn(zoltan_, list_sites, &sites);
  Zoltan_Set_Num_Geom_Fn(zoltan_, dimension, nullptr);
  Zoltan_Set_Geom_Multi_Fn(zoltan_, list_middles, &sites);
  int changes = 0, words = 0, local_words = 0;
  Lists imports, exports;
  imports.count = exports.count = 0;
  check(Zoltan_LB_Partition(zoltan_, &changes, &words, &local_words, &imports.count, &imports.keys, &imports.places,
                            &imports.ranks, &imports.parts, &exports.count, &exports.keys, &exports.places,
                            &exports.ranks, &exports.parts),
        "cutting space");
  is_cut_ = true;
  std::vector<int> ranks(sites.size(), channel_.rank());
  for (int i = 0; i < exports.count; ++i) ranks[exports.places[i]] = exports.ranks[i];
  return ranks;
}

// On a curve Zoltan finds no way to the parts of some boxes: those may meet any.
void Partition::ranks_near(const base::Box& box, std::vector<int>& ranks) const {
  int count = 0;
  const int code = Zoltan_LB_Box_Assign(zoltan_, box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y,
                                        box.upper.z, found_.data(), &count);
  if (code == ZOLTAN_FATAL) {
    ranks.resize(found_.size());
    std::iota(ranks.begin(), ranks.end(), 0);
    return;
  }
  check(code, "finding the parts of a box");
  ranks.assign(found_.begin(), found_.begin() + count);
}

// Callbacks only copy: what is sent is packed before, as an exception must not pass through Zoltan.
struct Partition::Cargo {
  std::span<const Parcel> sent;
  std::vector<Parcel> received;

  static int size(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR place, int* error) {
    *error = ZOLTAN_OK;
    return static_cast<int>(static_cast<Cargo*>(data)->sent[*place].bytes.size());
  }
  static void pack(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR place, int, int, char* to, int* error) {
    *error = ZOLTAN_OK;
    const Bytes& bytes = static_cast<Cargo*>(data)->sent[*place].bytes;
    std::memcpy(to, bytes.data(), bytes.size());
  }
  static void unpack(void* data, int, ZOLTAN_ID_PTR key, int size, char* from, int* error) {
    try {
      Parcel& parcel = static_cast<Cargo*>(data)->received.emplace_back();
      parcel.key = key_in(key);
      parcel.bytes.resize(static_cast<std::size_t>(size));
      std::memcpy(parcel.bytes.data(), from, parcel.bytes.size());
      *error = ZOLTAN_OK;
    } catch (...) {
      *error = ZOLTAN_MEMERR;
    }
  }
};

std::vector<Parcel> Partition::send(Shipment& shipment) {
  Cargo cargo{shipment.parcels, {}};
  Zoltan_Set_Obj_Size_Fn(zoltan_, Cargo::size, &cargo);
  Zoltan_Set_Pack_Obj_Fn(zoltan_, Cargo::pack, &cargo);
  Zoltan_Set_Unpack_Obj_Fn(zoltan_, Cargo::unpack, &cargo);
  // A cut asks for the sizes, too, where they are told.
  struct Forgotten {
    Zoltan_Struct* zoltan;
    ~Forgotten() { Zoltan_Set_Obj_Size_Fn(zoltan, nullptr, nullptr); }
  } const forgotten{zoltan_};
  const int count = shipment.words.count();
  Lists imports;
  check(
      Zoltan_Compute_Destinations(zoltan_, count, shipment.words.words(), shipment.places.data(), shipment.ranks.data(),
                                  &imports.count, &imports.keys, &imports.places, &imports.ranks),
      "telling who gets what");
  check(Zoltan_Help_Migrate(zoltan_, imports.count, imports.keys, imports.places, imports.ranks, count,
                            shipment.words.words(), shipment.places.data(), shipment.ranks.data()),
        "moving bodies");
  std::ranges::sort(cargo.received, {}, &Parcel::key);
  return std::move(cargo.received);
}

}  // namespace tact::mpi
