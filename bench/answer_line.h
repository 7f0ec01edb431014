// The last line of a benchmark: hashes of all answers, for equal answers equal ones, whatever the number of threads.
#pragma once

#include <fmt/format.h>

#include <cstdint>

#include "tests/support/hashes/answer_hash.h"

namespace tact::bench {

// Of sets of facet pairs, which have no doubles.
inline void print_answer_line(std::uint64_t facet_pairs) { fmt::print("hash of all answers {:016x}\n", facet_pairs); }

// A change of rounding alters the second alone.
inline void print_answer_line(const tests::AnswerHash& answers) {
  const tests::AnswerHashes hashes = answers.hashes();
  fmt::print("hash of all answers: features {:016x}, numbers {:016x}\n", hashes.features, hashes.numbers);
}

}  // namespace tact::bench
