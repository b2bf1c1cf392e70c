#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require
// Records the closest hit; trace.glsl does the rest.
#include "shaders/hit_record.glsl"

layout(location = 0) rayPayloadInEXT Hit hit;

void main() { hit = Hit(gl_HitTEXT, gl_PrimitiveID, gl_InstanceCustomIndexEXT); }
