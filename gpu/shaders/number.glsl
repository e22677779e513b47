// The numbers of shaders that are compiled for either precision.
#if DOUBLE
#define NUMBER double
#else
#define NUMBER float
#endif
