#include <gtest/gtest.h>

#include <stdexcept>

#include "scenes/pictures/contact_sheet.h"

using namespace tact::scenes;

namespace {

constexpr Color kGreen{20, 200, 60};

std::vector<Picture> pictures(int count) {
  std::vector<Picture> result;
  for (int i = 0; i < count; ++i) result.emplace_back(64, 36, Color{static_cast<std::uint8_t>(40 * i), 10, 20});
  return result;
}

}  // namespace

TEST(ContactSheet, SixPicturesMakeThreeColumnsAndTwoRows) {
  Font font;
  const std::vector<std::string> captions(6, "a");
  const Picture sheet = contact_sheet(pictures(6), captions, font, {.columns = 3, .tile_width = 32, .gap = 4});
  // Letters of 10 pixels: captions are 20 high.
  EXPECT_EQ(sheet.width, 4 + 3 * (32 + 4));
  EXPECT_EQ(sheet.height, 4 + 2 * (18 + 20 + 4));
  for (int i = 0; i < 6; ++i) {
    const Color middle = sheet.at(4 + i % 3 * 36 + 16, 4 + i / 3 * 42 + 9);
    EXPECT_EQ(middle, (Color{static_cast<std::uint8_t>(40 * i), 10, 20})) << i;
  }
}

TEST(ContactSheet, ScalingDownKeepsTheMeanLight) {
  Font font;
  std::vector<Picture> one(1, Picture(60, 30));
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 60; ++x) one[0].at(x, y) = (x + y) % 2 == 0 ? Color{255, 255, 255} : Color{};
  }
  const Picture sheet =
      contact_sheet(one, std::vector<std::string>{""}, font, {.columns = 3, .tile_width = 30, .gap = 2});
  EXPECT_EQ(sheet.width, 34);                  // no more columns than pictures
  EXPECT_NEAR(sheet.at(12, 9).green, 188, 1);  // half the light of white
}

TEST(ContactSheet, CaptionsAreDrawn) {
  Font font;
  const auto draw = [&](const char* caption) {
    return contact_sheet(pictures(1), std::vector<std::string>{caption}, font,
                         {.columns = 1, .tile_width = 64, .gap = 4});
  };
  EXPECT_FALSE(draw("frame 7") == draw(""));
  EXPECT_FALSE(draw("frame 7") == draw("frame 8"));
}

TEST(ContactSheet, ArgumentsThatDoNotFitAreRefused) {
  Font font;
  const std::vector<std::string> two(2, "x");
  EXPECT_THROW(contact_sheet({}, {}, font), std::runtime_error);
  EXPECT_THROW(contact_sheet(pictures(3), two, font, {.tile_width = 32}), std::runtime_error);
  EXPECT_THROW(contact_sheet(pictures(2), two, font, {.tile_width = 65}), std::runtime_error);
  std::vector<Picture> mixed = pictures(1);
  mixed.emplace_back(10, 10, kGreen);
  EXPECT_THROW(contact_sheet(mixed, two, font, {.tile_width = 8}), std::runtime_error);
}

TEST(ContactSheet, FramesAreSpreadFromFirstToLast) {
  EXPECT_EQ(sheet_frames(60), (std::vector<int>{0, 12, 24, 35, 47, 59}));
  EXPECT_EQ(sheet_frames(6), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(sheet_frames(3), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(sheet_frames(9, 1), (std::vector<int>{8}));
  EXPECT_TRUE(sheet_frames(0).empty());
}

TEST(Font, WidthGrowsWithTheTextAndWrongBytesAreNotAnError) {
  Font font;
  EXPECT_GT(font.width("contacts", 20), font.width("contact", 20));
  EXPECT_GT(font.width("contact", 40), font.width("contact", 20));
  EXPECT_EQ(font.width("", 20), 0);
  Picture picture(40, 20);
  font.draw(picture, "\xff\xc3", 2, 15, 12, kGreen);
  font.draw(picture, "a text that leaves the picture on the right", -10, 15, 12, kGreen);
  EXPECT_EQ(picture.width, 40);
}
