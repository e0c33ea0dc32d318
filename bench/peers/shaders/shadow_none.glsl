float visibility(Frame f, Hit hit, vec3 L) { return 1.0; }
