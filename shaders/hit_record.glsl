// Where a ray ended. It is also what the stages of a ray tracing pipeline pass to each other.
struct Hit {
  float t;        // in units of the ray's direction
  uint triangle;
  uint instance;  // or NO_HIT
};
