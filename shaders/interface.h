// The declarations that C++ and the shaders share, topic by topic. A pass binds nothing: its push
// constants hold the address of one Frame, from which it reaches everything else.
#ifndef NIGHTCITY_SHADERS_INTERFACE_H
#define NIGHTCITY_SHADERS_INTERFACE_H

#include "shaders/bvh_types.h"
#include "shaders/estimators.glsl.h"
#include "shaders/frame.h"
#include "shaders/limits.h"
#include "shaders/scene_types.h"
#include "shaders/specialization.h"

#endif
