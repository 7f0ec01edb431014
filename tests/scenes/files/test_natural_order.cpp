#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scenes/files/natural_order.h"

namespace tact::scenes {
namespace {

TEST(NaturalOrder, NumbersGoByTheirValue) {
  const std::vector<std::string> ordered = {"",
                                            "1",
                                            "01",
                                            "2",
                                            "10",
                                            "99999999999999999999",
                                            "100000000000000000000",
                                            "f",
                                            "f1.obj",
                                            "f2.obj",
                                            "f10.obj",
                                            "f_1",
                                            "f_2_9",
                                            "f_2_10",
                                            "f_10_1",
                                            "fa1",
                                            "fa1b",
                                            "fa01b",
                                            "fa2a"};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    for (std::size_t j = 0; j < ordered.size(); ++j) {
      // Names of equal numbers go by bytes: "01" before "1".
      const bool same_value = (ordered[i] == "1" && ordered[j] == "01") || (ordered[i] == "01" && ordered[j] == "1") ||
                              (ordered[i] == "fa1b" && ordered[j] == "fa01b") ||
                              (ordered[i] == "fa01b" && ordered[j] == "fa1b");
      EXPECT_EQ(comes_before(ordered[i], ordered[j]), same_value ? ordered[i] < ordered[j] : i < j)
          << ordered[i] << " " << ordered[j];
    }
  }
}

TEST(NaturalOrder, BytesGoByTheirValueToo) { EXPECT_TRUE(comes_before("a", "\xc3\xa4")); }

}  // namespace
}  // namespace tact::scenes
