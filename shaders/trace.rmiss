#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
// Records that the ray hit nothing.
#include "shaders/interface.h"
#include "shaders/hit_record.glsl"

layout(location = 0) rayPayloadInEXT Hit hit;

void main() { hit.instance = NO_HIT; }
