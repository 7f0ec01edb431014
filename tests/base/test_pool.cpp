#include <gtest/gtest.h>

#include <vector>

#include "engine/base/pool.h"

namespace {

using tact::base::Pool;

TEST(Pool, LendsAnObjectToOneHolderAtATimeAndKeepsItsMemory) {
  Pool<std::vector<int>> pool;
  const std::vector<int>* first = nullptr;
  {
    const Pool<std::vector<int>>::Loan one(pool), other(pool);
    EXPECT_NE(&*one, &*other);
    (*one).resize(100);
    first = &*one;
  }
  const Pool<std::vector<int>>::Loan one(pool), other(pool);
  EXPECT_TRUE(&*one == first || &*other == first);
  EXPECT_EQ((*one).size() + (*other).size(), 100U);
}

}  // namespace
