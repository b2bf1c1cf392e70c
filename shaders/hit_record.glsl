// The end of a ray. The stages of a ray tracing pipeline pass it to each other too.
struct Hit {
  float t;        // in units of the ray's direction
  uint triangle;
  uint instance;  // or NO_HIT
};
