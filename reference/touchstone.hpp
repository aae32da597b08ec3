#pragma once

// Everything a user needs: shapes, poses, and for a cylinder against each other shape the three
// questions `overlaps`, `contact` and `signed_distance`, of one pair of poses or of many, in
// double or float, and `cast` for one that moves.

#include "batch.hpp"
#include "cast.hpp"
#include "contact.hpp"
#include "invalid_input.hpp"
#include "pose.hpp"
#include "shape.hpp"
#include "single_precision.hpp"
#include "support.hpp"
