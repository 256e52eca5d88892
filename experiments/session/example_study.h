#pragma once

#include <filesystem>

#include "experiments/session/study.h"

namespace plenolab {

/// A study to try and to change: five images and a catch trial, two blocks (light-field display, then
/// monitor, and the other way round for every second participant), consent, questions. Texts are placeholders
/// that say so.
StudyDefinition example_study();

/// Draws the images of example_study into `folder`: for the light-field display 15 × 8 subimages of 81 × 81
/// px of discs floating before a wall, for the monitor the central subimage (row 4, column 8). In the test
/// images what lies beside a disc's edge is a mean colour, in a band that widens from image to image, as
/// holes of reprojection look.
void write_example_images(const std::filesystem::path& folder);

/// The study of an image set, which is copied into `folder`/images. Either that of `plenolab reproject
/// --image-set` (NAME-vc-panel.png against NAME-ic-panel.png on the light-field display, NAME-vc-centre.png
/// against NAME-ic-centre.png on the monitor), or pairs NAME-reference.png and NAME-test.png for the
/// light-field display, with NAME-monitor-reference.png and NAME-monitor-test.png for the monitor where they
/// are. Names with "catch" are catch trials; without any, one is made that offers the second image's
/// reference against the first's. Throws InputError if there is no pair.
StudyDefinition study_of_images(const std::filesystem::path& images, const std::filesystem::path& folder);

}  // namespace plenolab
