// The colour map, filtered between two levels.
void main() {
    color = texture(color_map, uv);
#ifdef PLANTED
    color = texture(color_map, uv * 1.001);
#endif
}
