// Shows a report in a picture.
#pragma once

#include <tact/report.h>

#include "scenes/pictures/camera.h"
#include "scenes/pictures/picture_scene.h"

namespace tact::scenes {

struct ContactMarks {
  bool facets = true;            // the facets that meet, and those with contact points
  bool directions = true;        // an arrow a touching contact, from a to b
  bool hulls = false;            // arrows also where only hulls meet, from the middle of a's box
  bool zones = false;            // the disks around the impact zones; the world must have computed them
  double shortest_arrow = 0.12;  // an arrow is as long as the contact is deep, but not shorter than this share of the
                                 // diagonal of the smaller body's box
  double longest_arrow = 1.0;    // nor longer than this share of it
};

// Adds the marks of `report` to `scene`, whose body i is the body of index i in the report. Contacts of bodies that the
// scene does not hold are left out.
void mark_contacts(PictureScene& scene, const Report& report, const ContactMarks& marks = {});

// Shortens arrows whose tips `camera` does not see, down to a tenth, until it does.
void keep_arrows_in_picture(const Camera& camera, int width, int height, PictureScene& scene);

}  // namespace tact::scenes
