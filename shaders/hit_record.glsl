// Where a ray ended: what the stages of a ray tracing pipeline hand to each other.
struct Hit {
  float t;        // in units of the ray's direction
  uint triangle;
  uint instance;  // or NO_HIT
};
